#include "core/media/carlson.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jnd::core {
namespace {

// The error of the truncated series is about the sixth power of the spread.
constexpr double kMaxSpread = 1e-3;

bool are_in_range(double x, double y, double z) noexcept {
  return x > 0.0 && y > 0.0 && z > 0.0 && std::isfinite(x + y + z);
}

}  // namespace

double carlson_rf(double x, double y, double z) noexcept {
  if (!are_in_range(x, y, z)) return std::numeric_limits<double>::quiet_NaN();
  for (;;) {
    const double mean = (x + y + z) / 3.0;
    const double dx = 1.0 - x / mean;
    const double dy = 1.0 - y / mean;
    const double dz = -dx - dy;
    if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) < kMaxSpread) {
      const double e2 = dx * dy - dz * dz;
      const double e3 = dx * dy * dz;
      return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) /
             std::sqrt(mean);
    }
    const double lambda = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
}

double carlson_rd(double x, double y, double z) noexcept {
  if (!are_in_range(x, y, z)) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  double power = 1.0;
  for (;;) {
    const double mean = (x + y + 3.0 * z) / 5.0;
    const double dx = 1.0 - x / mean;
    const double dy = 1.0 - y / mean;
    const double dz = -(dx + dy) / 3.0;
    if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) < kMaxSpread) {
      const double xy = dx * dy;
      const double zz = dz * dz;
      const double e2 = xy - 6.0 * zz;
      const double e3 = (3.0 * xy - 8.0 * zz) * dz;
      const double e4 = 3.0 * (xy - zz) * zz;
      const double e5 = xy * zz * dz;
      const double series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 -
                            3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0 + 3.0 * e5 / 26.0;
      return 3.0 * sum + power * series / (mean * std::sqrt(mean));
    }
    const double lambda = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
    sum += power / (std::sqrt(z) * (z + lambda));
    power *= 0.25;
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
}

}  // namespace jnd::core
