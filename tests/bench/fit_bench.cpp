#include <benchmark/benchmark.h>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {
namespace {

const std::vector<AnswerCount> kNineLevels = {{1.0, 1, 65},  {1.3, 9, 65},  {1.6, 20, 65},
                                              {1.8, 29, 65}, {2.0, 37, 65}, {2.3, 45, 65},
                                              {2.7, 52, 65}, {3.2, 60, 65}, {4.0, 64, 65}};

void weber_fit(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_psychometric(kNineLevels, {.reference = 1.9}));
  }
}
BENCHMARK(weber_fit);

void weber_fit_least_squares(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_psychometric(
        kNineLevels,
        {.reference = 1.9, .method = PsychometricMethod::kLeastSquares, .intervals = false}));
  }
}
BENCHMARK(weber_fit_least_squares);

/// 1000 bootstrap refits of nine levels.
void bootstrap_1000(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        fit_psychometric(kNineLevels, {.reference = 1.9, .num_bootstrap = 1000}));
  }
}
BENCHMARK(bootstrap_1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::analysis
