#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::experiments {

/// A measured value with its 95 % confidence interval.
struct MeasuredValue {
  double value = 0.0;
  std::array<double, 2> ci95{};  ///< Lower and upper end, around the value.

  bool operator==(const MeasuredValue&) const = default;
};

// The parts of a profile. Names end in units; `device_profile_table` says what each field means
// exactly. Values that were not measured are absent.

/// Transforms from the robot's frame to the workspace frame: workspace position = rotation *
/// robot position + offset.
struct ProfileFrame {
  std::array<double, 9> rotation{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< Row by row.
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

/// The largest stable value among those that were tried, in ascending steps.
struct StableUpTo {
  double value = 0.0;
  /// All values that were tried were stable, so the limit is this or more.
  bool is_beyond_ladder = false;

  bool operator==(const StableUpTo&) const = default;
};

struct ProfileStability {
  double rate_hz = 0.0;
  double phantom_mass_kg = 0.0;
  StableUpTo viscosity_pa_s{}, stiffness_n_per_m{};
  std::optional<double> quiet_viscosity_pa_s{}, force_limit_n{};

  bool operator==(const ProfileStability&) const = default;
};

/// Findings of a daily check. Only `passed` says how they were judged.
struct DailyCheck {
  std::string checked_on;
  std::optional<MeasuredValue> gain{}, weight_n{}, damping_n_s_per_m{}, friction_n{};
  /// Change of the device's frame since the profile was measured, at the middle of the marks.
  std::optional<double> turned_rad{}, shifted_m{};
  std::optional<double> position_sd_m{}, velocity_sd_m_per_s{};
  bool passed = false;

  bool operator==(const DailyCheck&) const = default;
};

struct ProfiledModel {
  std::string model;
  std::string serial, firmware;  ///< "" if the device does not report it.

  bool operator==(const ProfiledModel&) const = default;
};

/// The measurements of one device before a hand is in it, as a file NAME.device.json. Values
/// that were not measured are absent. Names end in units; `device_profile_table` says what each
/// field means exactly.
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

  std::string name;     ///< Name of the file, [a-z0-9_].
  std::string comment;  ///< Comment of the whole file. Comments of its parts are not kept.
  Device device;
  std::string measured_on;  ///< "2026-11-25", the last day of the measurement.
  std::string valid_until;  ///< The last day on which it is valid.
  std::string program_version;
  /// Measured on a simulated device, so it is not valid for a real one.
  bool simulated = false;
  Frame frame;
  Limits limits;           ///< Limits of sessions. People may narrow them.
  Limits measured_limits;  ///< Limits as measured.
  Force force;
  Tool tool;
  Mechanics mechanics;
  Noise noise;
  std::optional<MeasuredValue> delay_s{};
  std::optional<Stability> stability{};
  std::vector<DailyCheck> checks{};

  bool operator==(const DeviceProfile&) const = default;
};

/// The ending of profile files.
inline constexpr std::string_view kDeviceProfileEnding = ".device.json";

/// Returns the day of the last daily check, or of the measurement if there was none.
[[nodiscard]] inline const std::string& last_checked_on(const DeviceProfile& profile) {
  return profile.checks.empty() ? profile.measured_on : profile.checks.back().checked_on;
}

/// Whether both describe the same measurement with the same limits. Name, comment,
/// `valid_until` and daily checks may differ.
[[nodiscard]] inline bool is_same_measurement(DeviceProfile one, const DeviceProfile& other) {
  one.name = other.name;
  one.comment = other.comment;
  one.valid_until = other.valid_until;
  one.checks = other.checks;
  return one == other;
}

}  // namespace jnd::experiments
