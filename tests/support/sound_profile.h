#pragma once

#include <string>

#include "experiments/device_profile/device_profile.h"

namespace jnd::test_support {

/// Returns a profile of this device with every field that exists, with wide limits, which is
/// valid for many years.
inline experiments::DeviceProfile sound_profile(const std::string& model = "wam",
                                                const std::string& serial = "17") {
  using experiments::MeasuredValue;
  experiments::DeviceProfile profile;
  profile.name = "left_arm";
  profile.comment = "beside the window";
  profile.device = {.model = model, .serial = serial, .firmware = "2.1"};
  profile.measured_on = "2026-11-20";
  profile.valid_until = "2999-12-31";
  profile.program_version = "0.1.0";
  profile.simulated = false;
  profile.frame = {.rotation = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0},
                   .offset_m = {0.1, 0.4, -0.71},
                   .surface_above_origin_m = 0.71,
                   .rotation_ci95_rad = 0.002,
                   .offset_ci95_m = 0.0005,
                   .num_points = 12,
                   .residual_m = 0.0003};
  profile.limits = {.max_force_per_point_n = 10.0,
                    .max_total_force_n = 30.0,
                    .max_slew_n_per_s = 2000.0,
                    .max_speed_m_per_s = 5.0,
                    .workspace_half_width_m = {1.5, 1.5, 1.5}};
  profile.measured_limits = {.max_force_per_point_n = 12.5,
                             .max_total_force_n = 40.0,
                             .max_slew_n_per_s = 8000.0,
                             .max_speed_m_per_s = 6.0,
                             .workspace_half_width_m = {2.0, 2.0, 1.6}};
  profile.force = {.gain = MeasuredValue{0.97, {0.96, 0.98}},
                   .offset_n = MeasuredValue{-0.02, {-0.05, 0.01}},
                   .hysteresis_n = MeasuredValue{0.1, {0.0, 0.2}},
                   .load_uncertainty_ratio = 0.001,
                   .pose_spread_ratio = 0.02};
  profile.tool = {.weight_n = MeasuredValue{0.3, {0.2, 0.4}}};
  profile.mechanics = {.mass_kg = MeasuredValue{0.4, {0.3, 0.5}},
                       .damping_n_s_per_m = MeasuredValue{1.2, {1.0, 1.4}},
                       .friction_n = MeasuredValue{0.6, {0.5, 0.7}}};
  profile.noise = {.position_sd_m = 1e-5,
                   .position_resolution_m = 2e-6,
                   .velocity_sd_m_per_s = 0.001,
                   .force_sd_n = 0.02};
  profile.delay_s = MeasuredValue{0.0031, {0.0029, 0.0033}};
  profile.stability = experiments::DeviceProfile::Stability{
      .rate_hz = 1000.0,
      .phantom_mass_kg = 0.2,
      .viscosity_pa_s = {.value = 400.0, .is_beyond_ladder = true},
      .stiffness_n_per_m = {.value = 3000.0, .is_beyond_ladder = false},
      .quiet_viscosity_pa_s = 90.0,
      .force_limit_n = 8.0};
  profile.checks = {{.checked_on = "2026-11-24",
                     .gain = MeasuredValue{0.971, {0.95, 0.99}},
                     .weight_n = MeasuredValue{0.31, {0.2, 0.42}},
                     .damping_n_s_per_m = MeasuredValue{2.1, {2.0, 2.2}},
                     .friction_n = MeasuredValue{0.4, {0.39, 0.41}},
                     .turned_rad = 0.001,
                     .shifted_m = 0.0004,
                     .position_sd_m = 0.00001,
                     .velocity_sd_m_per_s = 0.002,
                     .passed = true},
                    {.checked_on = "2026-11-25", .passed = true}};
  return profile;
}

}  // namespace jnd::test_support
