#pragma once

#include <memory>

#include "chaos/oracle.h"
#include "chaos/schedule.h"
#include "device/haptic_loop.h"
#include "device/watchdog.h"

namespace jnd::chaos {

/// The part of the program that reaches the device: loop, watchdog and window, with the people
/// before it. A schedule drives it millisecond by millisecond. The owner also moves the device
/// on.
class ProgramInVirtualTime {
 public:
  /// `schedule` and `oracle` must outlive this object.
  ProgramInVirtualTime(const Schedule& schedule, Oracle& oracle)
      : schedule_(schedule), oracle_(oracle) {}

  /// Starts disarmed with this device, as a new process does. A stop that people had pressed
  /// stays pressed, as at the start of a session.
  void start(device::HapticDevice& device);
  void kill();
  [[nodiscard]] bool runs() const noexcept { return loop_ != nullptr; }

  /// Does what people, the window and the watchdog do in this millisecond.
  void pass_millisecond(int now_ms);
  /// Runs the loop's tick of this millisecond, unless the schedule says that there is none.
  void tick_if_due(int now_ms);
  /// Does the acts of people that come within a tick, after the device was read.
  void press_stop_within_tick(int now_ms);
  /// Returns whether a tick is under way. The loop's thread measures how long its tick took.
  [[nodiscard]] bool is_within_tick() const noexcept { return is_within_tick_; }

 private:
  struct Exchange {
    core::LatestValue<core::HapticCommand> commands;
    core::LatestValue<core::Telemetry> telemetry;
    core::Heartbeat heartbeat;
    core::WatchdogState watchdog;
  };

  void act(const Event& event);
  void send_medium(double viscosity_pa_s, bool is_broken);
  [[nodiscard]] bool is_on(Trouble what, int now_ms) const {
    return schedule_.on(what, now_ms) != nullptr;
  }

  const Schedule& schedule_;
  Oracle& oracle_;
  core::EmergencyStop stop_;
  std::unique_ptr<Exchange> exchange_;
  std::unique_ptr<device::HapticLoop> loop_;
  std::unique_ptr<device::Watchdog> watchdog_;
  std::uint64_t sequence_ = 0;
  int last_tick_ms_ = 0;
  bool is_within_tick_ = false;
};

}  // namespace jnd::chaos
