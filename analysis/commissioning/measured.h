#pragma once

namespace jnd::analysis {

/// A measured property of a device, with its uncertainty.
struct Measured {
  double value = 0.0;
  double ci95_low = 0.0, ci95_high = 0.0;

  [[nodiscard]] bool holds(double truth) const noexcept {
    return ci95_low <= truth && truth <= ci95_high;
  }
};

/// The interval value -+ t standard_error, where t is the 97.5 % quantile of Student's
/// distribution with `degrees_of_freedom`, > 0.
[[nodiscard]] Measured measured(double value, double standard_error, double degrees_of_freedom);

/// The 97.5 % quantile of Student's distribution. `degrees_of_freedom` is > 0.
[[nodiscard]] double student_t975(double degrees_of_freedom);

}  // namespace jnd::analysis
