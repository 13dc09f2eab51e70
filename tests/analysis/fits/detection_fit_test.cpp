#include "analysis/fits/detection_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/fits/signal_detection.h"
#include "core/error.h"

namespace jnd::analysis {
namespace detection_fit_test {

std::vector<AnswerCount> without_catch() {
  return {{0.1, 1, 20}, {0.2, 6, 20}, {0.4, 13, 20}, {0.8, 19, 20}};
}

TEST(DetectionFit, WithoutCatchTrialsItIsTheCumulativeGaussInLnIntensity) {
  const DetectionFit fit = fit_detection(without_catch());
  const PsychometricFit gauss =
      fit_psychometric(without_catch(), {.reference = 0.3, .free_pse = true});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.threshold, *gauss.pse, 1e-8);
  EXPECT_NEAR(*fit.threshold_ci95.low, *gauss.pse_ci95->low, 1e-7);
  EXPECT_NEAR(*fit.threshold_ci95.high, *gauss.pse_ci95->high, 1e-7);
  EXPECT_NEAR(*fit.spread_ln, std::log1p(*gauss.weber_fraction), 1e-8);
  EXPECT_NEAR(*fit.spread_ln_ci95.high, std::log1p(*gauss.weber_fraction_ci95.high), 1e-7);
  EXPECT_EQ(*fit.false_alarm_rate, 0.0);
  EXPECT_NEAR(*fit.log_likelihood, *gauss.log_likelihood, 1e-10);
}

TEST(DetectionFit, CatchTrialsWithoutAFalseAlarmLeaveTheThreshold) {
  std::vector<AnswerCount> data = without_catch();
  data.push_back({0.0, 0, 40});
  const DetectionFit fit = fit_detection(data);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.threshold, *fit_detection(without_catch()).threshold, 1e-6);
  EXPECT_NEAR(*fit.false_alarm_rate, 0.0, 1e-9);
}

TEST(DetectionFit, FalseAlarmsRaiseTheThreshold) {
  // The answers are exactly g + (1 - g) Phi(z) of 10000 at z = -1, 0, 1 with g = 0.2.
  const std::vector<AnswerCount> data = {
      {0.0, 2000, 10000}, {0.5, 3269, 10000}, {1.0, 6000, 10000}, {2.0, 8731, 10000}};
  const DetectionFit fit = fit_detection(data);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.threshold, 1.0, 1e-3);
  EXPECT_NEAR(*fit.spread_ln, std::log(2.0), 1e-3);
  EXPECT_NEAR(*fit.false_alarm_rate, 0.2, 1e-3);
  EXPECT_LT(*fit_detection({data.begin() + 1, data.end()}).threshold, 0.85);
}

TEST(DetectionFit, DegenerateAnswersSayWhy) {
  const auto reason = [](const std::vector<AnswerCount>& data) {
    const DetectionFit fit = fit_detection(data);
    EXPECT_EQ(fit.status, FitStatus::kDegenerate);
    EXPECT_FALSE(fit.threshold.has_value());
    return fit.reason.substr(0, fit.reason.find(':'));
  };
  EXPECT_EQ(reason({{0.1, 0, 5}, {0.2, 0, 5}, {0.4, 5, 5}}), "separated");
  EXPECT_EQ(reason({{0.1, 0, 5}, {0.2, 3, 5}, {0.4, 5, 5}}), "separated");
  EXPECT_EQ(reason({{0.0, 2, 9}, {0.1, 1, 5}, {0.2, 5, 5}, {0.4, 5, 5}}), "separated");
  EXPECT_EQ(reason({{0.1, 3, 5}, {0.2, 3, 5}, {0.4, 3, 5}}), "flat");
  EXPECT_EQ(reason({{0.1, 4, 5}, {0.2, 3, 5}, {0.4, 1, 5}}), "flat");
  EXPECT_EQ(reason({{0.1, 5, 5}, {0.2, 5, 5}}), "separated");
  EXPECT_EQ(reason({{0.4, 3, 5}}), "not identified");
  EXPECT_EQ(reason({{0.0, 3, 5}}), "not identified");
  EXPECT_THROW((void)fit_detection({{0.1, 6, 5}, {0.2, 5, 5}}), core::Error);
}

TEST(SignalDetection, RatesOfZeroAndOneHaveASensitivity) {
  // The rates are (20.5 / 21, 0.5 / 11), with z = 1.98092 and -1.69062.
  const SignalDetection found = signal_detection({20, 20, 0, 10});
  EXPECT_NEAR(found.d_prime, 1.98092 + 1.69062, 2e-3);
  EXPECT_NEAR(found.criterion, -0.5 * (1.98092 - 1.69062), 2e-3);
  EXPECT_NEAR(signal_detection({5, 10, 5, 10}).d_prime, 0.0, 1e-12);
  EXPECT_THROW((void)signal_detection({5, 10, 0, 0}), core::Error);
  EXPECT_THROW((void)signal_detection({11, 10, 0, 5}), core::Error);
}

}  // namespace detection_fit_test
}  // namespace jnd::analysis
