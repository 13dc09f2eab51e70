#include <cstdio>
#include <string>
#include <vector>

#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/curve_fit.h"
#include "analysis/fits/signal_detection.h"
#include "bench/coverage_people.h"

namespace jnd::coverage {
namespace {

/// A known curve with location 0.2 and scale 0.7, at seven levels from -2 to 2.
struct TrueCurve {
  std::string words;
  CurveModel model;
  double guess = 0.0, lapse = 0.0;

  [[nodiscard]] CurveFit curve(double location) const {
    CurveFit curve;
    curve.model = model;
    curve.location.value = location;
    curve.scale.value = 0.7;
    curve.guess_rate.value = guess;
    curve.lapse_rate.value = lapse;
    return curve;
  }
};

std::vector<AnswerCount> drawn_from(const CurveFit& curve, int num_trials,
                                    RandomStream& random) {
  std::vector<AnswerCount> rows;
  for (int level = -3; level <= 3; ++level) {
    AnswerCount row{.intensity = 2.0 * level / 3.0, .num_trials = num_trials};
    const double p = curve.probability(row.intensity);
    for (int trial = 0; trial < num_trials; ++trial) {
      row.num_yes += random.with_probability(p) ? 1 : 0;
    }
    rows.push_back(row);
  }
  return rows;
}

/// Covers the threshold, the JND and the slope at level 0.75 of the curve, with four kinds of
/// intervals.
std::string cover_curve(const TrueCurve& truth, int num_trials, int num_sets,
                        std::uint64_t seed) {
  RandomStream random(seed, "coverage of a psychometric function " + truth.words, {num_trials});
  const double unit = sigmoid_quantile(traits_of(truth.model.family).sigmoid, 0.75);
  const CurveFit curve = truth.curve(0.2);
  const double threshold = 0.2 + 0.7 * unit;
  const double slope = (1.0 - truth.guess - truth.lapse) *
                       sigmoid_tails(traits_of(truth.model.family).sigmoid, unit).density / 0.7;
  struct Kinds {
    Coverage ratio, bootstrap, corrected, posterior;
    void add(bool exists, const CurveValue& value, double truth) {
      ratio.add(exists, value.ci95, truth);
      bootstrap.add(exists, value.bootstrap_ci95, truth);
      corrected.add(exists, value.bca_ci95, truth);
      posterior.add(exists, value.posterior_ci95, truth);
    }
  } of_threshold, of_jnd, of_slope;
  for (int set = 0; set < num_sets; ++set) {
    const CurveFit fit = fit_curve(drawn_from(curve, num_trials, random),
                                   {.model = truth.model,
                                    .at = {0.75},
                                    .jnd_at = 0.75,
                                    .num_bootstrap = 400,
                                    .posterior = true,
                                    .seed = seed + static_cast<std::uint64_t>(set)});
    const bool exists = fit.status == FitStatus::kOk;
    of_threshold.add(exists, fit.thresholds[0].intensity, threshold);
    of_jnd.add(exists, fit.jnd, 0.7 * unit);
    of_slope.add(exists, fit.thresholds[0].slope, slope);
  }
  std::vector<std::string> cells = {truth.words, std::to_string(num_trials)};
  for (const Kinds* kinds : {&of_threshold, &of_jnd, &of_slope}) {
    for (const Coverage* one :
         {&kinds->ratio, &kinds->bootstrap, &kinds->corrected, &kinds->posterior}) {
      cells.push_back(one->words());
    }
  }
  cells.push_back(std::to_string(of_threshold.ratio.num_without));
  return row_of(cells);
}

std::string cover_contrast(const TrueCurve& truth, int num_trials, int num_sets,
                           std::uint64_t seed) {
  RandomStream random(seed, "coverage of a contrast " + truth.words, {num_trials});
  Coverage ratio, bootstrap;
  int num_found = 0, num_compared = 0;
  for (int set = 0; set < num_sets; ++set) {
    const CurveOptions how = {.model = truth.model,
                              .num_bootstrap = 400,
                              .seed = seed + static_cast<std::uint64_t>(set)};
    const CurveComparison apart =
        compare_curves({{"a", drawn_from(truth.curve(0.0), num_trials, random)},
                        {"b", drawn_from(truth.curve(0.3), num_trials, random)}},
                       how);
    const bool exists = apart.status == FitStatus::kOk;
    ratio.add(exists, exists ? apart.contrasts[0].difference.ci95 : Interval{}, 0.3);
    bootstrap.add(exists, exists ? apart.contrasts[0].difference.bootstrap_ci95 : Interval{},
                  0.3);
    CurveOptions plain = how;
    plain.num_bootstrap = 0;
    const CurveComparison same =
        compare_curves({{"a", drawn_from(truth.curve(0.0), num_trials, random)},
                        {"b", drawn_from(truth.curve(0.0), num_trials, random)}},
                       plain);
    if (same.status != FitStatus::kOk || !same.contrasts[0].p_value) continue;
    ++num_compared;
    num_found += *same.contrasts[0].p_value < 0.05;
  }
  char share[32];
  std::snprintf(share, sizeof share, "%.1f %%",
                num_compared > 0 ? 100.0 * num_found / num_compared : 0.0);
  return row_of({truth.words, std::to_string(num_trials), ratio.words(), bootstrap.words(),
                 share, std::to_string(ratio.num_without)});
}

std::string cover_d_prime(double d_prime, int num_trials, int num_sets, std::uint64_t seed) {
  RandomStream random(seed, "coverage of d'",
                      {static_cast<std::int64_t>(10.0 * d_prime), num_trials});
  Coverage of_d_prime, of_criterion;
  const double hit = sigmoid_tails(Sigmoid::kNormal, 0.5 * d_prime).lower;
  for (int set = 0; set < num_sets; ++set) {
    DetectionCounts counts{.num_signals = num_trials, .num_catch = num_trials};
    for (int trial = 0; trial < num_trials; ++trial) {
      counts.num_hits += random.with_probability(hit) ? 1 : 0;
      counts.num_false_alarms += random.with_probability(1.0 - hit) ? 1 : 0;
    }
    const SignalDetection found = signal_detection(counts);
    const auto [low, high] = found.d_prime_ci95();
    const auto [least, most] = found.criterion_ci95();
    of_d_prime.add(true, {low, high}, d_prime);
    of_criterion.add(true, {least, most}, 0.0);
  }
  char words[16];
  std::snprintf(words, sizeof words, "%.1f", d_prime);
  return row_of({words, std::to_string(num_trials), of_d_prime.words(), of_criterion.words()});
}

}  // namespace

void cover_curves(int num_sets, std::uint64_t seed) {
  const std::vector<TrueCurve> curves = {
      {"normal", {.family = CurveFamily::kNormal}},
      {"logistic, guess 1/2, lapse free",
       {.family = CurveFamily::kLogistic, .guess_rate = 0.5, .free_lapse = true},
       0.5,
       0.03},
      {"normal, guess and lapse free",
       {.family = CurveFamily::kNormal, .free_guess = true, .free_lapse = true},
       0.05,
       0.03},
  };
  std::printf(
      "\n## Psychometric functions of anybody's answers\n\n%d data sets of seven levels, "
      "location 0.2, scale 0.7. At level 0.75: LR likelihood ratio, P percentiles of 400 "
      "parametric refits,\nBCa these corrected, B the posterior.\n\n",
      num_sets);
  print_row({"curve", "answers a level", "threshold LR", "P", "BCa", "B", "JND LR", "P", "BCa",
             "B", "slope LR", "P", "BCa", "B", "sets without a fit"});
  std::printf(
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | "
      "--- |\n");
  std::vector<std::function<std::string()>> rows;
  for (const TrueCurve& curve : curves) {
    for (const int num_trials : {20, 60}) {
      rows.emplace_back([=] { return cover_curve(curve, num_trials, num_sets, seed); });
    }
  }
  print_rows(rows);
  std::printf(
      "\n## Two curves compared\n\n%d pairs whose thresholds are 0.3 apart; false alarms: how "
      "often p < 0.05 where they are equal.\n\n",
      num_sets);
  print_row({"curve", "answers a level", "difference LR", "difference, bootstrap",
             "false alarms", "pairs without a fit"});
  std::printf("| --- | --- | --- | --- | --- | --- |\n");
  rows.clear();
  for (const TrueCurve& curve : curves) {
    rows.emplace_back([=] { return cover_contrast(curve, 30, num_sets, seed); });
  }
  print_rows(rows);
  std::printf("\n## d' and criterion\n\n%d data sets; log-linear correction.\n\n", num_sets);
  print_row({"d'", "stimuli, and catch trials", "d'", "criterion"});
  std::printf("| --- | --- | --- | --- |\n");
  rows.clear();
  for (const double d_prime : {0.5, 1.5, 2.5}) {
    for (const int num_trials : {25, 100}) {
      rows.emplace_back([=] { return cover_d_prime(d_prime, num_trials, num_sets, seed); });
    }
  }
  print_rows(rows);
}

}  // namespace jnd::coverage
