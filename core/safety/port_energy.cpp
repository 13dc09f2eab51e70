#include "core/safety/port_energy.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::core {

PortEnergy::PortEnergy(const Parameters& parameters, double period_s)
    : max_given_j_(parameters.max_given_j),
      kept_ratio_(std::exp(-period_s / parameters.memory_s)),
      max_credit_j_(parameters.max_credit_j) {
  require_positive(parameters.max_given_j, "max_given_j");
  require_positive(parameters.memory_s, "memory_s");
  require_positive(parameters.max_credit_j, "max_credit_j");
  require_positive(period_s, "period_s");
}

void PortEnergy::observe(const PointVectors& tip_position_m, const PointVectors& acted_n,
                         const std::array<bool, kNumContactPoints>& attached,
                         std::uint8_t storing_bits) noexcept {
  is_near_ = false;
  for (int i = 0; has_last_ && i < kNumContactPoints; ++i) {
    double work_j = acted_n[i].dot(tip_position_m[i] - last_position_m_[i]);
    if (!std::isfinite(work_j) || !attached[i] || !was_held_[i]) continue;
    double& given_j = given_j_[i];
    if (given_j > 0.0) given_j *= kept_ratio_;
    double least_j = 0.0;
    if ((storing_bits >> i & 1) != 0) {
      least_j = -max_credit_j_;
      const double by_grant_j = std::clamp(work_j, 0.0, granted_j_[i]);
      granted_j_[i] -= by_grant_j;
      work_j -= by_grant_j;
    }
    given_j = std::max(std::max(given_j, least_j) + work_j, least_j);
    is_exceeded_ |= given_j > max_given_j_;
    is_near_ |= given_j > 0.5 * max_given_j_;
  }
  last_position_m_ = tip_position_m;
  was_held_ = attached;
  has_last_ = true;
}

void PortEnergy::grant_credit() noexcept {
  for (int i = 0; i < kNumContactPoints; ++i) {
    granted_j_[i] = max_credit_j_ - std::clamp(-given_j_[i], 0.0, max_credit_j_);
  }
}

void PortEnergy::forgive() noexcept {
  is_exceeded_ = false;
  for (double& given_j : given_j_) given_j = std::min(given_j, 0.0);
}

void PortEnergy::reset() noexcept {
  has_last_ = false;
  is_exceeded_ = false;
  is_near_ = false;
  given_j_.fill(0.0);
  granted_j_.fill(0.0);
}

}  // namespace jnd::core
