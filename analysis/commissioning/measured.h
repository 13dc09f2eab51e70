#pragma once

namespace jnd::analysis {

/// What was measured of a device, and what the measurement leaves open.
struct Measured {
  double value = 0.0;
  double ci95_low = 0.0, ci95_high = 0.0;

  [[nodiscard]] bool holds(double truth) const noexcept {
    return ci95_low <= truth && truth <= ci95_high;
  }
};

/// value -+ t standard_error, t the 97.5 % quantile of Student's distribution with so many
/// degrees of freedom, > 0.
[[nodiscard]] Measured measured(double value, double standard_error, double degrees_of_freedom);

/// That quantile. `degrees_of_freedom` > 0.
[[nodiscard]] double student_t975(double degrees_of_freedom);

}  // namespace jnd::analysis
