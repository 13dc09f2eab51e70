#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "analysis/hierarchical/hierarchical_level.h"

namespace jnd::analysis {

/// A table that gives the results of `answer_probabilities` at one lapse rate and one guess
/// rate.
///
/// A fit of hundreds of people needs the same function of z hundreds of thousands of times
/// before its lapse rate moves. The logarithms of both probabilities are stored as polynomials
/// of fifth degree between knots 1/64 apart. They have the function's value, first and second
/// derivative at each knot. The error of a logarithm is below 1e-10 for every lapse rate. The
/// derivative by z is that of the polynomial, so a search sees one smooth function and its own
/// slope. The derivatives by the lapse rate follow from the probability itself.
///
/// Outside |z| < 10 the function is computed directly.
class AnswerTable {
 public:
  /// Fills the table. It does nothing if the table already has these rates.
  void set(double lapse_rate, double guess_rate);

  /// Does what `answer_probabilities` does. The derivatives by the lapse rate may be 0 if they
  /// are not wanted.
  [[nodiscard]] AnswerProbabilities at(double z, AnswersWanted wanted) const noexcept;

  /// The values for one kind of answer: ln of its probability, its derivative by z for a yes or
  /// by -z for a no, > 0, and its derivative by the lapse rate. Without `kDerivatives` both
  /// derivatives are 0.
  struct Side {
    double log = 0.0, by_z = 0.0, by_lapse = 0.0;
  };
  template <bool kDerivatives>
  [[nodiscard]] Side side(bool is_no, double z) const noexcept {
    const double s = is_no ? -z : z;
    if (!(std::fabs(s) < kEnd)) return computed(is_no, z);
    const double place = (s + kEnd) * kKnotsPerUnit;
    // Just below the upper end, rounding may move the sum onto the end.
    const int number = std::min(static_cast<int>(place), kNumIntervals - 1);
    const double t = place - number;
    const Interval* const intervals =
        (is_no && has_no_ ? no_intervals_ : yes_intervals_).data();
    const Interval& of = intervals[number];
    const std::array<double, 6>& c = of.log;
    const double rest = t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
    Side found{.log = c[0] + rest};
    if constexpr (kDerivatives) {
      found.by_z =
          kKnotsPerUnit *
          (c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * (5.0 * c[5])))));
      found.by_lapse =
          ((is_no ? of_no_ : of_yes_) * of.inverse * small_exp(-rest) - at_most_) * per_share_;
    }
    return found;
  }

 private:
  static constexpr double kEnd = 10.0, kKnotsPerUnit = 64.0;
  static constexpr int kNumIntervals = static_cast<int>(2.0 * kEnd * kKnotsPerUnit);
  /// A polynomial in the place within the interval, 0 to 1, with the constant first. It fills
  /// one line of the cache.
  struct alignas(64) Interval {
    std::array<double, 6> log;
    double inverse = 0.0;  ///< One over the probability at the interval's lower end.
  };

  /// e^x for |x| <= 1 / 6, accurate to 2e-11. A logarithm changes by no more within an
  /// interval.
  static double small_exp(double x) noexcept {
    constexpr double k2 = 1.0 / 2.0, k3 = 1.0 / 6.0, k4 = 1.0 / 24.0, k5 = 1.0 / 120.0,
                     k6 = 1.0 / 720.0, k7 = 1.0 / 5040.0;
    return 1.0 + x * (1.0 + x * (k2 + x * (k3 + x * (k4 + x * (k5 + x * (k6 + x * k7))))));
  }
  [[nodiscard]] Side computed(bool is_no, double z) const noexcept;
  static void fill(std::vector<Interval>& intervals, bool is_no, double lapse_rate,
                   double guess_rate);

  double lapse_rate_ = -1.0, guess_rate_ = -1.0;
  /// f = guess + share Phi, and g = lapse + share (1 - Phi). Without a guess rate the lapse
  /// rate is also in f. The derivatives of the logarithms by the lapse rate are then (of / f -
  /// at most) / share.
  double of_yes_ = 0.0, of_no_ = 0.0, at_most_ = 0.0, per_share_ = 0.0;
  /// Indexed by z for a yes and by -z for a no. Without a guess rate both are the same
  /// function.
  std::vector<Interval> yes_intervals_, no_intervals_;
  bool has_no_ = false;
};

}  // namespace jnd::analysis
