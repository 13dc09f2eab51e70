#pragma once

#include <concepts>
#include <type_traits>

#include "experiments/device_profile/device_profile.h"

namespace jnd::experiments {

// Assigns the fields of a profile to their keys, for reader and writer alike, in the order in
// which they are written. A test compares the keys with `device_profile_table`.

template <class T, class Of>
concept IsA = std::same_as<std::remove_const_t<T>, Of>;

/// Calls `visit(key, field)` for each field.
template <class T, class Visit>
void each_field(T& it, const Visit& visit) {
  using P = DeviceProfile;
  if constexpr (IsA<T, MeasuredValue>) {
    visit("value", it.value);
    visit("ci95", it.ci95);
  } else if constexpr (IsA<T, P::Device>) {
    visit("model", it.model);
    visit("serial", it.serial);
    visit("firmware", it.firmware);
  } else if constexpr (IsA<T, P::Frame>) {
    visit("rotation", it.rotation);
    visit("offset_m", it.offset_m);
    visit("surface_above_origin_m", it.surface_above_origin_m);
    visit("rotation_ci95_rad", it.rotation_ci95_rad);
    visit("offset_ci95_m", it.offset_ci95_m);
    visit("num_points", it.num_points);
    visit("residual_m", it.residual_m);
  } else if constexpr (IsA<T, P::Limits>) {
    visit("max_force_per_point_n", it.max_force_per_point_n);
    visit("max_total_force_n", it.max_total_force_n);
    visit("max_slew_n_per_s", it.max_slew_n_per_s);
    visit("max_speed_m_per_s", it.max_speed_m_per_s);
    visit("workspace_half_width_m", it.workspace_half_width_m);
  } else if constexpr (IsA<T, P::Force>) {
    visit("gain", it.gain);
    visit("offset_n", it.offset_n);
    visit("hysteresis_n", it.hysteresis_n);
    visit("load_uncertainty_ratio", it.load_uncertainty_ratio);
    visit("pose_spread_ratio", it.pose_spread_ratio);
  } else if constexpr (IsA<T, P::Tool>) {
    visit("weight_n", it.weight_n);
  } else if constexpr (IsA<T, P::Mechanics>) {
    visit("mass_kg", it.mass_kg);
    visit("damping_n_s_per_m", it.damping_n_s_per_m);
    visit("friction_n", it.friction_n);
  } else if constexpr (IsA<T, P::Noise>) {
    visit("position_sd_m", it.position_sd_m);
    visit("position_resolution_m", it.position_resolution_m);
    visit("velocity_sd_m_per_s", it.velocity_sd_m_per_s);
    visit("force_sd_n", it.force_sd_n);
  } else if constexpr (IsA<T, P::StableUpTo>) {
    visit("value", it.value);
    visit("is_beyond_ladder", it.is_beyond_ladder);
  } else if constexpr (IsA<T, P::Stability>) {
    visit("rate_hz", it.rate_hz);
    visit("phantom_mass_kg", it.phantom_mass_kg);
    visit("viscosity_pa_s", it.viscosity_pa_s);
    visit("stiffness_n_per_m", it.stiffness_n_per_m);
    visit("quiet_viscosity_pa_s", it.quiet_viscosity_pa_s);
    visit("force_limit_n", it.force_limit_n);
  } else if constexpr (IsA<T, P::DailyCheck>) {
    visit("checked_on", it.checked_on);
    visit("gain", it.gain);
    visit("weight_n", it.weight_n);
    visit("damping_n_s_per_m", it.damping_n_s_per_m);
    visit("friction_n", it.friction_n);
    visit("turned_rad", it.turned_rad);
    visit("shifted_m", it.shifted_m);
    visit("position_sd_m", it.position_sd_m);
    visit("velocity_sd_m_per_s", it.velocity_sd_m_per_s);
    visit("passed", it.passed);
  } else {
    static_assert(IsA<T, P>);
    visit("name", it.name);
    visit("comment", it.comment);
    visit("device", it.device);
    visit("measured_on", it.measured_on);
    visit("valid_until", it.valid_until);
    visit("program_version", it.program_version);
    visit("simulated", it.simulated);
    visit("frame", it.frame);
    visit("limits", it.limits);
    visit("measured_limits", it.measured_limits);
    visit("force", it.force);
    visit("tool", it.tool);
    visit("mechanics", it.mechanics);
    visit("noise", it.noise);
    visit("delay_s", it.delay_s);
    visit("stability", it.stability);
    visit("checks", it.checks);
  }
}

}  // namespace jnd::experiments
