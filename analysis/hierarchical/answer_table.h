#pragma once

#include <array>
#include <vector>

#include "analysis/hierarchical/hierarchical_level.h"

namespace jnd::analysis {

/// `answer_probabilities` at one lapse rate and one guess rate, read off a table instead of
/// computed.
///
/// A fit of hundreds of people asks for the same function of z hundreds of thousands of times
/// before its lapse rate moves. The logarithms of both probabilities are polynomials of fifth
/// degree between knots 1/64 apart, which share value, first and second derivative with the
/// function at each knot. The error of a logarithm is below 1e-10 for every lapse rate, and the
/// derivative by z is that of the polynomial, so a search sees one smooth function and its own
/// slope. The derivatives by the lapse rate follow from the probability itself.
///
/// Outside of |z| < 10 the function is computed.
class AnswerTable {
 public:
  /// Computes nothing if the table is of these rates already.
  void set(double lapse_rate, double guess_rate);

  /// As `answer_probabilities`; those by the lapse rate may be 0 where they are not wanted.
  [[nodiscard]] AnswerProbabilities at(double z, AnswersWanted wanted) const noexcept;

 private:
  static constexpr double kEnd = 10.0, kKnotsPerUnit = 64.0;
  static constexpr int kNumIntervals = static_cast<int>(2.0 * kEnd * kKnotsPerUnit);
  /// By the place within the interval, 0 to 1; the constant first.
  using Polynomial = std::array<double, 6>;
  struct Interval {
    Polynomial log_yes, log_no;
  };

  double lapse_rate_ = -1.0, guess_rate_ = -1.0;
  std::vector<Interval> intervals_;
};

}  // namespace jnd::analysis
