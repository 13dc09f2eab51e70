#include "analysis/commissioning/measured.h"

#include <boost/math/distributions/students_t.hpp>

namespace jnd::analysis {

double student_t975(double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

Measured measured(double value, double standard_error, double degrees_of_freedom) {
  const double half_width = student_t975(degrees_of_freedom) * standard_error;
  return {.value = value, .ci95_low = value - half_width, .ci95_high = value + half_width};
}

}  // namespace jnd::analysis
