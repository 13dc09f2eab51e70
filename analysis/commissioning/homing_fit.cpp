#include "analysis/commissioning/homing_fit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace jnd::analysis {

HomingFit fit_homing(std::vector<Eigen::Vector3d> homed_m, double moved_m) {
  if (homed_m.size() < 2) {
    throw core::Error("homing: expected at least two homings, found " +
                      std::to_string(homed_m.size()));
  }
  const bool all_finite =
      std::isfinite(moved_m) &&
      std::all_of(homed_m.begin(), homed_m.end(),
                  [](const Eigen::Vector3d& place_m) { return place_m.allFinite(); });
  if (!all_finite) {
    throw core::Error("homing: expected finite positions, found one that is not");
  }
  HomingFit fit{.homed_m = std::move(homed_m), .moved_m = moved_m};
  for (const Eigen::Vector3d& one_m : fit.homed_m) {
    for (const Eigen::Vector3d& other_m : fit.homed_m) {
      fit.spread_m = std::max(fit.spread_m, (one_m - other_m).norm());
    }
  }
  return fit;
}

}  // namespace jnd::analysis
