#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::experiments {

/// What was measured, with its 95 % confidence interval.
struct MeasuredValue {
  double value = 0.0;
  std::array<double, 2> ci95{};  ///< Lower and upper end, around the value.

  bool operator==(const MeasuredValue&) const = default;
};

// The parts of a profile. Units are in the names; what each field means exactly is said in
// `device_profile_table`. What was not measured is absent.

/// From the robot's own frame to the workspace:
/// workspace position = rotation * robot position + offset.
struct ProfileFrame {
  std::array<double, 9> rotation{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< By rows.
  std::array<double, 3> offset_m{};
  std::optional<double> surface_above_origin_m{};  ///< Height of the fluid's surface.
  std::optional<double> rotation_ci95_rad{}, offset_ci95_m{};  ///< Half widths.
  std::optional<int> num_points{};
  std::optional<double> residual_m{};

  bool operator==(const ProfileFrame&) const = default;
};

struct ProfileLimits {
  double max_force_per_point_n = 0.0;
  double max_total_force_n = 0.0;
  double max_slew_n_per_s = 0.0;
  double max_speed_m_per_s = 0.0;
  std::array<double, 3> workspace_half_width_m{};

  bool operator==(const ProfileLimits&) const = default;
};

struct ProfileForce {
  std::optional<MeasuredValue> gain{}, offset_n{}, hysteresis_n{};
  std::optional<double> load_uncertainty_ratio{}, pose_spread_ratio{};

  bool operator==(const ProfileForce&) const = default;
};

struct ProfileTool {
  std::optional<MeasuredValue> weight_n{};

  bool operator==(const ProfileTool&) const = default;
};

struct ProfileMechanics {
  std::optional<MeasuredValue> mass_kg{}, damping_n_s_per_m{}, friction_n{};

  bool operator==(const ProfileMechanics&) const = default;
};

struct ProfileNoise {
  std::optional<double> position_sd_m{}, position_resolution_m{}, velocity_sd_m_per_s{},
      force_sd_n{};

  bool operator==(const ProfileNoise&) const = default;
};

/// The largest value of a ladder that was stable.
struct StableUpTo {
  double value = 0.0;
  bool is_beyond_ladder = false;  ///< The whole ladder was: the limit is this or more.

  bool operator==(const StableUpTo&) const = default;
};

struct ProfileStability {
  double rate_hz = 0.0;
  double phantom_mass_kg = 0.0;
  StableUpTo viscosity_pa_s{}, stiffness_n_per_m{};
  std::optional<double> quiet_viscosity_pa_s{}, force_limit_n{};

  bool operator==(const ProfileStability&) const = default;
};

/// What was found; how it was judged is told by `passed` alone.
struct DailyCheck {
  std::string checked_on;
  std::optional<MeasuredValue> gain{}, weight_n{}, damping_n_s_per_m{}, friction_n{};
  /// Of the device's frame since the profile was measured, at the middle of the marks.
  std::optional<double> turned_rad{}, shifted_m{};
  std::optional<double> position_sd_m{}, velocity_sd_m_per_s{};
  bool passed = false;

  bool operator==(const DailyCheck&) const = default;
};

struct ProfiledModel {
  std::string model;
  std::string serial, firmware;  ///< "": it does not say.

  bool operator==(const ProfiledModel&) const = default;
};

/// What was measured of one device before a hand is in it: a file NAME.device.json. Everything
/// that was not measured is absent. Units are in the names; what each field means exactly is
/// said in `device_profile_table`.
struct DeviceProfile {
  using Frame = ProfileFrame;
  using Limits = ProfileLimits;
  using Force = ProfileForce;
  using Tool = ProfileTool;
  using Mechanics = ProfileMechanics;
  using Noise = ProfileNoise;
  using StableUpTo = experiments::StableUpTo;
  using Stability = ProfileStability;
  using DailyCheck = experiments::DailyCheck;
  using Device = ProfiledModel;

  std::string name;     ///< [a-z0-9_], of the file.
  std::string comment;  ///< Of the whole file; comments of its parts are not kept.
  Device device;
  std::string measured_on;  ///< "2026-11-25", the last day of it.
  std::string valid_until;  ///< The last day on which it holds.
  std::string program_version;
  bool simulated = false;  ///< Measured on a simulated device: of no use for a real one.
  Frame frame;
  Limits limits;           ///< What a session keeps to; people may narrow it.
  Limits measured_limits;  ///< What was found.
  Force force;
  Tool tool;
  Mechanics mechanics;
  Noise noise;
  std::optional<MeasuredValue> delay_s{};
  std::optional<Stability> stability{};
  std::vector<DailyCheck> checks{};

  bool operator==(const DeviceProfile&) const = default;
};

/// How files of profiles end.
inline constexpr std::string_view kDeviceProfileEnding = ".device.json";

/// The day of the last daily check; of the measurement, where there was none.
[[nodiscard]] inline const std::string& last_checked_on(const DeviceProfile& profile) {
  return profile.checks.empty() ? profile.measured_on : profile.checks.back().checked_on;
}

/// Whether both stand for one measurement with the same limits: name, comment, `valid_until`
/// and daily checks may differ.
[[nodiscard]] inline bool is_same_measurement(DeviceProfile one, const DeviceProfile& other) {
  one.name = other.name;
  one.comment = other.comment;
  one.valid_until = other.valid_until;
  one.checks = other.checks;
  return one == other;
}

}  // namespace jnd::experiments
