#include "analysis/fits/shifted_power_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/root_finding.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr double kLowestExponent = -4.0, kHighestExponent = 8.0;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct LeastSquares {
  double at = 0.0;
  double squares = kInfinite;
  bool at_edge = false;
};

/// The least value over a range: the best point of a grid, refined by golden sections.
LeastSquares least_over(const std::function<double(double)>& squares, double low, double high,
                        int num_steps) {
  const double width = (high - low) / num_steps;
  LeastSquares best;
  for (int i = 0; i <= num_steps; ++i) {
    const double at = low + width * i, value = squares(at);
    if (value < best.squares) best = {at, value, i == 0 || i == num_steps};
  }
  if (!std::isfinite(best.squares)) return best;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = std::max(low, best.at - width), right = std::min(high, best.at + width);
  double a = right - golden * (right - left), b = left + golden * (right - left);
  double at_a = squares(a), at_b = squares(b);
  while (right - left > 1e-11 * (1.0 + std::fabs(best.at))) {
    if (at_a < at_b) {
      right = b;
      b = a;
      at_b = at_a;
      at_a = squares(a = right - golden * (right - left));
    } else {
      left = a;
      a = b;
      at_a = at_b;
      at_b = squares(b = left + golden * (right - left));
    }
  }
  const double at = 0.5 * (left + right), value = squares(at);
  const double near_edge = 1e-6 * (high - low);
  if (value <= best.squares) best = {at, value, false};
  best.at_edge = best.at - low < near_edge || high - best.at < near_edge;
  return best;
}

/// The rows that can be fitted, and the sum of squares that a law leaves. `u` describes the
/// shift. For a threshold it is the logarithm of its distance below the smallest intensity, so
/// that the threshold comes near the intensity without reaching it.
class Law {
 public:
  Law(std::vector<Magnitude> rows, PowerMethod method, PowerShift shift)
      : rows_(std::move(rows)), is_log_(method == PowerMethod::kLogLog), shift_(shift) {
    for (const Magnitude& row : rows_) {
      smallest_ = std::min(smallest_, row.intensity);
      largest_ = std::max(largest_, row.intensity);
    }
  }

  [[nodiscard]] double lowest_u() const { return std::log(1e-6 * smallest_); }
  [[nodiscard]] double highest_u() const { return std::log(smallest_ + 3.0 * largest_); }
  [[nodiscard]] double threshold_at(double u) const { return smallest_ - std::exp(u); }
  [[nodiscard]] double u_at(double threshold) const { return std::log(smallest_ - threshold); }

  struct Linear {
    double k = 0.0, offset = 0.0, squares = kInfinite;
  };

  /// The law with the best factor and offset, unless they are given. Factors <= 0 are rejected.
  [[nodiscard]] Linear linear(double a, double u, std::optional<double> k = {},
                              std::optional<double> offset = {}) const {
    const double threshold = shift_ == PowerShift::kThreshold ? threshold_at(u) : 0.0;
    std::vector<double> x, y;
    for (const Magnitude& row : rows_) {
      const double log_x = a * std::log(row.intensity - threshold);
      x.push_back(is_log_ ? log_x : std::exp(log_x));
      y.push_back(is_log_ ? std::log(row.magnitude) : row.magnitude);
    }
    return is_log_ ? in_logarithms(x, y, k) : in_magnitudes(x, y, k, offset);
  }

  /// The squares that S = c + d ln I leaves. A law with an offset tends to it as the exponent
  /// nears 0, while k grows and the offset falls without bound.
  [[nodiscard]] double squares_of_logarithm() const {
    const auto n = static_cast<double>(rows_.size());
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, squares = 0.0;
    for (const Magnitude& row : rows_) {
      mean_x += std::log(row.intensity) / n;
      mean_y += row.magnitude / n;
    }
    for (const Magnitude& row : rows_) {
      const double x = std::log(row.intensity) - mean_x;
      xx += x * x;
      xy += x * (row.magnitude - mean_y);
    }
    for (const Magnitude& row : rows_) {
      const double fitted = mean_y + xy / xx * (std::log(row.intensity) - mean_x);
      squares += std::pow(row.magnitude - fitted, 2);
    }
    return squares;
  }
  [[nodiscard]] double squares_about_mean() const {
    double mean = 0.0, sum = 0.0;
    for (const Magnitude& row : rows_)
      mean += value_of(row) / static_cast<double>(rows_.size());
    for (const Magnitude& row : rows_) sum += std::pow(value_of(row) - mean, 2);
    return sum;
  }
  [[nodiscard]] double squares_of_values() const {
    double sum = 0.0;
    for (const Magnitude& row : rows_) sum += std::pow(value_of(row), 2);
    return sum;
  }

 private:
  [[nodiscard]] double value_of(const Magnitude& row) const {
    return is_log_ ? std::log(row.magnitude) : row.magnitude;
  }

  static Linear in_logarithms(const std::vector<double>& x, const std::vector<double>& y,
                              const std::optional<double>& k) {
    double log_k = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      log_k += (y[i] - x[i]) / static_cast<double>(x.size());
    if (k) log_k = std::log(*k);
    Linear found{.k = std::exp(log_k), .offset = 0.0, .squares = 0.0};
    for (std::size_t i = 0; i < x.size(); ++i)
      found.squares += std::pow(y[i] - log_k - x[i], 2);
    return found;
  }

  [[nodiscard]] Linear in_magnitudes(const std::vector<double>& x, const std::vector<double>& y,
                                     const std::optional<double>& k,
                                     const std::optional<double>& offset) const {
    const auto n = static_cast<double>(x.size());
    const bool is_free = shift_ == PowerShift::kOffset && !offset;
    double mean_x = 0.0, mean_y = offset.value_or(0.0);
    if (is_free) {
      mean_y = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
      }
    }
    double xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - mean_x) * (x[i] - mean_x);
      xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    Linear found;
    found.k = k.value_or(xy / xx);
    if (!(found.k > 0.0) || !std::isfinite(found.k)) return {};
    found.offset = mean_y - found.k * mean_x;
    found.squares = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      found.squares += std::pow(y[i] - found.offset - found.k * x[i], 2);
    }
    return found;
  }

  std::vector<Magnitude> rows_;
  bool is_log_;
  PowerShift shift_;
  double smallest_ = kInfinite, largest_ = 0.0;
};

/// The least sum of squares of a law with some parameters held.
class Search {
 public:
  Search(const Law& law, PowerShift shift) : law_(law), shift_(shift) {}

  [[nodiscard]] LeastSquares over_exponents(double u, std::optional<double> k = {},
                                            std::optional<double> offset = {}) const {
    return least_over([&](double a) { return law_.linear(a, u, k, offset).squares; },
                      kLowestExponent, kHighestExponent, 96);
  }
  /// The least value of `squares` over all thresholds.
  [[nodiscard]] LeastSquares over_thresholds(
      const std::function<double(double)>& squares) const {
    return least_over(squares, law_.lowest_u(), law_.highest_u(), 48);
  }
  [[nodiscard]] bool has_threshold() const { return shift_ == PowerShift::kThreshold; }

  [[nodiscard]] double with_exponent(double a) const {
    const auto at = [&](double u) { return law_.linear(a, u).squares; };
    return has_threshold() ? over_thresholds(at).squares : at(0.0);
  }
  [[nodiscard]] double with_factor(double k) const {
    const auto at = [&](double u) { return over_exponents(u, k).squares; };
    return has_threshold() ? over_thresholds(at).squares : at(0.0);
  }
  [[nodiscard]] double with_shift(double shift) const {
    if (has_threshold()) return over_exponents(law_.u_at(shift)).squares;
    return over_exponents(0.0, {}, shift).squares;
  }

 private:
  const Law& law_;
  PowerShift shift_;
};

/// The place where the squares first reach `most` on a walk with growing steps from the optimum
/// to `limit`.
std::optional<double> profile_end(const std::function<double(double)>& squares, double from,
                                  double first_step, double limit, double most) {
  const auto excess = [&](double at) {
    const double value = squares(at);
    return std::isfinite(value) ? value - most : most;
  };
  double inside = from, inside_excess = excess(from);
  if (!(inside_excess < 0.0)) return std::nullopt;
  for (double step = first_step; inside != limit; step *= 1.6) {
    const bool is_last = std::fabs(limit - inside) <= step;
    const double outside = is_last ? limit : inside + std::copysign(step, limit - inside);
    const double outside_excess = excess(outside);
    if (outside_excess >= 0.0) {
      BracketEnd first{inside, inside_excess}, second{outside, outside_excess};
      if (first.at > second.at) std::swap(first, second);
      const auto is_close = [](double a, double b) {
        return std::fabs(b - a) <= 1e-9 * std::max(std::fabs(a), std::fabs(b)) + 1e-300;
      };
      const auto [low, high] = root_bracket(excess, first, second, is_close, 100);
      return 0.5 * (low + high);
    }
    inside = outside;
    inside_excess = outside_excess;
  }
  return std::nullopt;
}

void fill_intervals(ShiftedPowerFit& fit, const Law& law, const Search& search,
                    int degrees_of_freedom) {
  const double least = *fit.sum_of_squares;
  const double most =
      least * (1.0 + fisher_f_quantile(0.95, 1.0, degrees_of_freedom) / degrees_of_freedom);
  const auto of_exponent = [&](double a) { return search.with_exponent(a); };
  fit.a_ci95 = {profile_end(of_exponent, *fit.a, 0.01, kLowestExponent, most),
                profile_end(of_exponent, *fit.a, 0.01, kHighestExponent, most)};
  // The walk is along ln k, so k stays above 0.
  const auto of_factor = [&](double log_k) { return search.with_factor(std::exp(log_k)); };
  const double log_k = std::log(*fit.k);
  const auto factor = [](const std::optional<double>& end) {
    return end ? std::optional(std::exp(*end)) : std::nullopt;
  };
  fit.k_ci95 = {factor(profile_end(of_factor, log_k, 0.01, log_k - 40.0, most)),
                factor(profile_end(of_factor, log_k, 0.01, log_k + 40.0, most))};
  const auto of_shift = [&](double shift) { return search.with_shift(shift); };
  if (fit.intensity_threshold) {
    const double at = *fit.intensity_threshold;
    const double step = 0.01 * std::exp(law.u_at(at));
    fit.shift_ci95 = {profile_end(of_shift, at, step, law.threshold_at(law.highest_u()), most),
                      profile_end(of_shift, at, step, law.threshold_at(law.lowest_u()), most)};
  } else if (fit.magnitude_offset) {
    const double at = *fit.magnitude_offset, reach = std::sqrt(law.squares_of_values());
    fit.shift_ci95 = {profile_end(of_shift, at, 1e-3 * reach, at - 10.0 * reach, most),
                      profile_end(of_shift, at, 1e-3 * reach, at + 10.0 * reach, most)};
    // Where a logarithm does not lie too far off, nothing bounds the exponent on the side of 0,
    // where k grows and the offset falls without bound.
    if (law.squares_of_logarithm() < most) {
      (*fit.a > 0.0 ? fit.a_ci95.low : fit.a_ci95.high).reset();
      fit.k_ci95.high.reset();
      fit.shift_ci95.low.reset();
    }
  }
}

void test_shift(ShiftedPowerFit& fit, const Law& plain, int degrees_of_freedom) {
  const Search without(plain, PowerShift::kNone);
  const double gained = without.over_exponents(0.0).squares - *fit.sum_of_squares;
  if (!std::isfinite(gained)) return;
  fit.shift_statistic = std::max(0.0, gained) / (*fit.sum_of_squares / degrees_of_freedom);
  fit.shift_p_value = fisher_f_above(*fit.shift_statistic, 1.0, degrees_of_freedom);
}

}  // namespace

ShiftedPowerFit fit_shifted_power(const std::vector<Magnitude>& data, PowerMethod method,
                                  PowerShift shift) {
  core::require(shift != PowerShift::kOffset || method == PowerMethod::kNonlinear, "offset",
                "least squares of the magnitudes (nls), for S0 has no logarithm",
                static_cast<double>(static_cast<int>(method)));
  ShiftedPowerFit fit{.status = FitStatus::kDegenerate, .method = method, .shift = shift};
  std::vector<Magnitude> rows;
  std::set<double> intensities;
  for (const Magnitude& row : data) {
    core::require_not_negative(row.intensity, "intensity");
    core::require(std::isfinite(row.magnitude), "magnitude", "a finite number", row.magnitude);
    if (!(row.intensity > 0.0) || (method == PowerMethod::kLogLog && !(row.magnitude > 0.0))) {
      ++fit.num_left_out;
      continue;
    }
    rows.push_back(row);
    intensities.insert(row.intensity);
  }
  fit.num_rows = static_cast<int>(rows.size());
  const std::size_t num_parameters = shift == PowerShift::kNone ? 2 : 3;
  if (intensities.size() < num_parameters) {
    fit.reason = "too few intensities: the law has " + std::to_string(num_parameters) +
                 " parameters and needs as many intensities > 0";
    return fit;
  }
  const Law law(rows, method, shift);
  const Search search(law, shift);
  const auto [least, most] = std::ranges::minmax_element(rows, {}, &Magnitude::magnitude);
  if (shift != PowerShift::kNone && least->magnitude == most->magnitude) {
    fit.reason = std::string("the magnitudes are all the same, so that every ") +
                 (shift == PowerShift::kThreshold ? "threshold" : "offset") + " does as well";
    return fit;
  }
  double u = 0.0;
  if (shift == PowerShift::kThreshold) {
    const LeastSquares best =
        search.over_thresholds([&](double at) { return search.over_exponents(at).squares; });
    if (best.at_edge) {
      fit.reason =
          "no threshold: the squares still fall at the end of the range, so the data "
          "do not tell where the law begins";
      return fit;
    }
    u = best.at;
  }
  const LeastSquares best = search.over_exponents(u);
  if (!std::isfinite(best.squares) || best.at_edge) {
    fit.reason = "the best exponent lies beyond -4 to 8, or no factor > 0 is best";
    return fit;
  }
  // A best exponent so near to 0 that a logarithm does as well stands for none.
  constexpr double kAsGood = 1.0 - 1e-6;
  if (shift == PowerShift::kOffset && best.squares > kAsGood * law.squares_of_logarithm()) {
    fit.reason =
        "a logarithm, to which a law with an offset tends as its exponent nears 0, suits the "
        "magnitudes as well or better; leave the offset out";
    return fit;
  }
  const Law::Linear linear = law.linear(best.at, u);
  fit.status = FitStatus::kOk;
  fit.k = linear.k;
  fit.a = best.at;
  if (shift == PowerShift::kThreshold) fit.intensity_threshold = law.threshold_at(u);
  if (shift == PowerShift::kOffset) fit.magnitude_offset = linear.offset;
  fit.sum_of_squares = linear.squares;
  const double about_mean = law.squares_about_mean();
  if (about_mean > 0.0) fit.r_squared = 1.0 - linear.squares / about_mean;
  const int degrees_of_freedom = fit.num_rows - static_cast<int>(num_parameters);
  constexpr double kRounding = 1e-18;
  if (degrees_of_freedom < 2) {
    fit.no_interval = "fewer than two degrees of freedom are left";
  } else if (linear.squares <= kRounding * law.squares_of_values()) {
    fit.no_interval = "the law passes through every row";
  } else {
    fill_intervals(fit, law, search, degrees_of_freedom);
    if (shift != PowerShift::kNone) {
      test_shift(fit, Law(rows, method, PowerShift::kNone), degrees_of_freedom);
    }
  }
  return fit;
}

}  // namespace jnd::analysis
