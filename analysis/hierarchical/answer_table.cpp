#include "analysis/hierarchical/answer_table.h"

namespace jnd::analysis {
namespace {

/// A logarithm and its first two derivatives by the place within an interval.
struct TableKnot {
  double value, slope, bend;
};

/// Hermite interpolation of fifth degree between two knots.
std::array<double, 6> polynomial_between(const TableKnot& low, const TableKnot& high) noexcept {
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

}  // namespace

void AnswerTable::fill(std::vector<Interval>& intervals, bool is_no, double lapse_rate,
                       double guess_rate) {
  constexpr double kInterval = 1.0 / kKnotsPerUnit;
  intervals.resize(kNumIntervals);
  TableKnot last{};
  for (int knot = 0; knot <= kNumIntervals; ++knot) {
    const double s = knot * kInterval - kEnd, z = is_no ? -s : s;
    const AnswerProbabilities here = answer_probabilities(
        z, lapse_rate, guess_rate, {.of_yes = !is_no, .of_no = is_no, .by_lapse = false});
    const double by_s = is_no ? here.by_z_no : here.by_z_yes;
    // The derivative of the normal density is -z times the density.
    const TableKnot next{.value = is_no ? here.log_no : here.log_yes,
                         .slope = kInterval * by_s,
                         .bend = -kInterval * kInterval * by_s * (s + by_s)};
    if (knot > 0) {
      intervals[static_cast<std::size_t>(knot - 1)] = {polynomial_between(last, next),
                                                       std::exp(-last.value)};
    }
    last = next;
  }
}

void AnswerTable::set(double lapse_rate, double guess_rate) {
  if (lapse_rate == lapse_rate_ && guess_rate == guess_rate_) return;
  const bool is_forced = guess_rate > 0.0;
  fill(yes_intervals_, false, lapse_rate, guess_rate);
  if (is_forced) fill(no_intervals_, true, lapse_rate, guess_rate);
  has_no_ = is_forced;
  of_yes_ = is_forced ? guess_rate : 1.0;
  of_no_ = is_forced ? 1.0 - guess_rate : 1.0;
  at_most_ = is_forced ? 1.0 : 2.0;
  // Without lapses nobody needs the derivatives by the lapse rate. They are then 0, as in
  // `answer_probabilities`.
  per_share_ = lapse_rate == 0.0 ? 0.0
               : is_forced       ? 1.0 / (1.0 - guess_rate - lapse_rate)
                                 : 1.0 / (1.0 - 2.0 * lapse_rate);
  lapse_rate_ = lapse_rate;
  guess_rate_ = guess_rate;
}

AnswerTable::Side AnswerTable::computed(bool is_no, double z) const noexcept {
  const AnswerProbabilities here = answer_probabilities(z, lapse_rate_, guess_rate_);
  if (is_no) return {here.log_no, here.by_z_no, here.by_lapse_no};
  return {here.log_yes, here.by_z_yes, here.by_lapse_yes};
}

AnswerProbabilities AnswerTable::at(double z, AnswersWanted wanted) const noexcept {
  const bool has_derivatives = wanted.by_z || wanted.by_lapse;
  const auto of = [&](bool is_no) {
    return has_derivatives ? side<true>(is_no, z) : side<false>(is_no, z);
  };
  AnswerProbabilities found{};
  if (wanted.of_yes) {
    const Side yes = of(false);
    found.log_yes = yes.log;
    if (wanted.by_z) found.by_z_yes = yes.by_z;
    if (wanted.by_lapse) found.by_lapse_yes = yes.by_lapse;
  }
  if (wanted.of_no) {
    const Side no = of(true);
    found.log_no = no.log;
    if (wanted.by_z) found.by_z_no = no.by_z;
    if (wanted.by_lapse) found.by_lapse_no = no.by_lapse;
  }
  return found;
}

}  // namespace jnd::analysis
