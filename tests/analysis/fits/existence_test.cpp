#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "core/random_stream.h"

// Checks whether a fit exists by a fine scan that shares nothing with the fits: neither their
// costs, nor their limits, nor their search.

namespace jnd::analysis {
namespace existence_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double phi(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// Returns the misfit of the probabilities f: minus the log-likelihood, or the sum of squares.
double misfit(const std::vector<AnswerCount>& data, const std::vector<double>& f,
              PsychometricMethod method) {
  double sum = 0.0;
  for (std::size_t row = 0; row < data.size(); ++row) {
    const auto yes = static_cast<double>(data[row].num_yes);
    const auto trials = static_cast<double>(data[row].num_trials);
    if (method == PsychometricMethod::kLeastSquares) {
      sum += (f[row] - yes / trials) * (f[row] - yes / trials);
      continue;
    }
    if (yes > 0.0) sum -= yes * std::log(f[row]);
    if (yes < trials) sum -= (trials - yes) * std::log1p(-f[row]);
  }
  return sum;
}

/// Returns the lowest misfit over slopes in z per ln(intensity), from almost flat to a step
/// between the closest levels. A free pse may put each level anywhere on the curve.
double lowest_of_scan(const std::vector<AnswerCount>& data, PsychometricMethod method,
                      bool free_pse) {
  double lowest = kInfinity;
  std::vector<double> f(data.size());
  const auto consider = [&](double slope, double offset) {
    for (std::size_t row = 0; row < data.size(); ++row) {
      f[row] = phi(slope * std::log(data[row].intensity) + offset);
    }
    lowest = std::min(lowest, misfit(data, f, method));
  };
  for (double slope = 1e-3; slope < 1000.0; slope *= 1.1) {
    if (!free_pse) consider(slope, 0.0);
    for (std::size_t row = 0; free_pse && row < data.size(); ++row) {
      for (double z = -5.0; z <= 5.0; z += 0.1) {
        consider(slope, z - slope * std::log(data[row].intensity));
      }
    }
  }
  return lowest;
}

/// Returns the lowest misfit of the limits: an infinite slope, where one level may lie anywhere
/// on the step if the pse is free to lie there; a slope of 0; and, with a free pse, a pse that
/// diverges.
double lowest_of_limits(const std::vector<AnswerCount>& data, PsychometricMethod method,
                        bool free_pse) {
  double yes = 0.0, trials = 0.0, shares = 0.0;
  for (const AnswerCount& row : data) {
    yes += static_cast<double>(row.num_yes);
    trials += static_cast<double>(row.num_trials);
    shares += static_cast<double>(row.num_yes) / static_cast<double>(row.num_trials);
  }
  const bool squares = method == PsychometricMethod::kLeastSquares;
  const double mean = squares ? shares / static_cast<double>(data.size()) : yes / trials;
  std::vector<double> f(data.size(), free_pse ? mean : 0.5);
  double lowest = misfit(data, f, method);
  // The steps lie at each level and just above it. A pse that diverges is a step beyond them
  // all.
  std::vector<double> steps = {1.0};
  if (free_pse) {
    for (const AnswerCount& row : data) steps.push_back(row.intensity);
  }
  for (const double step : steps) {
    for (const double beyond : {0.0, 1e-9, -1e-9}) {
      if (!free_pse && beyond != 0.0) continue;
      for (std::size_t row = 0; row < data.size(); ++row) {
        const double distance = data[row].intensity - step - beyond;
        const double share =
            static_cast<double>(data[row].num_yes) / static_cast<double>(data[row].num_trials);
        f[row] = distance < 0.0 ? 0.0 : distance > 0.0 ? 1.0 : free_pse ? share : 0.5;
      }
      lowest = std::min(lowest, misfit(data, f, method));
    }
  }
  return lowest;
}

std::string printed(const std::vector<AnswerCount>& data) {
  std::string text;
  for (const AnswerCount& row : data) {
    text += " {" + std::to_string(row.intensity) + ", " + std::to_string(row.num_yes) + ", " +
            std::to_string(row.num_trials) + "}";
  }
  return text;
}

TEST(Existence, APsychometricFitIsOkJustWhereAFineScanHasAnInteriorOptimum) {
  core::RandomStream random(5, "existence test");
  const double intensities[] = {0.5, 0.8, 1.25, 1.6, 2.0, 1.0};
  int num_ok = 0, num_degenerate = 0;
  for (int set = 0; set < 250; ++set) {
    std::vector<AnswerCount> data;
    const std::size_t num_levels = 2 + random.below(3);
    while (data.size() < num_levels) {
      const double intensity = intensities[random.below(6)];
      if (std::any_of(data.begin(), data.end(),
                      [&](const AnswerCount& row) { return row.intensity == intensity; })) {
        continue;
      }
      const auto num_trials = static_cast<std::int64_t>(1 + random.below(4));
      data.push_back(
          {intensity,
           static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(num_trials) + 1)),
           num_trials});
    }
    for (const PsychometricMethod method :
         {PsychometricMethod::kMaximumLikelihood, PsychometricMethod::kLeastSquares}) {
      for (const bool free_pse : {false, true}) {
        SCOPED_TRACE(std::string(to_string(method)) + (free_pse ? ", free pse" : "") +
                     printed(data));
        const PsychometricFit fit =
            fit_psychometric(data, {.reference = 1.0, .method = method, .free_pse = free_pse});
        const double on_scan = lowest_of_scan(data, method, free_pse);
        const double limit = lowest_of_limits(data, method, free_pse);
        if (fit.status == FitStatus::kOk) {
          ++num_ok;
          std::vector<double> f;
          for (const AnswerCount& row : data) {
            f.push_back(
                phi(std::log(row.intensity / *fit.pse) / std::log1p(*fit.weber_fraction)));
          }
          const double fitted = misfit(data, f, method);
          EXPECT_LT(fitted, limit);
          EXPECT_LE(fitted, on_scan + 1e-12);
        } else {
          ++num_degenerate;
          EXPECT_EQ(fit.status, FitStatus::kDegenerate);
          EXPECT_NE(fit.reason, "");
          EXPECT_GE(on_scan, limit - 1e-12) << fit.reason;
        }
      }
    }
  }
  EXPECT_GT(num_ok, 250);
  EXPECT_GT(num_degenerate, 300);
}

TEST(Existence, APowerFitIsOkJustWhereAFineScanHasAnInteriorOptimum) {
  core::RandomStream random(6, "existence test");
  int num_ok = 0, num_degenerate = 0;
  for (int set = 0; set < 300; ++set) {
    std::vector<Magnitude> data;
    const std::size_t num_rows = 2 + random.below(4);
    for (std::size_t row = 0; row < num_rows; ++row) {
      data.push_back({static_cast<double>(1 + random.below(4)),
                      static_cast<double>(random.below(4)) - 1.0});
    }
    // For each exponent, the best k > 0 has a closed form.
    double interior = kInfinity, edge = 0.0;
    // This is the misfit at k = 0.
    for (const Magnitude& row : data) edge += row.magnitude * row.magnitude;
    for (double a = -200.0; a <= 200.0; a += 0.02) {
      const double top = a > 0.0 ? 4.0 : 1.0;
      double products = 0.0, squares = 0.0, sum = 0.0;
      for (const Magnitude& row : data) {
        const double e = std::pow(row.intensity / top, a);
        products += row.magnitude * e;
        squares += e * e;
      }
      if (!(products > 0.0)) continue;
      for (const Magnitude& row : data) {
        const double residual =
            row.magnitude - products / squares * std::pow(row.intensity / top, a);
        sum += residual * residual;
      }
      double& lowest = std::fabs(a) < 100.0 ? interior : edge;
      lowest = std::min(lowest, sum);
    }
    const PowerFit fit = fit_power(data);
    std::string rows;
    for (const Magnitude& row : data) {
      rows += " {" + std::to_string(row.intensity) + ", " + std::to_string(row.magnitude) + "}";
    }
    SCOPED_TRACE(rows + " " + fit.reason);
    const bool one_intensity = std::all_of(data.begin(), data.end(), [&](const Magnitude& row) {
      return row.intensity == data[0].intensity;
    });
    if (fit.status == FitStatus::kOk) {
      ++num_ok;
      EXPECT_FALSE(one_intensity);
      EXPECT_LT(interior, edge);
    } else {
      ++num_degenerate;
      EXPECT_EQ(fit.status, FitStatus::kDegenerate);
      EXPECT_TRUE(one_intensity || interior >= edge - 1e-9);
    }
  }
  EXPECT_GT(num_ok, 80);
  EXPECT_GT(num_degenerate, 80);
}

}  // namespace existence_test
}  // namespace jnd::analysis
