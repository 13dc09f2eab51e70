#include "analysis/commissioning/noise_fit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/statistics/distributions.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kFewestReadings = 100;
/// A picometre. Readings that differ by less differ only by rounding.
constexpr double kSame_m = 1e-12;

Measured deviation_of(const std::vector<Eigen::Vector3d>& readings) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& reading : readings) mean += reading;
  mean /= static_cast<double>(readings.size());
  double squares = 0.0;
  for (const Eigen::Vector3d& reading : readings) squares += (reading - mean).squaredNorm();
  const double degrees_of_freedom = 3.0 * (static_cast<double>(readings.size()) - 1.0);
  return {.value = std::sqrt(squares / degrees_of_freedom),
          .ci95_low = std::sqrt(squares / chi_squared_quantile(0.975, degrees_of_freedom)),
          .ci95_high = std::sqrt(squares / chi_squared_quantile(0.025, degrees_of_freedom))};
}

double least_step_m(const std::vector<Eigen::Vector3d>& position_m) {
  double least_m = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> sorted_m;
    for (const Eigen::Vector3d& reading : position_m) sorted_m.push_back(reading[axis]);
    std::sort(sorted_m.begin(), sorted_m.end());
    for (std::size_t i = 1; i < sorted_m.size(); ++i) {
      const double step_m = sorted_m[i] - sorted_m[i - 1];
      if (step_m > kSame_m && (least_m == 0.0 || step_m < least_m)) least_m = step_m;
    }
  }
  return least_m;
}

std::vector<Eigen::Vector3d> first_readings_m(const std::vector<Eigen::Vector3d>& position_m) {
  constexpr std::size_t kMost = 250;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& reading_m : position_m) mean_m += reading_m;
  mean_m /= static_cast<double>(position_m.size());
  std::vector<Eigen::Vector3d> first_m;
  for (std::size_t i = 0; i < std::min(kMost, position_m.size()); ++i) {
    first_m.emplace_back(position_m[i] - mean_m);
  }
  return first_m;
}

}  // namespace

NoiseFit fit_noise(const std::vector<Eigen::Vector3d>& position_m,
                   const std::vector<Eigen::Vector3d>& velocity_m_per_s) {
  if (position_m.size() < kFewestReadings || velocity_m_per_s.size() < kFewestReadings) {
    throw core::Error("noise: expected at least 100 readings, found " +
                      std::to_string(std::min(position_m.size(), velocity_m_per_s.size())));
  }
  return {.position_sd_m = deviation_of(position_m),
          .position_resolution_m = least_step_m(position_m),
          .velocity_sd_m_per_s = deviation_of(velocity_m_per_s),
          .first_readings_m = first_readings_m(position_m)};
}

}  // namespace jnd::analysis
