#pragma once

namespace jnd::core {

/// How much force a hand has been exposed to, in total or in some period.
struct Exposure {
  double force_time_n_s = 0.0;  ///< The magnitude of the force, summed over points and time.
  double under_force_s = 0.0;   ///< Time in which the points together felt 0.1 N or more.

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
