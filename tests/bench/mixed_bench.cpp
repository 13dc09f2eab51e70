#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "analysis/mixed/mixed_fit.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// Draws 5,000 trials of nine people in two conditions, each person with an own intercept and
/// slope. The stimuli are at nine levels, or each trial has its own.
MixedData five_thousand_trials(bool at_levels) {
  core::RandomStream stream(1, "mixed bench");
  constexpr int kTrials = 5000, kPeople = 9;
  double place[kPeople], slope[kPeople];
  for (int i = 0; i < kPeople; ++i) {
    place[i] = stream.normal(0.0, 0.5);
    slope[i] = stream.normal(0.0, 0.3);
  }
  MixedData data{.names = {"(Intercept)", "u", "conditionB", "u:conditionB"},
                 .x = Eigen::MatrixXd(kTrials, 4),
                 .terms = {}};
  MixedTerm term{.group = "participant",
                 .names = {"(Intercept)", "u"},
                 .z = Eigen::MatrixXd(kTrials, 2),
                 .place = {},
                 .num_groups = kPeople};
  for (int i = 0; i < kTrials; ++i) {
    const auto person = static_cast<std::uint32_t>(stream.below(kPeople));
    const double u = at_levels ? 0.5 * static_cast<double>(stream.below(9)) - 2.0
                               : stream.uniform(-2.0, 2.0);
    const double b = static_cast<double>(stream.below(2));
    data.x.row(i) << 1.0, u, b, b * u;
    term.z.row(i) << 1.0, u;
    term.place.push_back(person);
    const double eta = 0.2 + place[person] + (1.2 + slope[person]) * u + b * (0.3 + 0.4 * u);
    data.num_yes.push_back(
        stream.with_probability(curve_probability({.link = MixedLink::kProbit}, eta)) ? 1.0
                                                                                      : 0.0);
    data.num_trials.push_back(1.0);
  }
  data.terms = {term};
  return data;
}

void mixed_fit(benchmark::State& state) {
  const MixedData data = five_thousand_trials(state.range(0) == 1);
  const int num_nodes = static_cast<int>(state.range(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_mixed(data, {.num_nodes = num_nodes}));
  }
}
BENCHMARK(mixed_fit)
    ->ArgNames({"at_levels", "nodes"})
    ->Args({1, 1})
    ->Args({0, 1})
    ->Args({1, 9})
    ->Args({0, 9})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::analysis
