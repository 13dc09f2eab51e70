#include <benchmark/benchmark.h>

#include "analysis/planning/power_summary.h"
#include "app/planning/power_study.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session.h"
#include "support/places.h"

namespace jnd::app {
namespace {

const std::string kSource = test_support::source_folder().string();

/// Measures 1000 simulations of study 2 with 13 participants: answers, individual fits, group
/// tests and sums. The goal is less than 10 s on 2 cores.
void power_of_study_2(benchmark::State& state) {
  const auto study =
      experiments::read_study(kSource + "/protocols/viscosity_discrimination.json");
  const auto laboratory =
      experiments::read_laboratory(kSource + "/data/laboratories/thesis.json");
  for (auto _ : state) {
    const PowerStudy power(study, laboratory, {.sizes = {13}, .num_runs = 1000});
    benchmark::DoNotOptimize(analysis::summary_of_runs(
        power.design().analysis, power.run({.jobs = static_cast<int>(state.range(0))})));
  }
}
BENCHMARK(power_of_study_2)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Measures one person's answers in both blocks, without a device.
void answers_without_a_device(benchmark::State& state) {
  const auto study = experiments::read_study(
      kSource + (state.range(0) == 2 ? "/protocols/viscosity_discrimination.json"
                                     : "/protocols/magnitude_of_virtual_water.json"));
  const auto laboratory =
      experiments::read_laboratory(kSource + "/data/laboratories/thesis.json");
  const experiments::AnswerSimulator simulator(study, laboratory);
  const auto stages = experiments::stages_of(study, experiments::cells_of(study).front());
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(simulator.answers(stages, ++seed));
}
BENCHMARK(answers_without_a_device)->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace jnd::app
