#pragma once

#include <functional>
#include <memory>

#include "core/exchange/telemetry.h"
#include "core/media/medium.h"
#include "core/safety/emergency_stop.h"
#include "core/safety/fault.h"
#include "core/safety/force_limiter.h"
#include "core/safety/heartbeat.h"
#include "core/sample.h"
#include "device/haptic_device.h"
#include "device/motion_guide.h"

namespace jnd::app {

/// The force that a device may give while it is measured, whatever it can do. No hand is in it,
/// but somebody stands beside it.
inline constexpr core::ForceLimiter::Parameters kCommissioningLimits = {
    .per_point_n = 10.0, .total_n = 15.0, .slew_n_per_s = 1000.0, .max_speed_m_per_s = 1.5};

/// A device that is measured: its whole haptic loop, with limiter and guards, and a guide that
/// moves it. If the device is real or has its own clock, the loop runs in real time and is
/// watched; otherwise it runs as fast as possible. The guard of energy allows as much as moving
/// the device takes. Not real time itself; used by one thread.
class GuidedRun {
 public:
  struct Parameters {
    double rate_hz = 1000.0;
    core::ForceLimiter::Parameters limits = kCommissioningLimits;
    /// Swings of the force up to this size are the guide's own pushes, and no fault.
    double swing_n = 10.0;
    bool allow_no_realtime = false;
    /// With nullptr, the run has a stop of its own.
    core::EmergencyStop* emergency_stop = nullptr;
    /// The heartbeat of a window. While it is silent, the force fades, because nobody could
    /// press the stop there. nullptr if there is no window. It outlives this object.
    const core::Heartbeat* watcher = nullptr;
  };

  /// Throws `core::Error` if loop or device cannot be started. The device outlives this object.
  GuidedRun(device::HapticDevice& device, const Parameters& parameters);
  ~GuidedRun();
  GuidedRun(const GuidedRun&) = delete;
  GuidedRun& operator=(const GuidedRun&) = delete;

  /// Force from zero over half a second. `take` gets each sample until it has grown, and may
  /// throw, after `disarm`. Throws `core::Error` saying what it is that the device is not armed
  /// for.
  void arm(const std::function<void(const core::Sample&)>& take = {});
  /// No force from the next tick on.
  void disarm() noexcept;
  /// While somebody does this at the device, however long it takes: a thread gives the sign of
  /// life, and presses the emergency stop when the program is asked to stop. The force stays as
  /// it is.
  void while_asking(const std::function<void()>& act);
  /// The same without force, of which there is none before `arm`.
  void without_force(const std::function<void()>& act);

  void order(const device::MotionGuide::Order& order);
  /// The last one.
  [[nodiscard]] const device::MotionGuide::Order& ordered() const noexcept;
  /// The loop renders this medium besides, at once; its surface lies at this height of the
  /// device's own frame. A medium without amounts: none.
  void render(const core::MediumAmounts& medium, double surface_z_m);
  /// Lets this time pass. Throws `core::Error` if the loop latches a fault, or if the program
  /// is asked to stop.
  void run_for(double duration_s, const std::function<void(const core::Sample&)>& take = {});
  /// Lets this time pass, but returns a fault that the loop latches instead of throwing it.
  /// Then there is no force until `arm`.
  [[nodiscard]] core::Fault try_for(double duration_s,
                                    const std::function<void(const core::Sample&)>& take = {});
  /// Returns the last sample after 20 ms, also while a fault is latched, as it is before `arm`.
  /// Throws `core::Error` after an emergency stop, or if the program is asked to stop.
  [[nodiscard]] const core::Sample& look();
  /// The telemetry of the last tick.
  [[nodiscard]] const core::Telemetry& telemetry();
  /// Ends the force, turns the motors off, and closes the device.
  void stop() noexcept;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::app
