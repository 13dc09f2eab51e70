#include "analysis/fits/shifted_power_fit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <exception>

namespace shifted_power_fit_test {

using namespace jnd::analysis;

const std::vector<double> kIntensities = {1.0, 1.5, 2.5, 4.0, 7.0, 12.0, 20.0};
// These residuals sum to 0 and do not correlate with the intensities.
const std::vector<double> kScatter = {0.04, -0.06, 0.03, 0.02, -0.05, 0.04, -0.02};

template <typename LawOf>
std::vector<Magnitude> rows_of(const LawOf& law, double scatter = 0.0) {
  std::vector<Magnitude> rows;
  for (std::size_t i = 0; i < kIntensities.size(); ++i) {
    rows.push_back({kIntensities[i], law(kIntensities[i]) * std::exp(scatter * kScatter[i])});
  }
  return rows;
}

TEST(ShiftedPowerFit, RecoversThresholdsOffsetsAndPlainLaws) {
  const ShiftedPowerFit threshold =
      fit_shifted_power(rows_of([](double i) { return 2.0 * std::pow(i - 0.6, 0.8); }),
                        PowerMethod::kLogLog, PowerShift::kThreshold);
  ASSERT_EQ(threshold.status, FitStatus::kOk) << threshold.reason;
  EXPECT_NEAR(*threshold.k, 2.0, 1e-4);
  EXPECT_NEAR(*threshold.a, 0.8, 1e-5);
  EXPECT_NEAR(*threshold.intensity_threshold, 0.6, 1e-4);
  const ShiftedPowerFit below =
      fit_shifted_power(rows_of([](double i) { return 2.0 * std::pow(i + 3.0, 1.4); }),
                        PowerMethod::kNonlinear, PowerShift::kThreshold);
  EXPECT_NEAR(*below.intensity_threshold, -3.0, 1e-2);
  EXPECT_NEAR(*below.a, 1.4, 1e-3);
  const ShiftedPowerFit offset =
      fit_shifted_power(rows_of([](double i) { return 0.7 + 2.0 * std::pow(i, 0.6); }),
                        PowerMethod::kNonlinear, PowerShift::kOffset);
  EXPECT_NEAR(*offset.magnitude_offset, 0.7, 1e-6);
  EXPECT_NEAR(*offset.k, 2.0, 1e-6);
  EXPECT_NEAR(*offset.a, 0.6, 1e-7);
  EXPECT_FALSE(offset.no_interval.empty()) << "it passes through every row";
}

TEST(ShiftedPowerFit, AProfileOfAParabolaIsStudentsInterval) {
  // The line is fitted to logarithms, so the squares are a parabola of slope and intercept.
  const std::vector<Magnitude> rows =
      rows_of([](double i) { return 2.0 * std::pow(i, 0.8); }, 1.0);
  const PowerFit wald = fit_power(rows, PowerMethod::kLogLog);
  const ShiftedPowerFit profile =
      fit_shifted_power(rows, PowerMethod::kLogLog, PowerShift::kNone);
  EXPECT_NEAR(*profile.a, *wald.a, 1e-8);
  EXPECT_NEAR(*profile.a_ci95.low, *wald.a_ci95.low, 1e-7);
  EXPECT_NEAR(*profile.a_ci95.high, *wald.a_ci95.high, 1e-7);
  EXPECT_NEAR(*profile.k_ci95.low, *wald.k_ci95.low, 1e-6);
  EXPECT_NEAR(*profile.k_ci95.high, *wald.k_ci95.high, 1e-6);
}

TEST(ShiftedPowerFit, PlainLeastSquaresIsTheFitWithoutAShift) {
  const std::vector<Magnitude> rows =
      rows_of([](double i) { return 2.0 * std::pow(i, 0.8); }, 1.0);
  const PowerFit plain = fit_power(rows, PowerMethod::kNonlinear);
  const ShiftedPowerFit profile =
      fit_shifted_power(rows, PowerMethod::kNonlinear, PowerShift::kNone);
  EXPECT_NEAR(*profile.k, *plain.k, 1e-6);
  EXPECT_NEAR(*profile.a, *plain.a, 1e-7);
  // The profile is not symmetric, but close to the parabola for so little scatter.
  EXPECT_NEAR(*profile.a_ci95.low, *plain.a_ci95.low, 0.005);
  EXPECT_NEAR(*profile.a_ci95.high, *plain.a_ci95.high, 0.005);
}

TEST(ShiftedPowerFit, AThresholdThatIsThereIsFoundAndOneThatIsNotIsNot) {
  const ShiftedPowerFit there =
      fit_shifted_power(rows_of([](double i) { return 2.0 * std::pow(i - 0.8, 0.8); }, 1.0),
                        PowerMethod::kLogLog, PowerShift::kThreshold);
  EXPECT_LT(*there.shift_p_value, 0.001);
  EXPECT_GT(*there.shift_ci95.low, 0.0);
  EXPECT_LT(*there.shift_ci95.high, 1.0);
  EXPECT_LT(*there.shift_ci95.low, 0.8);
  EXPECT_GT(*there.shift_ci95.high, 0.75);
  const ShiftedPowerFit absent =
      fit_shifted_power(rows_of([](double i) { return 2.0 * std::pow(i, 0.8); }, 1.0),
                        PowerMethod::kLogLog, PowerShift::kThreshold);
  EXPECT_GT(*absent.shift_p_value, 0.05);
  EXPECT_LT(*absent.shift_ci95.low, 0.0);
  EXPECT_GT(*absent.shift_ci95.high, 0.0);
}

TEST(ShiftedPowerFit, TooFewRowsAndLogarithmsOfOffsetsAreRefused) {
  const ShiftedPowerFit few =
      fit_shifted_power({{1.0, 1.0}, {2.0, 2.0}}, PowerMethod::kLogLog, PowerShift::kThreshold);
  EXPECT_EQ(few.status, FitStatus::kDegenerate);
  EXPECT_NE(few.reason.find("needs as many intensities"), std::string::npos);
  EXPECT_THROW((void)fit_shifted_power({{1.0, 1.0}}, PowerMethod::kLogLog, PowerShift::kOffset),
               std::exception);
  const ShiftedPowerFit zeros = fit_shifted_power({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}},
                                                  PowerMethod::kNonlinear, PowerShift::kNone);
  EXPECT_EQ(zeros.num_left_out, 1);
  EXPECT_NEAR(*zeros.a, 1.0, 1e-8);
}

/// No k and a are best: the sum of squares falls for ever as a nears 0 and k grows, toward that
/// of a logarithm.
TEST(ShiftedPowerFit, AnOffsetOfMagnitudesThatBendMoreThanALogarithmHasNoFit) {
  const ShiftedPowerFit concave =
      fit_shifted_power({{1, 0.05}, {2, 0.5}, {4, 0.74}, {8, 0.88}, {16, 0.93}, {32, 0.97}},
                        PowerMethod::kNonlinear, PowerShift::kOffset);
  EXPECT_EQ(concave.status, FitStatus::kDegenerate);
  EXPECT_NE(concave.reason.find("a logarithm"), std::string::npos) << concave.reason;
  EXPECT_FALSE(concave.k || concave.a || concave.magnitude_offset);
}

/// The exponent is 0.1, and rows scatter so much that a logarithm does not lie too far off.
TEST(ShiftedPowerFit, NothingBoundsAnExponentFromWhichALogarithmIsNotFar) {
  const ShiftedPowerFit fit =
      fit_shifted_power(rows_of([](double i) { return 2.0 * std::pow(i, 0.1); }, 0.5),
                        PowerMethod::kNonlinear, PowerShift::kOffset);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_GT(*fit.a, 0.0);
  EXPECT_FALSE(fit.a_ci95.low);
  EXPECT_TRUE(fit.a_ci95.high);
  EXPECT_TRUE(fit.k_ci95.low);
  EXPECT_FALSE(fit.k_ci95.high);
  EXPECT_FALSE(fit.shift_ci95.low);
  EXPECT_TRUE(fit.shift_ci95.high);
}

TEST(ShiftedPowerFit, MagnitudesThatAreAllTheSameTellNoThreshold) {
  for (const PowerShift shift : {PowerShift::kThreshold, PowerShift::kOffset}) {
    // The mean of six times 0.1 is not 0.1 in a computer's numbers.
    const ShiftedPowerFit same =
        fit_shifted_power({{1, 0.1}, {2, 0.1}, {4, 0.1}, {8, 0.1}, {16, 0.1}, {32, 0.1}},
                          PowerMethod::kNonlinear, shift);
    EXPECT_EQ(same.status, FitStatus::kDegenerate);
    EXPECT_NE(same.reason.find("all the same"), std::string::npos) << same.reason;
  }
}

}  // namespace shifted_power_fit_test
