#include <benchmark/benchmark.h>

#include "analysis/data/answer_file.h"
#include "analysis/fits/curve_fit.h"
#include "analysis/fits/curve_resamples.h"
#include "analysis/fits/power_fit.h"
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

/// Times the widest search, with everything free.
void weber_fit_free_pse_and_lapse(benchmark::State& state) {
  const auto method = static_cast<PsychometricMethod>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_psychometric(kNineLevels, {.reference = 1.9,
                                                            .method = method,
                                                            .free_pse = true,
                                                            .free_lapse = true,
                                                            .intervals = false}));
  }
}
BENCHMARK(weber_fit_free_pse_and_lapse)->Arg(0)->Arg(1);

void power_fit(benchmark::State& state) {
  const auto solver = static_cast<Solver>(state.range(0));
  const std::vector<Magnitude> data = {{0.5, 0.38}, {1.0, 0.7}, {1.5, 0.84}, {2.0, 1.1},
                                       {2.5, 1.15}, {3.0, 1.4}, {3.5, 1.44}, {4.0, 1.6}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_power(data, PowerMethod::kNonlinear, solver));
  }
}
BENCHMARK(power_fit)->Arg(0)->Arg(1);

/// Times 1000 bootstrap refits of nine levels.
void bootstrap_1000(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        fit_psychometric(kNineLevels, {.reference = 1.9, .num_bootstrap = 1000}));
  }
}
BENCHMARK(bootstrap_1000)->Unit(benchmark::kMillisecond);

void bootstrap_1000_free_lapse(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(fit_psychometric(
        kNineLevels, {.reference = 1.9, .free_lapse = true, .num_bootstrap = 1000}));
  }
}
BENCHMARK(bootstrap_1000_free_lapse)->Unit(benchmark::kMillisecond);

/// Times 1000 refits of `jnd fit psychometric`: plain, with a free lapse rate, and with both
/// rates free.
void curve_refits_1000(benchmark::State& state) {
  const CurveModel model = {.family = CurveFamily::kLogistic,
                            .free_guess = state.range(0) > 1,
                            .free_lapse = state.range(0) > 0};
  const FoundCurve fit = found_curve(kNineLevels, model);
  const std::vector<CurveQuantity> threshold = {{CurveQuantity::Kind::kThreshold, 0.75}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        resampled(fit, model, threshold, 1000, BootstrapKind::kParametric, 1));
  }
}
BENCHMARK(curve_refits_1000)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

/// Times reading and adding up a million trials, at nine intensities or each at its own.
void answers_1e6_rows(benchmark::State& state) {
  std::string text = "x,r\n";
  for (int i = 0; i < 1'000'000; ++i) {
    const int x = state.range(0) > 0 ? (i * 7919) % 1'000'003 : i % 9;
    text += std::to_string(x) + (x * 31 % 7 < 3 ? ",1\n" : ",0\n");
  }
  const AnswerColumns columns = {.intensity = "x", .yes = "r"};
  for (auto _ : state) benchmark::DoNotOptimize(parse_answers(text, "bench", columns));
}
BENCHMARK(answers_1e6_rows)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace jnd::analysis
