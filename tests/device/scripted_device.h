#pragma once

#include <functional>
#include <vector>

#include "device/haptic_device.h"

namespace jnd::device {

/// A device that measures what the test says and remembers every force that it was sent. The
/// normal of the hand plane is along x, and the hand is 10 cm below the surface.
class ScriptedDevice final : public HapticDevice {
 public:
  ScriptedDevice() {
    state.tip_position_m = {Eigen::Vector3d(0, -0.061, -0.1), Eigen::Vector3d(0, -0.061, -0.16),
                            Eigen::Vector3d(0, 0, -0.08), Eigen::Vector3d(0, 0.059, -0.1),
                            Eigen::Vector3d(0, 0.064, -0.12)};
    received.reserve(100'000);
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "scripted"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return device_capabilities;
  }
  void open() override { ++num_opened; }
  [[nodiscard]] bool read(core::HapticState& measured) noexcept override {
    if (while_read) while_read();
    measured = state;
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    if (before_write) before_write();
    received.push_back(force_on_hand_n);
    const bool is_zero = force_on_hand_n == core::zero_vectors();
    if (is_zero) halted = false;
    standing_n = halted ? core::zero_vectors() : force_on_hand_n;
    state.device_time_ns += 1'000'000;
    state.acted_n = standing_n;
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      state.tip_position_m[i] += 0.001 * state.tip_velocity_m_per_s[i];
    }
    return true;
  }
  void close() noexcept override { ++num_closed; }
  void halt() noexcept override {
    halted = true;
    standing_n = core::zero_vectors();
  }

  void move_all(const Eigen::Vector3d& velocity_m_per_s) {
    state.tip_velocity_m_per_s.fill(velocity_m_per_s);
  }
  [[nodiscard]] Eigen::Vector3d last_total_n() const {
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& force : received.back()) total += force;
    return total;
  }

  core::HapticState state;
  DeviceCapabilities device_capabilities{.tells_acting_force = true};
  std::vector<core::PointVectors> received;
  core::PointVectors standing_n = core::zero_vectors();  ///< What the hand feels now.
  bool halted = false;
  std::function<void()> while_read;
  std::function<void()> before_write;
  int num_opened = 0;
  int num_closed = 0;
};

}  // namespace jnd::device
