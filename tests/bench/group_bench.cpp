#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// Draws 13 people in two conditions, with five answers at each of eight levels.
std::vector<ParticipantAnswers> group_of_thirteen() {
  core::RandomStream random(6, "group bench");
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < 13; ++person) {
    const double own = 0.3 * random.normal(), place = 0.1 * random.normal();
    for (const double w : {0.7, 0.3}) {
      ParticipantAnswers one{std::to_string(person), w == 0.7 ? "d" : "e", 1.0, {}};
      const double slope = std::exp(own) / std::log1p(w);
      for (const double x : {0.59, 0.67, 0.89, 0.94, 1.19, 1.38, 1.72, 2.1}) {
        AnswerCount row{.intensity = x, .num_trials = 5};
        const double yes = core::standard_normal_cdf(slope * (std::log(x) - place));
        for (int trial = 0; trial < 5; ++trial) row.num_yes += random.with_probability(yes);
        one.rows.push_back(row);
      }
      all.push_back(std::move(one));
    }
  }
  return all;
}

/// Measures a fit of both conditions at once, with correlated slopes. Argument 0: pse at the
/// reference, 1: common pse, 2: one shift for each person, 3: an own pse in each condition, 4:
/// as 3 with a lapse rate, which the results call primary.
void hierarchical_fit(benchmark::State& state) {
  const std::vector<ParticipantAnswers> answers = group_of_thirteen();
  HierarchicalOptions options{
      .pse = static_cast<HierarchicalPse>(std::min<std::int64_t>(state.range(0), 3))};
  if (state.range(0) == 4) options.lapses = HierarchicalLapses::kCommon;
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_hierarchical(answers, options));
  }
}
BENCHMARK(hierarchical_fit)->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::analysis
