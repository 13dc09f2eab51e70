#include "app/commissioning/commissioned_profile.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "analysis/commissioning/single_mass.h"
#include "app/commissioning/guided_run.h"
#include "core/error.h"
#include "core/safety/force_limiter.h"
#include "core/safety/workspace.h"

namespace jnd::app {
namespace {

using experiments::DeviceProfile;
using experiments::MeasuredValue;

MeasuredValue value_of(const analysis::Measured& measured) {
  return {.value = measured.value, .ci95 = {measured.ci95_low, measured.ci95_high}};
}

/// A value that cannot be below zero, although noise may have put it there.
MeasuredValue not_negative(const analysis::Measured& measured) {
  return {.value = std::max(0.0, measured.value),
          .ci95 = {std::max(0.0, measured.ci95_low), std::max(0.0, measured.ci95_high)}};
}

/// A device's name as a profile's name: "plugin:./my.so:real" becomes "plugin_my_so_real".
std::string name_of(const std::string& device) {
  std::string name;
  for (const char letter : device) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool is_plain = std::isalnum(byte) != 0;
    if (is_plain) {
      name += static_cast<char>(std::tolower(byte));
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  constexpr std::size_t kLongest = 48;
  name.resize(std::min(name.size(), kLongest));
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "device" : name;
}

std::string half_a_year_after(const std::string& date) {
  int year = 0;
  unsigned month = 0, day = 0;
  if (std::sscanf(date.c_str(), "%4d-%2u-%2u", &year, &month, &day) != 3) {
    throw core::Error("commission: expected a date, found " + date);
  }
  const std::chrono::sys_days then =
      std::chrono::sys_days(std::chrono::year(year) / month / day) + std::chrono::days(182);
  const std::chrono::year_month_day parts(then);
  char text[16];
  (void)std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(parts.year()),
                      static_cast<unsigned>(parts.month()), static_cast<unsigned>(parts.day()));
  return text;
}

experiments::ProfileLimits limits_of(const Commissioning& commissioning) {
  constexpr double kBeyondMarks_m = 0.5;
  const device::DeviceCapabilities& can = commissioning.device().can;
  const core::ForceLimiter::Parameters allowed;
  const core::Workspace space;
  Eigen::Vector3d reached_m = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> marks_m =
      commissioning.plan().marks_m.empty() ? default_marks_m() : commissioning.plan().marks_m;
  for (const Eigen::Vector3d& mark_m : marks_m)
    reached_m = reached_m.cwiseMax(mark_m.cwiseAbs());
  const auto half_width = [&](double reached, double allowed_m, double device_m) {
    return std::min({reached + kBeyondMarks_m, allowed_m, device_m});
  };
  return {.max_force_per_point_n = std::min(can.max_force_per_point_n, allowed.per_point_n),
          .max_total_force_n = std::min(can.max_total_force_n, allowed.total_n),
          .max_slew_n_per_s = std::min(can.max_slew_n_per_s, allowed.slew_n_per_s),
          .max_speed_m_per_s = std::min(can.max_speed_m_per_s, allowed.max_speed_m_per_s),
          .workspace_half_width_m = {
              half_width(reached_m.x(), space.half_width_x_m, can.workspace.half_width_x_m),
              half_width(reached_m.y(), space.half_width_y_m, can.workspace.half_width_y_m),
              half_width(reached_m.z(), space.half_width_z_m, can.workspace.half_width_z_m)}};
}

}  // namespace

analysis::Measured mass_kg(const analysis::DelayFit& delay, const analysis::Measured& gain) {
  const analysis::Measured& mass = delay.mass_per_gain_kg;
  const double value_kg = mass.value * gain.value;
  const double open = std::hypot((mass.ci95_high - mass.value) / mass.value,
                                 (gain.ci95_high - gain.value) / gain.value);
  return {.value = value_kg,
          .ci95_low = value_kg * (1.0 - open),
          .ci95_high = value_kg * (1.0 + open)};
}

DeviceProfile profile_of(const Commissioning& commissioning,
                         const device::DeviceIdentity& identity,
                         const std::string& program_version) {
  const CommissioningResults& found = commissioning.results();
  if (const auto missing = commissioning.next_step()) {
    throw core::Error("commission: expected every step to be measured, found that " +
                      std::string(words_of(*missing).name) + " is not");
  }
  constexpr std::size_t kDate = 10;
  DeviceProfile profile;
  profile.name = name_of(commissioning.device().name);
  profile.device = {
      .model = identity.model, .serial = identity.serial, .firmware = identity.firmware};
  profile.measured_on =
      std::max_element(found.measured_at.begin(), found.measured_at.end())->substr(0, kDate);
  profile.valid_until = half_a_year_after(profile.measured_on);
  profile.program_version = program_version;
  profile.simulated = commissioning.device().can.simulated;
  const analysis::FrameFit& frame = *found.frame;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto place = static_cast<Eigen::Index>(row);
    for (std::size_t column = 0; column < 3; ++column) {
      profile.frame.rotation[3 * row + column] =
          frame.rotation(place, static_cast<Eigen::Index>(column));
    }
    profile.frame.offset_m[row] = frame.offset_m[place];
  }
  profile.frame.rotation_ci95_rad = frame.rotation_ci95_rad.maxCoeff();
  profile.frame.offset_ci95_m = frame.offset_ci95_m.maxCoeff();
  profile.frame.num_points = frame.num_marks;
  profile.frame.residual_m = frame.residual_m;
  profile.limits = profile.measured_limits = limits_of(commissioning);
  const analysis::ForceFit& force = *found.force;
  profile.force = {.gain = value_of(force.gain),
                   .hysteresis_n = not_negative(force.hysteresis_n),
                   .load_uncertainty_ratio = commissioning.plan().load_uncertainty_ratio,
                   .pose_spread_ratio = force.pose_spread_ratio};
  profile.tool.weight_n = value_of(force.weight_n);
  profile.mechanics = {.damping_n_s_per_m = not_negative(force.damping_n_s_per_m),
                       .friction_n = not_negative(force.friction_n)};
  if (analysis::is_single_mass(*found.delay, force)) {
    profile.mechanics.mass_kg = value_of(mass_kg(*found.delay, force.gain));
    profile.delay_s = not_negative(found.delay->delay_s);
  }
  profile.noise = {.position_sd_m = found.noise->position_sd_m.value,
                   .position_resolution_m = found.noise->position_resolution_m,
                   .velocity_sd_m_per_s = found.noise->velocity_sd_m_per_s.value};
  const analysis::StabilityFit& stability = *found.stability;
  profile.stability = experiments::ProfileStability{
      .rate_hz = stability.rate_hz,
      .viscosity_pa_s = {.value = stability.viscosity_pa_s,
                         .is_beyond_ladder = stability.damping.is_beyond},
      .stiffness_n_per_m = {.value = stability.stiffness_n_per_m},
      .quiet_viscosity_pa_s = stability.quiet_viscosity_pa_s,
      .force_limit_n = kCommissioningLimits.total_n};
  return profile;
}

}  // namespace jnd::app
