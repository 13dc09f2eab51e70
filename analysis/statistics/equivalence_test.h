#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// How far apart two conditions may be and still count as equivalent.
struct EquivalenceMargin {
  enum class Scale {
    kDifference,  ///< a - b lies within (-size, size), in the unit of the values. size is > 0.
    kRatio        ///< a / b lies within (1 / size, size). size is > 1, and every value is > 0.
  };
  Scale scale = Scale::kDifference;
  double size = 0.0;
};

/// The result of two one-sided tests (Schuirmann 1987), each at 5 %.
struct EquivalenceTest {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no result; "" if there is one.
  EquivalenceMargin margin;
  std::optional<double> estimate;  ///< The mean of a - b, or the ratio of the geometric means.
  /// The 90 % interval. It lies within the margin if the test is passed.
  Interval ci90;
  std::optional<double> degrees_of_freedom;
  std::optional<double> p_value;  ///< The larger of the two p values.

  [[nodiscard]] bool is_equivalent() const noexcept { return p_value && *p_value < 0.05; }
};

/// Pairs are tested by Student's t of the differences, and two groups by Welch's t. For a ratio
/// the logarithms are tested. Throws `core::Error` for an invalid margin, for pairs of
/// different number, and for a value that is not finite.
[[nodiscard]] EquivalenceTest equivalence_test(const std::vector<double>& a,
                                               const std::vector<double>& b, bool is_paired,
                                               const EquivalenceMargin& margin);

}  // namespace jnd::analysis
