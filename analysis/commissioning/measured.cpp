#include "analysis/commissioning/measured.h"

#include "analysis/statistics/distributions.h"

namespace jnd::analysis {

double student_t975(double degrees_of_freedom) {
  return student_t_quantile(0.975, degrees_of_freedom);
}

Measured measured(double value, double standard_error, double degrees_of_freedom) {
  const double half_width = student_t975(degrees_of_freedom) * standard_error;
  return {.value = value, .ci95_low = value - half_width, .ci95_high = value + half_width};
}

}  // namespace jnd::analysis
