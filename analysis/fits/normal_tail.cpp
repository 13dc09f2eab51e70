#include "analysis/fits/normal_tail.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace jnd::analysis {
namespace {

constexpr double kInvSqrtTwoPi = std::numbers::inv_sqrtpi / std::numbers::sqrt2;
constexpr double kHalfLogTwoPi = 0.91893853320467274178;
/// erfc(x / sqrt 2) keeps its full accuracy up to about this x, and then underflows.
constexpr double kFarTail = 36.0;

/// phi(x) / Phi(-x) for x >= 36: Laplace's continued fraction x + 1/(x + 2/(x + 3/(x + ...)))
/// (Abramowitz and Stegun 26.2.14), eight terms.
double far_mills(double x) noexcept {
  double fraction = x;
  for (int term = 8; term >= 1; --term) fraction = x + term / fraction;
  return fraction;
}

/// ln Phi(-x), and minus its slope phi(x) / Phi(-x).
struct LogTail {
  double log = 0.0, mills = 0.0;
};

/// ln Phi(-x) for 0 <= x < 9. Polynomials of fifth degree between knots 1/64 apart have the
/// function's value, first and second derivative at each knot. The sixth derivative of the
/// function is below 1, so the error is below 1e-15 for the value and 1e-13 for the slope.
class LogTailTable {
 public:
  static constexpr double kEnd = 9.0;

  LogTailTable() {
    // The coefficients are small differences, so they are computed in long double.
    Knot low = knot_at(0);
    for (std::size_t number = 0; number < intervals_.size(); ++number) {
      const Knot high = knot_at(number + 1);
      const long double rise = high.value - low.value - low.slope - 0.5L * low.bend;
      const long double turn = high.slope - low.slope - low.bend;
      const long double bend = high.bend - low.bend;
      intervals_[number] = {static_cast<double>(low.value),
                            static_cast<double>(low.slope),
                            static_cast<double>(0.5L * low.bend),
                            static_cast<double>(10.0L * rise - 4.0L * turn + 0.5L * bend),
                            static_cast<double>(-15.0L * rise + 7.0L * turn - bend),
                            static_cast<double>(6.0L * rise - 3.0L * turn + 0.5L * bend)};
      low = high;
    }
  }

  /// x must be in [0, kEnd).
  [[nodiscard]] LogTail at(double x) const noexcept {
    const double place = x * kKnotsPerUnit;
    const auto number = static_cast<int>(place);
    const double t = place - number;
    const std::array<double, 6>& c = intervals_[static_cast<std::size_t>(number)];
    const double value = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
    const double slope =
        c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * (5.0 * c[5]))));
    return {value, -kKnotsPerUnit * slope};
  }

 private:
  static constexpr double kKnotsPerUnit = 64.0;
  /// Derivatives are taken by the place within an interval, which goes from 0 to 1.
  struct Knot {
    long double value, slope, bend;
  };
  static Knot knot_at(std::size_t number) {
    constexpr long double kInterval = 1.0L / static_cast<long double>(kKnotsPerUnit);
    const long double x = static_cast<long double>(number) * kInterval;
    const long double tail = 0.5L * std::erfc(x / std::numbers::sqrt2_v<long double>);
    const long double density = std::numbers::inv_sqrtpi_v<long double> /
                                std::numbers::sqrt2_v<long double> * std::exp(-0.5L * x * x);
    const long double mills = density / tail;
    return {std::log(tail), -kInterval * mills, -kInterval * kInterval * mills * (mills - x)};
  }

  std::array<std::array<double, 6>, static_cast<std::size_t>(kEnd* kKnotsPerUnit)> intervals_;
};

LogTail log_tail(double x) noexcept {
  static const LogTailTable table;
  return table.at(x);
}

}  // namespace

NormalTails normal_tails(double z) noexcept {
  const double x = std::fabs(z);
  NormalTails tails;  // The tails at -x, which is <= 0.
  if (x < LogTailTable::kEnd) {
    const LogTail of = log_tail(x);
    const double tail = std::exp(of.log);
    tails = {.density = of.mills * tail, .lower = tail, .upper = 1.0 - tail};
  } else {
    const double tail = 0.5 * std::erfc(x / std::numbers::sqrt2);
    tails = {
        .density = kInvSqrtTwoPi * std::exp(-0.5 * x * x), .lower = tail, .upper = 1.0 - tail};
  }
  if (z > 0.0) std::swap(tails.lower, tails.upper);
  return tails;
}

LogNormalTails log_normal_tails(double z) noexcept {
  const double x = std::fabs(z);
  LogNormalTails tails;  // The tails at -x, which is <= 0, so the lower tail is the small one.
  if (x < LogTailTable::kEnd) {
    const LogTail of = log_tail(x);
    const double tail = std::exp(of.log), rest = 1.0 - tail;
    tails = {tail, rest, of.log, std::log1p(-tail), of.mills, of.mills * tail / rest};
  } else if (x < kFarTail) {
    const double tail = 0.5 * std::erfc(x / std::numbers::sqrt2);
    const double density = kInvSqrtTwoPi * std::exp(-0.5 * x * x);
    tails = {tail,           1.0 - tail,
             std::log(tail), std::log1p(-tail),
             density / tail, density / (1.0 - tail)};
  } else {
    const double mills = far_mills(x);
    tails = {0.0, 1.0, -0.5 * x * x - kHalfLogTwoPi - std::log(mills), 0.0, mills, 0.0};
  }
  if (z > 0.0) {
    std::swap(tails.lower, tails.upper);
    std::swap(tails.log_lower, tails.log_upper);
    std::swap(tails.mills_lower, tails.mills_upper);
  }
  return tails;
}

MillsRatios mills_ratios(double z) noexcept {
  const double x = std::fabs(z);
  if (!(x < LogTailTable::kEnd)) {
    const LogNormalTails tails = log_normal_tails(z);
    return {tails.mills_lower, tails.mills_upper};
  }
  const LogTail of = log_tail(x);
  const double tail = std::exp(of.log), other = of.mills * tail / (1.0 - tail);
  return z > 0.0 ? MillsRatios{other, of.mills} : MillsRatios{of.mills, other};
}

}  // namespace jnd::analysis
