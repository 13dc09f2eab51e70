#include "analysis/fits/same_different_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace jnd::analysis {
namespace same_different_fit_test {

/// Returns ten thousand answers at each quotient, with the proportion of "different" that the
/// model predicts.
std::vector<AnswerCount> exact_answers(double criterion_ln, double spread_ln) {
  std::vector<AnswerCount> data;
  for (const double quotient : {1.0, 1.1, 1.3, 0.8, 1.6}) {
    const double p = different_probability(8.0 * quotient, 8.0, criterion_ln, spread_ln);
    data.push_back({8.0 * quotient, std::lround(10000.0 * p), 10000});
  }
  return data;
}

TEST(SameDifferentFit, FindsTheWeberFractionWhateverTheCriterion) {
  const double spread = std::log(1.25);
  for (const double criterion : {0.1, 0.25, 0.4}) {
    const SameDifferentFit fit = fit_same_different(exact_answers(criterion, spread), 8.0);
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    EXPECT_NEAR(*fit.weber_fraction, 0.25, 2e-3) << criterion;
    EXPECT_NEAR(*fit.criterion_ln, criterion, 2e-3);
    EXPECT_LT(*fit.weber_fraction_ci95.low, 0.25);
    EXPECT_GT(*fit.weber_fraction_ci95.high, 0.25);
    EXPECT_NEAR(*fit.false_alarm_rate, different_probability(8.0, 8.0, criterion, spread),
                2e-3);
  }
}

TEST(SameDifferentFit, AboveAndBelowTheReferenceAreOneSizeOfDifference) {
  const SameDifferentFit both =
      fit_same_different({{8.0, 3, 20}, {10.0, 6, 10}, {6.4, 4, 10}, {16.0, 19, 20}}, 8.0);
  const SameDifferentFit above =
      fit_same_different({{8.0, 3, 20}, {10.0, 10, 20}, {16.0, 19, 20}}, 8.0);
  ASSERT_EQ(both.status, FitStatus::kOk) << both.reason;
  EXPECT_NEAR(*both.weber_fraction, *above.weber_fraction, 1e-8);
}

TEST(SameDifferentFit, DegenerateAnswersSayWhy) {
  const auto reason = [](const std::vector<AnswerCount>& data) {
    const SameDifferentFit fit = fit_same_different(data, 8.0);
    EXPECT_EQ(fit.status, FitStatus::kDegenerate);
    EXPECT_FALSE(fit.weber_fraction.has_value());
    return fit.reason.substr(0, fit.reason.find(':'));
  };
  EXPECT_EQ(reason({{8.0, 0, 9}, {10.0, 0, 9}}), "all alike");
  EXPECT_EQ(reason({{8.0, 9, 9}, {10.0, 9, 9}}), "all alike");
  EXPECT_EQ(reason({{8.0, 0, 9}, {10.0, 4, 9}, {12.0, 9, 9}}), "separated");
  EXPECT_EQ(reason({{8.0, 4, 9}, {10.0, 4, 9}, {12.0, 4, 9}}), "flat");
  EXPECT_EQ(reason({{8.0, 6, 9}, {10.0, 4, 9}, {12.0, 2, 9}}), "flat");
  EXPECT_EQ(reason({{10.0, 4, 9}, {6.4, 4, 9}}), "not identified");
  EXPECT_THROW((void)fit_same_different({{8.0, 4, 9}}, 0.0), core::Error);
  EXPECT_THROW((void)fit_same_different({{8.0, 10, 9}}, 8.0), core::Error);
}

}  // namespace same_different_fit_test
}  // namespace jnd::analysis
