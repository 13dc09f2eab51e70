#include "app/commissioning/device_watch.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "app/language/words.h"

namespace jnd::app {
namespace {

std::string in_three(const core::PlainVector& vector, double scale, const char* unit) {
  return fmt::format("{:.1f}, {:.1f}, {:.1f} {}", scale * vector[0], scale * vector[1],
                     scale * vector[2], unit);
}

/// Such as "1, 3 pressed" or "none is pressed". Buttons are counted from 1, as on most devices.
std::string button_words(std::uint32_t buttons) {
  if (buttons == 0) return tr("none is pressed");
  std::string numbers;
  for (int i = 0; i < 32; ++i) {
    if ((buttons >> i & 1U) == 0) continue;
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(i + 1);
  }
  return tr("{} pressed", numbers);
}

double length_of(const core::PlainVector& vector) {
  return std::hypot(vector[0], vector[1], vector[2]);
}

}  // namespace

std::vector<WatchedLine> watched_lines(const device::DeviceCapabilities& can,
                                       const core::Telemetry& telemetry) {
  const core::Sample& sample = telemetry.sample;
  const core::DeviceChannels& channels = sample.channels;
  std::vector<WatchedLine> lines;
  lines.push_back({tr("Enabling switch"), !can.has_enable_switch ? tr("it has none")
                                          : telemetry.enabled    ? tr("closed")
                                                                 : tr("open: no force")});
  lines.push_back({tr("Buttons"), channels.has(core::kButtons) ? button_words(channels.buttons)
                                                               : tr("it has none")});
  std::string held;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (!can.has_point(i) || (sample.attached_bits >> i & 1U) == 0) continue;
    held += (held.empty() ? "" : ", ") + std::to_string(i + 1);
  }
  lines.push_back(
      {tr("Contact points that are held"), held.empty() ? std::string(tr("none")) : held});
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (!can.has_point(i)) continue;
    lines.push_back({tr("Place of point {}, device's frame", i + 1),
                     in_three(sample.tip_position_m[static_cast<std::size_t>(i)], 1e3, "mm")});
    break;
  }
  lines.push_back(
      {tr("Speed of the hand"),
       fmt::format("{:.0f} mm/s", 1e3 * length_of(telemetry.hand_velocity_m_per_s))});
  if (channels.has(core::kMeasuredForce)) {
    core::PlainVector sum_n{};
    for (const core::PlainVector& force_n : channels.force_n) {
      for (std::size_t axis = 0; axis < 3; ++axis) sum_n[axis] += force_n[axis];
    }
    lines.push_back({tr("Force that its sensors measure"), in_three(sum_n, 1.0, "N")});
  }
  if (channels.has(core::kTorque)) {
    lines.push_back(
        {tr("Torque that its sensors measure"), in_three(channels.torque_n_m, 1e3, "N mm")});
  }
  if (channels.has(core::kOrientation)) {
    const auto& turn = channels.orientation_wxyz;
    lines.push_back(
        {tr("Orientation, w, x, y, z"),
         fmt::format("{:.3f}, {:.3f}, {:.3f}, {:.3f}", turn[0], turn[1], turn[2], turn[3])});
  }
  if (channels.has(core::kGripper)) {
    lines.push_back({tr("Gripper"), fmt::format("{:.1f} mm", 1e3 * channels.gripper_m)});
  }
  return lines;
}

}  // namespace jnd::app
