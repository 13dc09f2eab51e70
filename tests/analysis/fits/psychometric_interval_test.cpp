#include "analysis/fits/psychometric_interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace jnd::analysis {
namespace psychometric_interval_test {

constexpr auto kLikelihood = PsychometricMethod::kMaximumLikelihood;
constexpr auto kLeastSquares = PsychometricMethod::kLeastSquares;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
  std::vector<AnswerCount> data;
  PsychometricMethod method = kLikelihood;
  bool free_pse = false, free_lapse = false;
};

const std::vector<Case> kCases = {
    {{{0.5, 1, 9}, {0.8, 3, 9}, {1.2, 6, 9}, {2.0, 9, 9}}, kLikelihood, true, false},
    {{{0.5, 1, 4}, {0.8, 2, 4}, {1.5, 3, 4}}, kLikelihood, true, false},
    {{{0.5, 2, 20}, {0.8, 4, 20}, {1.2, 15, 20}, {2.0, 18, 20}}, kLikelihood, false, true},
    {{{0.5, 3, 20}, {0.9, 9, 20}, {1.3, 15, 20}, {1.7, 15, 20}, {3.0, 18, 20}},
     kLikelihood,
     true,
     true},
    {{{0.4, 0, 30}, {0.9, 9, 30}, {1.1, 15, 30}, {1.4, 26, 30}, {3.0, 28, 30}},
     kLikelihood,
     true,
     true},
    {{{0.5, 1, 9}, {0.8, 3, 9}, {1.2, 7, 9}, {2.0, 9, 9}}, kLeastSquares, true, false},
    {{{0.5, 2, 20}, {0.8, 6, 20}, {1.2, 15, 20}, {2.0, 18, 20}}, kLeastSquares, false, true},
};

std::string name_of(const Case& one) {
  return std::string(to_string(one.method)) + (one.free_pse ? ", free pse" : "") +
         (one.free_lapse ? ", free lapse" : "") + ", " +
         std::to_string(one.data.front().num_trials) + " trials";
}

PsychometricFit fitted(const Case& one) {
  return fit_psychometric(one.data, {.reference = 1.0,
                                     .method = one.method,
                                     .free_pse = one.free_pse,
                                     .free_lapse = one.free_lapse});
}

double misfit(const Case& one, double w, double pse, double lapse) {
  double sum = 0.0;
  for (const AnswerCount& row : one.data) {
    const double z = std::log(row.intensity / pse) / std::log1p(w);
    const double f = lapse + (1.0 - 2.0 * lapse) * 0.5 * std::erfc(-z / std::sqrt(2.0));
    const auto yes = static_cast<double>(row.num_yes);
    const auto trials = static_cast<double>(row.num_trials);
    if (one.method == kLeastSquares) {
      sum += (f - yes / trials) * (f - yes / trials);
      continue;
    }
    if (yes > 0.0) sum -= yes * std::log(f);
    if (yes < trials) sum -= (trials - yes) * std::log1p(-f);
  }
  return sum;
}

struct Range {
  double low, high;
};

/// Returns the lowest misfit over a box, by a grid that closes in on its best point. It uses no
/// derivatives.
double lowest(const Range& first, const Range& second, const auto& cost) {
  constexpr int kSteps = 60, kRounds = 24;
  Range x = first, y = second;
  double best = kInfinity, best_x = 0.0, best_y = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const double at_x = x.low + (x.high - x.low) * i / kSteps;
        const double at_y = y.low + (y.high - y.low) * j / kSteps;
        const double here = cost(at_x, at_y);
        if (here < best) {
          best = here;
          best_x = at_x;
          best_y = at_y;
        }
        if (y.high == y.low) break;
      }
      if (x.high == x.low) break;
    }
    const auto closer = [](const Range& whole, const Range& now, double at) {
      const double reach = 0.25 * (now.high - now.low);
      return Range{std::max(whole.low, at - reach), std::min(whole.high, at + reach)};
    };
    x = closer(first, x, best_x);
    y = closer(second, y, best_y);
  }
  return best;
}

const Range kLogPse = {-6.0, 6.0}, kLapse = {0.0, 0.499}, kLogLogW = {-6.0, 6.0};

double profile_of_w(const Case& one, double w) {
  return lowest(
      one.free_pse ? kLogPse : Range{0.0, 0.0}, one.free_lapse ? kLapse : Range{0.0, 0.0},
      [&](double log_pse, double lapse) { return misfit(one, w, std::exp(log_pse), lapse); });
}

double profile_of_pse(const Case& one, double pse) {
  return lowest(kLogLogW, one.free_lapse ? kLapse : Range{0.0, 0.0},
                [&](double log_log_w, double lapse) {
                  return misfit(one, std::expm1(std::exp(log_log_w)), pse, lapse);
                });
}

double lowest_allowed(const Case& one, const PsychometricFit& fit) {
  const double at_optimum = misfit(one, *fit.weber_fraction, *fit.pse, *fit.lapse_rate);
  if (one.method == kLikelihood) return at_optimum + 1.920729410347062;
  const int degrees = static_cast<int>(one.data.size()) - 1 - one.free_pse - one.free_lapse;
  return at_optimum *
         (1.0 + boost::math::quantile(boost::math::fisher_f(1.0, degrees), 0.95) / degrees);
}

TEST(PsychometricInterval, EveryEndOfTheWeberFractionIsWhereABruteForceProfileCrosses) {
  int num_ends = 0, num_open = 0;
  for (const Case& one : kCases) {
    SCOPED_TRACE(name_of(one));
    const PsychometricFit fit = fitted(one);
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    const double level = lowest_allowed(one, fit);
    for (const auto& [end, beyond] :
         {std::pair{fit.weber_fraction_ci95.low, 1e-3}, {fit.weber_fraction_ci95.high, 1e3}}) {
      if (end) {
        ++num_ends;
        EXPECT_NEAR(profile_of_w(one, *end), level, 1e-6 * level);
      } else {
        ++num_open;
        EXPECT_LT(profile_of_w(one, beyond), level);
      }
    }
  }
  EXPECT_GT(num_ends, 7);
  EXPECT_GT(num_open, 1);
}

TEST(PsychometricInterval, EveryEndOfThePseIsWhereABruteForceProfileCrosses) {
  int num_ends = 0, num_open = 0;
  for (const Case& one : kCases) {
    if (!one.free_pse) continue;
    SCOPED_TRACE(name_of(one));
    const PsychometricFit fit = fitted(one);
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    const double level = lowest_allowed(one, fit);
    for (const auto& [end, beyond] :
         {std::pair{fit.pse_ci95->low, 0.02}, {fit.pse_ci95->high, 50.0}}) {
      if (end) {
        ++num_ends;
        EXPECT_NEAR(profile_of_pse(one, *end), level, 1e-5 * level);
      } else {
        ++num_open;
        EXPECT_LT(profile_of_pse(one, beyond), level);
      }
    }
  }
  EXPECT_GT(num_ends, 4);
  EXPECT_GT(num_open, 1);
}

TEST(PsychometricInterval, NothingIsReportedPastTheRangeOfNumbers) {
  // The answers rise by less and less. So w grows, its interval opens, and at last there is no
  // fit.
  int num_ok = 0;
  for (std::int64_t rise = 1'000'000; rise >= 1; rise /= 3) {
    for (const bool free_pse : {false, true}) {
      const PsychometricFit fit = fit_psychometric(
          {{0.5, 10'000'000 - rise, 20'000'000}, {2.0, 10'000'000 + rise, 20'000'000}},
          {.reference = 1.0, .free_pse = free_pse});
      for (const std::optional<double>& value :
           {fit.weber_fraction, fit.weber_fraction_ci95.low, fit.weber_fraction_ci95.high,
            fit.standard_error, fit.pse, fit.deviance}) {
        EXPECT_TRUE(!value || std::isfinite(*value)) << rise;
      }
      if (fit.status != FitStatus::kOk) continue;
      ++num_ok;
      EXPECT_GE(fit.weber_fraction_ci95.high.value_or(kInfinity), *fit.weber_fraction);
    }
  }
  EXPECT_GT(num_ok, 4);
}

}  // namespace psychometric_interval_test
}  // namespace jnd::analysis
