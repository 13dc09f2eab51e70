#include "analysis/fits/calibrated_drop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/fits/psychometric_fit.h"
#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace calibrated_drop_test {

/// Returns the drops for a line of slope 1 through 0 at eight places, each with `num_trials`
/// answers.
CalibratedDrops drops_at(double num_trials, std::uint64_t seed = 7, int num_redraws = 2000) {
  Eigen::MatrixXd design = Eigen::MatrixXd::Ones(8, 2);
  for (Eigen::Index row = 0; row < 8; ++row)
    design(row, 0) = -1.75 + 0.5 * static_cast<double>(row);
  return calibrated_drops(design, Eigen::VectorXd::Constant(8, num_trials),
                          Eigen::Vector2d(1.0, 0.0), true, num_redraws, seed);
}

TEST(CalibratedDrops, AreThoseOfChiSquaredWhereAnswersAreMany) {
  // The standard error of a 95 % quantile of 20,000 ratios is 0.05, and a drop is half of a
  // ratio.
  const CalibratedDrops drops = drops_at(1000.0, 7, 20'000);
  EXPECT_NEAR(drops.slope, kLikelihoodDrop, 0.08);
  EXPECT_NEAR(drops.pse, kLikelihoodDrop, 0.08);
  EXPECT_GE(drops.slope, kLikelihoodDrop);
}

TEST(CalibratedDrops, AreLargerWhereAnswersAreFew) {
  EXPECT_GT(drops_at(5.0).slope, kLikelihoodDrop + 0.1);
}

TEST(CalibratedDrops, TheSameSeedGivesTheSame) {
  EXPECT_EQ(drops_at(5.0, 3).slope, drops_at(5.0, 3).slope);
  EXPECT_NE(drops_at(5.0, 3).slope, drops_at(5.0, 4).slope);
}

std::vector<AnswerCount> rows_of(std::int64_t num_trials, bool has_orders) {
  std::vector<AnswerCount> rows;
  for (const double x : {0.6, 0.75, 0.9, 1.1, 1.3, 1.6}) {
    const double yes = static_cast<double>(num_trials) *
                       core::standard_normal_cdf(std::log(x) / std::log1p(0.3));
    rows.push_back({x, std::llround(yes), num_trials, has_orders ? kTestFirst : 0.0});
    if (has_orders) rows.push_back({x, std::llround(yes), num_trials, kTestSecond});
  }
  return rows;
}

double width(const std::optional<Interval>& interval) {
  return interval && interval->low && interval->high ? *interval->high - *interval->low : NAN;
}

TEST(CalibratedDrops, WidenWhatHasOtherParametersAtFewAnswers) {
  for (const bool has_orders : {false, true}) {
    const auto fit_of = [&](std::int64_t num_trials, bool free_pse, int num_calibration) {
      return fit_psychometric(rows_of(num_trials, has_orders),
                              {.reference = 1.0,
                               .free_pse = free_pse,
                               .by_order = true,
                               .num_calibration = num_calibration});
    };
    const PsychometricFit plain = fit_of(5, true, 0), wider = fit_of(5, true, 500);
    EXPECT_GT(width(wider.weber_fraction_ci95), 1.02 * width(plain.weber_fraction_ci95));
    EXPECT_GT(width(wider.pse_ci95), 1.005 * width(plain.pse_ci95));
    EXPECT_EQ(plain.warnings.size(), wider.warnings.size() + 1) << "told of few answers";
    const double fixed = width(fit_of(5, false, 0).weber_fraction_ci95);
    const double calibrated = width(fit_of(5, false, 500).weber_fraction_ci95);
    if (has_orders) {
      EXPECT_GT(calibrated, 1.01 * fixed);
    } else {
      EXPECT_EQ(calibrated, fixed);
    }
    EXPECT_EQ(width(fit_of(40, true, 0).weber_fraction_ci95),
              width(fit_of(40, true, 500).weber_fraction_ci95));
  }
}

constexpr double kTrue = 0.7;

/// Draws answers at the levels of group D of the study `viscosity_discrimination`, five for
/// each level, with the test in either interval.
std::vector<AnswerCount> drawn_answers(core::RandomStream& random) {
  std::vector<AnswerCount> rows;
  int number = 0;
  for (const double x : {0.590, 0.668, 0.888, 0.944, 1.189, 1.378, 1.719, 2.096}) {
    const double p = core::standard_normal_cdf(std::log(x) / std::log1p(kTrue));
    AnswerCount first{.intensity = x, .order = kTestFirst};
    AnswerCount second{.intensity = x, .order = kTestSecond};
    for (int trial = 0; trial < 5; ++trial) {
      AnswerCount& row = number++ % 2 == 0 ? first : second;
      ++row.num_trials;
      row.num_yes += random.with_probability(p) ? 1 : 0;
    }
    rows.push_back(first);
    rows.push_back(second);
  }
  return rows;
}

bool holds(const Interval& interval) {
  return !(interval.low && kTrue < *interval.low) && !(interval.high && kTrue > *interval.high);
}

TEST(CalibratedDrops, HoldTheTruthWherePlainIntervalsDoSoTooRarely) {
  constexpr int kSets = 600;
  core::RandomStream random(3, "calibrated drops");
  int num_fits = 0, num_plain = 0, num_calibrated = 0;
  for (int set = 0; set < kSets; ++set) {
    const std::vector<AnswerCount> rows = drawn_answers(random);
    const auto fit_with = [&](int num_calibration) {
      return fit_psychometric(rows, {.reference = 1.0,
                                     .free_pse = true,
                                     .by_order = true,
                                     .num_calibration = num_calibration,
                                     .solver = Solver::kNewton});
    };
    const PsychometricFit plain = fit_with(0);
    if (plain.status != FitStatus::kOk) continue;
    ++num_fits;
    num_plain += holds(plain.weber_fraction_ci95) ? 1 : 0;
    num_calibrated += holds(fit_with(200).weber_fraction_ci95) ? 1 : 0;
  }
  // Both counts use the same sets, so one of the two conditions fails if both intervals are
  // alike.
  EXPECT_LT(num_plain, 0.93 * num_fits);
  EXPECT_GT(num_calibrated, 0.93 * num_fits);
}

TEST(CalibratedDrops, AreOfTheWeberCurveByMaximumLikelihoodAndOfManyRedraws) {
  for (const PsychometricOptions& options :
       {PsychometricOptions{.reference = 1.0, .free_lapse = true, .num_calibration = 200},
        PsychometricOptions{.reference = 1.0,
        .method = PsychometricMethod::kLeastSquares,
        .num_calibration = 200},
        PsychometricOptions{.reference = 1.0, .guess_rate = 0.5, .num_calibration = 200},
        PsychometricOptions{.reference = 1.0, .free_pse = true, .num_calibration = 199}}) {
    EXPECT_THROW((void)fit_psychometric(rows_of(5, false), options), core::Error);
  }
}

}  // namespace calibrated_drop_test
}  // namespace jnd::analysis
