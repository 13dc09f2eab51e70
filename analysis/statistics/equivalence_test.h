#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// How far apart two conditions may be and still count as the same.
struct EquivalenceMargin {
  enum class Scale {
    kDifference,  ///< a - b within (-size, size), in the unit of the values; size > 0.
    kRatio        ///< a over b within (1 / size, size); size > 1, every value > 0.
  };
  Scale scale = Scale::kDifference;
  double size = 0.0;
};

/// Two one-sided tests (Schuirmann 1987), at 5 % each.
struct EquivalenceTest {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is none; "" where there is.
  EquivalenceMargin margin;
  std::optional<double> estimate;  ///< Mean of a - b, or ratio of the geometric means.
  Interval ci90;                   ///< Lies within the margin where the test is passed.
  std::optional<double> degrees_of_freedom;
  std::optional<double> p_value;  ///< The larger of both.

  [[nodiscard]] bool is_equivalent() const noexcept { return p_value && *p_value < 0.05; }
};

/// Of pairs by Student's t of the differences, of two groups by Welch's t; of a ratio, of the
/// logarithms. Throws `core::Error` where the margin is none, pairs differ in number or a value
/// is not finite.
[[nodiscard]] EquivalenceTest equivalence_test(const std::vector<double>& a,
                                               const std::vector<double>& b, bool is_paired,
                                               const EquivalenceMargin& margin);

}  // namespace jnd::analysis
