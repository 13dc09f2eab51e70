#include "core/power_function.h"

#include <cmath>

namespace jnd::core {

double PowerFunction::magnitude(double intensity) const noexcept {
  return intensity == 0.0 ? 0.0 : k * std::pow(intensity, a);
}

double PowerFunction::intensity_at(double magnitude) const noexcept {
  return magnitude == 0.0 ? 0.0 : std::pow(magnitude / k, 1.0 / a);
}

}  // namespace jnd::core
