#pragma once

namespace jnd::core {

/// What force a hand has been exposed to, so far or in some time.
struct Exposure {
  double force_time_n_s = 0.0;  ///< Sum over points and time of the magnitude of the force.
  double under_force_s = 0.0;   ///< Time in which the points together felt 0.1 N and more.

  friend Exposure operator-(const Exposure& a, const Exposure& b) noexcept {
    return {a.force_time_n_s - b.force_time_n_s, a.under_force_s - b.under_force_s};
  }
  Exposure& operator+=(const Exposure& other) noexcept {
    force_time_n_s += other.force_time_n_s;
    under_force_s += other.under_force_s;
    return *this;
  }
};

}  // namespace jnd::core
