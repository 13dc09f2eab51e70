#include "analysis/fits/power_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace power_fit_test {

using testing::HasSubstr;

const std::vector<double> kScale = {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0};

double sum_of_squares(const std::vector<Magnitude>& data, double k, double a) {
  double sum = 0.0;
  for (const Magnitude& row : data) {
    const double residual = row.magnitude - core::PowerFunction{k, a}.magnitude(row.intensity);
    sum += residual * residual;
  }
  return sum;
}

TEST(PowerFit, BothMethodsReturnALawThatTheDataFollow) {
  for (const double k : {0.3761, 0.6663, 250.0}) {
    for (const double a : {-0.7, 0.05, 0.6386, 1.206, 3.0}) {
      std::vector<Magnitude> data;
      for (const double intensity : kScale) {
        data.push_back({intensity, core::PowerFunction{k, a}.magnitude(intensity)});
      }
      for (const PowerMethod method : {PowerMethod::kNonlinear, PowerMethod::kLogLog}) {
        const PowerFit found = fit_power(data, method);
        ASSERT_EQ(found.status, FitStatus::kOk) << k << ' ' << a;
        EXPECT_NEAR(*found.k / k, 1.0, 1e-10);
        EXPECT_NEAR(*found.a, a, 1e-10);
        EXPECT_NEAR(*found.r_squared, 1.0, 1e-10);
      }
    }
  }
}

TEST(PowerFit, LineThroughTheLogarithmsIsWorkedByHand) {
  // ln S = 0, ln 4, ln 4 at ln I = 0, ln 2, ln 4, so the slope is ln 4 / (2 ln 2) = 1.
  const PowerFit found = fit_power({{1, 1}, {2, 4}, {4, 4}}, PowerMethod::kLogLog);
  EXPECT_NEAR(*found.a, 1.0, 1e-14);
  EXPECT_NEAR(*found.k, std::exp(std::log(4.0) * 2.0 / 3.0 - std::log(2.0)), 1e-14);
  EXPECT_NEAR(*found.r_squared, 0.75, 1e-14);
  // The residuals are (-1, 2, -1) ln(2)/3: sse = 6/9 ln^2 2, one degree of freedom, Sxx = 2
  // ln^2 2.
  EXPECT_NEAR(*found.a_standard_error, std::sqrt(1.0 / 3.0), 1e-14);
}

TEST(PowerFit, TheThesisJoinsEstimationAndProductionIntoOneLaw) {
  // Thesis sec. 4: S_ME = 0.6663 I^0.6386, S_MP = 0.3761 I^1.206, joined 0.5145 I^0.9021.
  const PowerFit found = power_between({0.6663, 0.6386}, {0.3761, 1.206}, kScale);
  EXPECT_NEAR(*found.k, 0.51453, 5e-6);
  EXPECT_NEAR(*found.a, 0.90188, 5e-6);
}

TEST(PowerFit, NothingNearTheMinimumIsLower) {
  core::RandomStream random(2, "power test");
  for (int set = 0; set < 50; ++set) {
    std::vector<Magnitude> data;
    for (const double intensity : kScale) data.push_back({intensity, random.uniform(0.0, 3.0)});
    const PowerFit found = fit_power(data);
    if (found.status != FitStatus::kOk) continue;
    const double lowest = sum_of_squares(data, *found.k, *found.a);
    for (double k = 0.02; k < 6.0; k *= 1.07) {
      for (double a = -6.0; a < 9.0; a += 0.05) {
        ASSERT_GE(sum_of_squares(data, k, a), lowest * (1.0 - 1e-12)) << set;
      }
    }
  }
}

TEST(PowerFit, TheIntensitysUnitOnlyChangesTheFactor) {
  const std::vector<Magnitude> data = {{0, 0.1}, {1, 0.7}, {2, 1.1}, {3, 1.2}, {4, 1.7}};
  const PowerFit plain = fit_power(data);
  for (const double factor : {1e-30, 1000.0, 1e30}) {
    std::vector<Magnitude> scaled = data;
    for (Magnitude& row : scaled) row.intensity *= factor;
    const PowerFit found = fit_power(scaled);
    ASSERT_EQ(found.status, FitStatus::kOk);
    EXPECT_NEAR(*found.a / *plain.a, 1.0, 1e-10);
    EXPECT_NEAR(*found.k * std::pow(factor, *plain.a) / *plain.k, 1.0, 1e-10);
    EXPECT_NEAR(*found.a_standard_error / *plain.a_standard_error, 1.0, 1e-9);
  }
}

TEST(PowerFit, TheMagnitudesUnitOnlyChangesTheFactor) {
  const std::vector<Magnitude> data = {{0, 0.1}, {1, 0.7}, {2, 1.1}, {3, 1.2}, {4, 1.7}};
  const PowerFit plain = fit_power(data);
  for (const double factor : {1e-250, 1e-170, 1e170, 1e250}) {
    std::vector<Magnitude> scaled = data;
    for (Magnitude& row : scaled) row.magnitude *= factor;
    const PowerFit found = fit_power(scaled);
    ASSERT_EQ(found.status, FitStatus::kOk) << factor << found.reason;
    EXPECT_NEAR(*found.a, *plain.a, 1e-10);
    EXPECT_NEAR(*found.k / factor, *plain.k, 1e-10);
    EXPECT_NEAR(*found.r_squared, *plain.r_squared, 1e-10);
    EXPECT_NEAR(*found.k_standard_error / factor, *plain.k_standard_error, 1e-10);
  }
}

TEST(PowerFit, MagnitudesAllAlikeHaveNoRSquared) {
  for (const PowerMethod method : {PowerMethod::kNonlinear, PowerMethod::kLogLog}) {
    std::vector<Magnitude> data;
    for (double intensity = 1.0; intensity < 12.0; intensity += 1.0) {
      data.push_back({intensity, 0.6});  // Rounding moves the mean of eleven logarithms.
      const PowerFit found = fit_power(data, method);
      if (data.size() < 2) continue;
      ASSERT_EQ(found.status, FitStatus::kOk);
      EXPECT_FALSE(found.r_squared.has_value()) << *found.r_squared;
    }
  }
}

TEST(PowerFit, BothSolversComeToOneOptimum) {
  core::RandomStream random(4, "power test");
  int num_fits = 0;
  for (int set = 0; set < 300; ++set) {
    std::vector<Magnitude> data;
    for (const double intensity : kScale) {
      data.push_back({intensity, random.uniform(-0.5, 3.0)});
    }
    const PowerFit ceres = fit_power(data, PowerMethod::kNonlinear, Solver::kCeres);
    const PowerFit newton = fit_power(data, PowerMethod::kNonlinear, Solver::kNewton);
    ASSERT_EQ(ceres.status, newton.status) << set << ceres.reason << newton.reason;
    if (ceres.status != FitStatus::kOk) continue;
    ++num_fits;
    EXPECT_NEAR(*ceres.a, *newton.a, 1e-9 * (1.0 + std::fabs(*newton.a))) << set;
    EXPECT_NEAR(*ceres.k / *newton.k, 1.0, 1e-9) << set;
  }
  EXPECT_GT(num_fits, 200);
}

TEST(PowerFit, LogarithmsLeaveOutZerosAndSayWhichRows) {
  const PowerFit found =
      fit_power({{0, 0.2}, {1, 0.0}, {2, 1.0}, {4, 2.0}, {8, 4.0}}, PowerMethod::kLogLog);
  ASSERT_EQ(found.excluded.size(), 2U);
  EXPECT_EQ(found.excluded[0].row, 0U);
  EXPECT_THAT(found.excluded[0].reason, HasSubstr("intensity"));
  EXPECT_EQ(found.excluded[1].row, 1U);
  EXPECT_THAT(found.excluded[1].reason, HasSubstr("magnitude"));
  EXPECT_EQ(found.num_rows, 3);
  EXPECT_NEAR(*found.a, 1.0, 1e-14);
}

TEST(PowerFit, TwoRowsHaveNoStandardErrors) {
  for (const PowerMethod method : {PowerMethod::kNonlinear, PowerMethod::kLogLog}) {
    const PowerFit found = fit_power({{1, 0.5}, {4, 1.0}}, method);
    ASSERT_EQ(found.status, FitStatus::kOk);
    EXPECT_NEAR(*found.a, 0.5, 1e-12);
    EXPECT_FALSE(found.k_standard_error.has_value());
    EXPECT_FALSE(found.a_ci95.low.has_value());
  }
}

TEST(PowerFit, SaysWhyThereIsNoLaw) {
  const auto reason = [](const std::vector<Magnitude>& data) {
    const PowerFit found = fit_power(data);
    EXPECT_EQ(found.status, FitStatus::kDegenerate);
    EXPECT_FALSE(found.k.has_value());
    return found.reason;
  };
  EXPECT_THAT(reason({}), HasSubstr("too few rows"));
  EXPECT_THAT(reason({{1, 1}}), HasSubstr("too few rows"));
  EXPECT_THAT(reason({{0, 0}, {2, 1}, {2, 1.5}}), HasSubstr("two different intensities"));
  EXPECT_THAT(reason({{1, 0}, {2, 0}}), HasSubstr("all magnitudes are 0"));
  EXPECT_THAT(reason({{1, 0}, {2, 0}, {3, 1}}), HasSubstr("highest"));
  EXPECT_THAT(reason({{1, 1}, {2, 0}, {3, 0}}), HasSubstr("lowest"));
  EXPECT_THAT(reason({{1, -1}, {2, -2}}), HasSubstr("no k > 0"));
}

TEST(PowerFit, RefusesWhatIsNoMagnitude) {
  EXPECT_THROW((void)fit_power({{-1, 1}}), core::Error);
  EXPECT_THROW((void)fit_power({{1, std::nan("")}}), core::Error);
}

TEST(PowerFit, OneDegreeOfFreedomGivesStandardErrorsButNoInterval) {
  for (const PowerMethod method : {PowerMethod::kNonlinear, PowerMethod::kLogLog}) {
    const PowerFit three = fit_power({{1, 1}, {2, 4}, {4, 4}}, method);
    EXPECT_TRUE(three.a_standard_error.has_value());
    EXPECT_FALSE(three.a_ci95.low || three.a_ci95.high || three.k_ci95.low);
    const PowerFit four = fit_power({{1, 1}, {2, 4}, {4, 4}, {8, 9}}, method);
    EXPECT_TRUE(four.a_ci95.low && four.a_ci95.high && four.k_ci95.low);
  }
}

TEST(PowerFit, RowsAtIntensityZeroTellNothingAndAreNoDegreesOfFreedom) {
  const std::vector<Magnitude> three = {{1, 1}, {2, 3}, {4, 3}};
  std::vector<Magnitude> with_zeros(9, {0, 0});
  with_zeros.insert(with_zeros.end(), three.begin(), three.end());
  const PowerFit alone = fit_power(three), found = fit_power(with_zeros);
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_EQ(found.num_at_zero, 9);
  EXPECT_EQ(alone.num_at_zero, 0);
  EXPECT_EQ(found.num_rows, 3);
  ASSERT_EQ(found.excluded.size(), 9U);
  EXPECT_THAT(found.excluded[8].reason, HasSubstr("the intensity is 0"));
  EXPECT_EQ(found.k, alone.k);
  EXPECT_EQ(found.a, alone.a);
  EXPECT_EQ(found.a_standard_error, alone.a_standard_error);
  EXPECT_EQ(found.r_squared, alone.r_squared);
  EXPECT_FALSE(found.a_ci95.low || found.a_ci95.high) << "three rows have no interval";
}

TEST(PowerFit, SomethingFeltAtZeroDoesNotHideAFallingLaw) {
  // 0^a is infinite for a < 0, so the magnitude 20 at intensity 0 is no row that the law could
  // fit.
  const PowerFit found = fit_power({{0, 20}, {1, 10}, {2, 5}, {4, 2.6}, {8, 1.2}});
  EXPECT_NEAR(*found.a, -0.993, 5e-4);
  EXPECT_GT(*found.r_squared, 0.99);
  EXPECT_LT(*found.a_ci95.high, -0.9);
  EXPECT_GT(*found.a_ci95.low, -1.1);
}

TEST(PowerFit, ALawThroughEveryRowHasNoInterval) {
  for (const PowerMethod method : {PowerMethod::kNonlinear, PowerMethod::kLogLog}) {
    const PowerFit line = fit_power({{1, 2}, {2, 4}, {3, 6}, {4, 8}}, method);
    EXPECT_THAT(line.no_interval, HasSubstr("passes through every row"));
    EXPECT_FALSE(line.k_ci95.low || line.k_ci95.high || line.a_ci95.low || line.a_ci95.high);
    const PowerFit alike = fit_power({{1, 1}, {2, 1}, {3, 1}, {4, 1}}, method);
    EXPECT_THAT(alike.no_interval, HasSubstr("passes through every row"));
    EXPECT_FALSE(alike.k_ci95.low);
    EXPECT_EQ(fit_power({{1, 2}, {2, 4}, {3, 6}, {4, 8.01}}, method).no_interval, "");
  }
}

TEST(PowerFit, AMagnitudeBelowZeroIsNotTakenSilently) {
  EXPECT_EQ(fit_power({{1, -1}, {2, 2}, {4, 4}}).warnings.size(), 1U);
  EXPECT_TRUE(fit_power({{0, 0}, {2, 2}, {4, 4}}).warnings.empty());
}

}  // namespace power_fit_test
}  // namespace jnd::analysis
