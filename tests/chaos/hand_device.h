#pragma once

#include <array>
#include <functional>
#include <vector>

#include "chaos/oracle.h"
#include "chaos/schedule.h"
#include "device/haptic_device.h"

namespace jnd::chaos {

/// The device at the very end: a hand of one mass, which a person's spring moves to and fro
/// under the forces that arrive. It spoils its measurements as the schedule says, and reports
/// everything to the oracle. It does not call itself simulated, so the program treats it as a
/// real device.
class HandDevice final : public device::HapticDevice {
 public:
  /// `schedule` and `oracle` must outlive this object.
  HandDevice(const Schedule& schedule, Oracle& oracle);

  [[nodiscard]] std::string_view name() const noexcept override { return "chaos"; }
  [[nodiscard]] device::DeviceCapabilities capabilities() const noexcept override {
    return {.tells_acting_force = true};
  }
  void open() override {}
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override {}
  void halt() noexcept override;

  /// Moves the hand for a millisecond under the present force.
  void pass_millisecond(int now_ms);

  /// Called between a measurement and the force that follows from it.
  std::function<void()> after_read;
  /// Whether the schedule pulls this device's cable. If false, the network does that.
  bool has_cable = true;

 private:
  /// This history is longer than any delay that a schedule draws.
  static constexpr int kHistory_ms = 128;

  [[nodiscard]] bool is_on(Trouble what) const {
    return schedule_.on(what, now_ms_) != nullptr;
  }
  [[nodiscard]] bool is_unplugged() const { return has_cable && is_on(Trouble::kUnplugged); }
  [[nodiscard]] int lateness_ms(int always_ms, Trouble what) const;
  [[nodiscard]] Eigen::Vector3d force_of_person_n() const;
  void zero_by_itself();
  void remember(const core::PointVectors& acted_n);
  void spoil(core::HapticState& state) const;
  void take_force_away();

  const Schedule& schedule_;
  Oracle& oracle_;
  int now_ms_ = 0;
  int last_write_ms_ = 0;
  bool is_halted_ = false;
  core::PointVectors standing_n_ = core::zero_vectors();
  Eigen::Vector3d position_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d filtered_m_per_s_ = Eigen::Vector3d::Zero();
  std::array<core::HapticState, kHistory_ms> measured_;
  std::array<core::PointVectors, kHistory_ms> sent_n_;
  core::HapticState frozen_;
};

}  // namespace jnd::chaos
