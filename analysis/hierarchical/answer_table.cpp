#include "analysis/hierarchical/answer_table.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

/// A logarithm and its first two derivatives by the place within an interval.
struct Knot {
  double value, slope, bend;
};

/// Hermite's interpolation of fifth degree between two knots.
std::array<double, 6> polynomial_between(const Knot& low, const Knot& high) noexcept {
  const double rise = high.value - low.value - low.slope - 0.5 * low.bend;
  const double turn = high.slope - low.slope - low.bend;
  const double bend = high.bend - low.bend;
  return {low.value,
          low.slope,
          0.5 * low.bend,
          10.0 * rise - 4.0 * turn + 0.5 * bend,
          -15.0 * rise + 7.0 * turn - bend,
          6.0 * rise - 3.0 * turn + 0.5 * bend};
}

double value_of(const std::array<double, 6>& c, double t) noexcept {
  return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
}

double slope_of_polynomial(const std::array<double, 6>& c, double t) noexcept {
  return c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * 5.0 * c[5])));
}

}  // namespace

void AnswerTable::set(double lapse_rate, double guess_rate) {
  if (lapse_rate == lapse_rate_ && guess_rate == guess_rate_) return;
  constexpr double kInterval = 1.0 / kKnotsPerUnit;
  intervals_.resize(kNumIntervals);
  Knot last_yes{}, last_no{};
  for (int knot = 0; knot <= kNumIntervals; ++knot) {
    const double z = knot * kInterval - kEnd;
    const AnswerProbabilities here = answer_probabilities(z, lapse_rate, guess_rate);
    // The density's own derivative is -z times it, for a yes and for a no.
    const double bend_yes = -here.by_z_yes * (z + here.by_z_yes);
    const double bend_no = here.by_z_no * (z - here.by_z_no);
    const Knot yes{here.log_yes, kInterval * here.by_z_yes, kInterval * kInterval * bend_yes};
    const Knot no{here.log_no, -kInterval * here.by_z_no, kInterval * kInterval * bend_no};
    if (knot > 0) {
      intervals_[static_cast<std::size_t>(knot - 1)] = {polynomial_between(last_yes, yes),
                                                        polynomial_between(last_no, no)};
    }
    last_yes = yes;
    last_no = no;
  }
  lapse_rate_ = lapse_rate;
  guess_rate_ = guess_rate;
}

AnswerProbabilities AnswerTable::at(double z, AnswersWanted wanted) const noexcept {
  if (!(std::fabs(z) < kEnd)) return answer_probabilities(z, lapse_rate_, guess_rate_, wanted);
  const double place = (z + kEnd) * kKnotsPerUnit;
  // Just below the upper end the sum may be rounded up onto it.
  const int number = std::min(static_cast<int>(place), kNumIntervals - 1);
  const double t = place - number;
  const Interval& interval = intervals_[static_cast<std::size_t>(number)];
  AnswerProbabilities found{};
  if (wanted.of_yes) found.log_yes = value_of(interval.log_yes, t);
  if (wanted.of_no) found.log_no = value_of(interval.log_no, t);
  if (wanted.by_z) {
    if (wanted.of_yes)
      found.by_z_yes = kKnotsPerUnit * slope_of_polynomial(interval.log_yes, t);
    if (wanted.of_no) found.by_z_no = -kKnotsPerUnit * slope_of_polynomial(interval.log_no, t);
  }
  // Of no lapses nobody asks, as `answer_probabilities`.
  if (!wanted.by_lapse || lapse_rate_ == 0.0) return found;
  // f = guess + share Phi, g = lapse + share (1 - Phi); without a guess rate f has the lapse
  // rate too.
  const bool is_forced = guess_rate_ > 0.0;
  const double share = is_forced ? 1.0 - guess_rate_ - lapse_rate_ : 1.0 - 2.0 * lapse_rate_;
  const double of_yes = is_forced ? guess_rate_ : 1.0, at_most = is_forced ? 1.0 : 2.0;
  const double of_no = is_forced ? 1.0 - guess_rate_ : 1.0;
  if (wanted.of_yes) {
    found.by_lapse_yes = (of_yes * std::exp(-found.log_yes) - at_most) / share;
  }
  if (wanted.of_no) found.by_lapse_no = (of_no * std::exp(-found.log_no) - at_most) / share;
  return found;
}

}  // namespace jnd::analysis
