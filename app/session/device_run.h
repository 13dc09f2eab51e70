#pragma once

#include <functional>
#include <memory>

#include "core/exchange/haptic_command.h"
#include "core/exchange/telemetry.h"
#include "core/safety/emergency_stop.h"
#include "core/sample.h"
#include "device/haptic_device.h"
#include "device/realtime_thread.h"

namespace jnd::app {

/// A device without a session, for somebody who looks at the device itself. Its loop runs in
/// real time in free space, watched as in a session. A real device stays disarmed, so it gets
/// no force at all. A thread beats the heartbeat as long as the program lives, and presses the
/// emergency stop when the program is asked to stop, even while it waits for somebody. Not real
/// time itself; used by one thread.
class DeviceRun {
 public:
  struct Parameters {
    double rate_hz = 1000.0;
    int cpu = -1;  ///< The processor that runs the loop; -1 for any.
    bool allow_no_realtime = false;
    /// The stop that also reaches the device; with nullptr, the run has its own.
    core::EmergencyStop* emergency_stop = nullptr;
  };

  /// Throws `core::Error` if loop or device cannot be started. The device outlives this object.
  DeviceRun(device::HapticDevice& device, const Parameters& parameters);
  ~DeviceRun();
  DeviceRun(const DeviceRun&) = delete;
  DeviceRun& operator=(const DeviceRun&) = delete;

  /// Renders a medium on a simulated device; a real one has no force whatever is asked for.
  void render(const core::MediumAmounts& medium);

  /// Takes the samples that have come, in order; call it several times a second.
  void take(const std::function<void(const core::Sample&)>& sample);
  [[nodiscard]] const core::Telemetry& telemetry() noexcept;

  /// Ends the force, turns the motors off, and closes the device. What was measured can still
  /// be read.
  void stop() noexcept;
  [[nodiscard]] const device::RealtimeThread& thread() const noexcept;
  [[nodiscard]] std::uint64_t num_dropped_samples() const noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::app
