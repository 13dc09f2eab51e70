#include "device/plugin/driver_description.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/require.h"

namespace jnd::device {
namespace {

using core::Fault;

constexpr std::uint32_t kKnownFlags = (JND_DEVICE_PACES_LOOP << 1) - 1;
constexpr double kLongestOpening_s = 120.0;

bool has(const jnd_device_description& description, std::uint32_t flag) noexcept {
  return (description.flags & flag) != 0;
}

void require_text(const char (&text)[JND_DEVICE_TEXT_SIZE], std::string_view field) {
  const char* end = std::find(std::begin(text), std::end(text), '\0');
  const bool printable =
      std::all_of(std::begin(text), end, [](char c) { return c >= 0x20 && c < 0x7f; });
  if (end != std::end(text) && printable) return;
  throw core::Error(std::string(field) +
                    ": expected printable ASCII and a zero behind it, found something else");
}

bool has_shares(const jnd_device_description& description) noexcept {
  const auto& told = description.area_share_ratio;
  return std::any_of(std::begin(told), std::end(told), [](double one) { return one != 0.0; });
}

void require_shares(const jnd_device_description& description) {
  if (!has_shares(description)) return;
  double sum = 0.0;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const double share = description.area_share_ratio[i];
    const std::string field = "area_share_ratio[" + std::to_string(i) + "]";
    if ((description.contact_point_bits >> i & 1U) != 0) {
      core::require(share > 0.0 && share <= 1.0, field,
                    "a number above 0, for `contact_point_bits` has the point", share);
    } else {
      core::require(share == 0.0, field, "0, for `contact_point_bits` has no such point",
                    share);
    }
    sum += share;
  }
  constexpr double kMostOff = 1e-3;
  core::require(std::abs(sum - 1.0) <= kMostOff, "area_share_ratio", "numbers that sum to 1",
                sum);
}

/// Returns shares that add up to exactly 1, however the driver's numbers were rounded.
core::ShareRatios shares_of(const jnd_device_description& description) noexcept {
  if (!has_shares(description)) return core::area_shares(description.contact_point_bits);
  return core::normalised_shares(std::to_array(description.area_share_ratio));
}

core::ChannelBits channels_of(const jnd_device_description& description) noexcept {
  core::ChannelBits bits = 0;
  const auto take = [&](std::uint32_t flag, core::ChannelBits channel) {
    if (has(description, flag)) bits = static_cast<core::ChannelBits>(bits | channel);
  };
  take(JND_DEVICE_MEASURES_FORCE, core::kMeasuredForce);
  take(JND_DEVICE_HAS_ORIENTATION, core::kOrientation);
  take(JND_DEVICE_HAS_TORQUE, core::kTorque);
  take(JND_DEVICE_HAS_GRIPPER, core::kGripper);
  take(JND_DEVICE_HAS_BUTTONS, core::kButtons);
  return bits;
}

bool is_finite(const double* numbers, int count) noexcept {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += std::abs(numbers[i]);
  // Beyond this limit the unit is certainly wrong, and sums of squares would overflow.
  return sum < 1e100;
}

/// Channels that the device does not measure stay unchanged.
void take_channels(const jnd_device_description& description, const jnd_device_state& measured,
                   core::DeviceChannels& channels) noexcept {
  channels.bits = channels_of(description);
  if (channels.has(core::kMeasuredForce)) {
    for (std::size_t i = 0; i < channels.force_n.size(); ++i) {
      channels.force_n[i] = std::to_array(measured.measured_force_n[i]);
    }
  }
  if (channels.has(core::kOrientation)) {
    channels.orientation_wxyz = std::to_array(measured.orientation_wxyz);
  }
  if (channels.has(core::kTorque)) channels.torque_n_m = std::to_array(measured.torque_n_m);
  if (channels.has(core::kGripper)) channels.gripper_m = measured.gripper_m;
  if (channels.has(core::kButtons)) channels.buttons = measured.buttons;
}

template <int kCount>
Eigen::Vector3d vector_of(const double (&numbers)[kCount]) noexcept {
  static_assert(kCount == 3);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

static void require_fields(const jnd_device_description& description) {
  const auto require = core::require;
  require(description.struct_size == sizeof description, "struct_size",
          "what the program set, left as it is", description.struct_size);
  require((description.flags & ~kKnownFlags) == 0, "flags", "those of jnd_device.h alone",
          description.flags);
  require_text(description.name, "name");
  require_text(description.serial, "serial");
  require_text(description.firmware, "firmware");
  if (description.name[0] == '\0') throw core::Error("name: expected one, found none");
  require(description.contact_point_bits >= 1 &&
              description.contact_point_bits >> JND_DEVICE_MAX_POINTS == 0,
          "contact_point_bits", "1 to 31, a bit for each of five points",
          description.contact_point_bits);
  require_shares(description);
  core::require_positive(description.rate_hz, "rate_hz");
  core::require_positive(description.max_force_per_point_n, "max_force_per_point_n");
  core::require_positive(description.max_total_force_n, "max_total_force_n");
  core::require_positive(description.max_slew_n_per_s, "max_slew_n_per_s");
  core::require_positive(description.max_speed_m_per_s, "max_speed_m_per_s");
  for (const double half_width_m : description.workspace_half_width_m) {
    core::require_positive(half_width_m, "workspace_half_width_m");
  }
  core::require_not_negative(description.own_mass_kg, "own_mass_kg");
  core::require_not_negative(description.own_damping_n_s_per_m, "own_damping_n_s_per_m");
  core::require_not_negative(description.closed_loop_delay_s, "closed_loop_delay_s");
  require(description.open_timeout_s >= 0.0 && description.open_timeout_s <= kLongestOpening_s,
          "open_timeout_s", "a number from 0 to 120", description.open_timeout_s);
  if (has(description, JND_DEVICE_PACES_LOOP) && !has(description, JND_DEVICE_HAS_OWN_CLOCK)) {
    throw core::Error(
        "flags: expected a device with JND_DEVICE_PACES_LOOP to have "
        "JND_DEVICE_HAS_OWN_CLOCK, found that it does not");
  }
  if (!has(description, JND_DEVICE_IS_SIMULATED) &&
      !has(description, JND_DEVICE_HAS_OWN_CLOCK)) {
    throw core::Error(
        "flags: expected a real device to have JND_DEVICE_HAS_OWN_CLOCK, found "
        "that it does not");
  }
}

void require_description(const jnd_device_description& description) {
  try {
    require_fields(description);
  } catch (const core::Error& error) {
    throw core::Error(std::string(error.what()) + "; mend it in jnd_device_describe");
  }
}

static std::string different_field(const jnd_device_description& before,
                                   const jnd_device_description& now) {
  const auto differs = [](const auto& one, const auto& other) {
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bytes are meant
    return std::memcmp(&one, &other, sizeof one) != 0;
  };
  if (differs(before.flags, now.flags)) return "flags";
  if (differs(before.name, now.name)) return "name";
  if (before.contact_point_bits != now.contact_point_bits) return "contact_point_bits";
  if (differs(before.area_share_ratio, now.area_share_ratio)) return "area_share_ratio";
  if (differs(before.rate_hz, now.rate_hz)) return "rate_hz";
  if (differs(before.workspace_half_width_m, now.workspace_half_width_m)) {
    return "workspace_half_width_m";
  }
  if (differs(before.max_force_per_point_n, now.max_force_per_point_n)) {
    return "max_force_per_point_n";
  }
  if (differs(before.max_total_force_n, now.max_total_force_n)) return "max_total_force_n";
  if (differs(before.own_mass_kg, now.own_mass_kg)) return "own_mass_kg";
  return "another limit, the damping, the delay or the time of opening";
}

void require_same_device(const jnd_device_description& before,
                         const jnd_device_description& now) {
  require_description(now);
  jnd_device_description compared = now;
  std::memcpy(compared.serial, before.serial, sizeof compared.serial);
  std::memcpy(compared.firmware, before.firmware, sizeof compared.firmware);
  // The whole structs can be compared, because they are cleared before a driver fills them.
  if (std::memcmp(&compared, &before, sizeof compared) == 0) return;  // NOLINT: bytes are meant
  throw core::Error(
      "expected a device that is described alike before and after it is opened, "
      "but for serial and firmware, found that " +
      different_field(before, now) + " differs; tell the same in jnd_device_describe");
}

DeviceCapabilities capabilities_of(const jnd_device_description& description, double rate_hz,
                                   bool believes_simulated) noexcept {
  const bool simulated = believes_simulated && has(description, JND_DEVICE_IS_SIMULATED);
  return {.share_ratio = shares_of(description),
          .rate_hz = rate_hz,
          .max_force_per_point_n = description.max_force_per_point_n,
          .max_total_force_n = description.max_total_force_n,
          .watchdog_timeout_s = command_timeout_s(simulated),
          .has_own_clock = has(description, JND_DEVICE_HAS_OWN_CLOCK) || !simulated,
          .simulated = simulated,
          .says_simulated = has(description, JND_DEVICE_IS_SIMULATED),
          .tells_acting_force = has(description, JND_DEVICE_TELLS_ACTED_FORCE),
          .moves_by_itself = has(description, JND_DEVICE_MOVES_BY_ITSELF),
          .max_slew_n_per_s = description.max_slew_n_per_s,
          .max_speed_m_per_s = description.max_speed_m_per_s,
          .workspace = {description.workspace_half_width_m[0],
                        description.workspace_half_width_m[1],
                        description.workspace_half_width_m[2]},
          .channels = channels_of(description),
          .takes_orders = false,
          .has_enable_switch = has(description, JND_DEVICE_HAS_ENABLE_SWITCH),
          .paces_loop = has(description, JND_DEVICE_PACES_LOOP),
          .own_mass_kg = description.own_mass_kg,
          .own_damping_n_s_per_m = description.own_damping_n_s_per_m,
          .closed_loop_delay_s = description.closed_loop_delay_s};
}

void require_rate(const jnd_device_description& description, double rate_hz,
                  const std::string& place) {
  if (!has(description, JND_DEVICE_HAS_OWN_CLOCK)) return;
  constexpr double kMostOff = 0.001;
  const double ratio = description.rate_hz / rate_hz;
  const bool is_paced = has(description, JND_DEVICE_PACES_LOOP);
  if (ratio >= 1.0 - kMostOff && (!is_paced || ratio <= 1.0 + kMostOff)) return;
  throw core::Error(place + ": expected a device at " + std::to_string(rate_hz) +
                    (is_paced ? " Hz, for it paces the loop" : " Hz or faster") +
                    ", found one at " + std::to_string(description.rate_hz) +
                    " Hz; choose a study of its rate, or set the device to the study's");
}

DeviceIdentity identity_of(const jnd_device_description& description) {
  return {.model = description.name,
          .serial = description.serial,
          .firmware = description.firmware};
}

Fault checked_state(const jnd_device_description& description, const jnd_device_state& measured,
                    core::HapticState& state) noexcept {
  constexpr int kNumCoordinates = 3 * JND_DEVICE_MAX_POINTS;
  if (!is_finite(&measured.position_m[0][0], kNumCoordinates) ||
      !is_finite(&measured.velocity_m_per_s[0][0], kNumCoordinates) ||
      !is_finite(&measured.acted_n[0][0], kNumCoordinates) ||
      !is_finite(measured.end_effector_position_m, 3) ||
      !is_finite(&measured.measured_force_n[0][0], kNumCoordinates) ||
      !is_finite(measured.orientation_wxyz, 4) || !is_finite(measured.torque_n_m, 3) ||
      !is_finite(&measured.gripper_m, 1)) {
    return Fault::kNonFiniteState;
  }
  constexpr double kMostOffUnit = 0.01;
  double squared = 0.0;
  for (const double one : measured.orientation_wxyz) squared += one * one;
  if ((measured.attached_bits & ~description.contact_point_bits) != 0 || measured.enabled > 1 ||
      (has(description, JND_DEVICE_HAS_ORIENTATION) &&
       !(std::abs(squared - 1.0) <= kMostOffUnit))) {
    return Fault::kDeviceReadFailed;
  }
  state = {};
  state.device_time_ns = measured.device_time_ns;
  state.enabled = !has(description, JND_DEVICE_HAS_ENABLE_SWITCH) || measured.enabled == 1;
  state.end_effector_position_m = vector_of(measured.end_effector_position_m);
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const auto point = static_cast<std::size_t>(i);
    state.attached[point] = (measured.attached_bits >> i & 1) != 0;
    state.tip_position_m[point] = vector_of(measured.position_m[i]);
    state.tip_velocity_m_per_s[point] = vector_of(measured.velocity_m_per_s[i]);
    state.acted_n[point] = vector_of(measured.acted_n[i]);
  }
  take_channels(description, measured, state.channels);
  return Fault::kNone;
}

const char* state_problem(const jnd_device_description& description,
                          const jnd_device_state& measured) noexcept {
  constexpr int kNumCoordinates = 3 * JND_DEVICE_MAX_POINTS;
  if (!is_finite(&measured.position_m[0][0], kNumCoordinates)) {
    return "jnd_device_read: position_m holds a number that is not finite";
  }
  if (!is_finite(&measured.velocity_m_per_s[0][0], kNumCoordinates)) {
    return "jnd_device_read: velocity_m_per_s holds a number that is not finite";
  }
  if (!is_finite(&measured.acted_n[0][0], kNumCoordinates)) {
    return "jnd_device_read: acted_n holds a number that is not finite";
  }
  if (!is_finite(&measured.measured_force_n[0][0], kNumCoordinates)) {
    return "jnd_device_read: measured_force_n holds a number that is not finite";
  }
  if ((measured.attached_bits & ~description.contact_point_bits) != 0) {
    return "jnd_device_read: attached_bits has a point that contact_point_bits has not";
  }
  if (measured.enabled > 1) return "jnd_device_read: enabled is neither 0 nor 1";
  return "jnd_device_read: orientation_wxyz is no unit quaternion, or another field is not "
         "finite";
}

double command_timeout_s(bool simulated) noexcept { return simulated ? 0.250 : 0.020; }

std::vector<std::string> features_of(const jnd_device_description& description) {
  constexpr std::array<std::pair<std::uint32_t, std::string_view>, 11> kFeatures = {{
      {JND_DEVICE_MOVES_BY_ITSELF, "own_movement"},
      {JND_DEVICE_HAS_OWN_CLOCK, "own_clock"},
      {JND_DEVICE_TELLS_ACTED_FORCE, "acted_force"},
      {JND_DEVICE_HAS_DEVICE_TIME, "device_time"},
      {JND_DEVICE_HAS_ENABLE_SWITCH, "enable_switch"},
      {JND_DEVICE_HAS_ORIENTATION, "orientation"},
      {JND_DEVICE_HAS_TORQUE, "torque"},
      {JND_DEVICE_HAS_GRIPPER, "gripper"},
      {JND_DEVICE_HAS_BUTTONS, "buttons"},
      {JND_DEVICE_MEASURES_FORCE, "measured_force"},
      {JND_DEVICE_PACES_LOOP, "pace"},
  }};
  std::vector<std::string> words;
  for (const auto& [flag, word] : kFeatures) {
    if (has(description, flag)) words.emplace_back(word);
  }
  return words;
}

}  // namespace jnd::device
