#pragma once

#include "core/exchange/latest_value.h"
#include "core/pointer.h"
#include "core/safety/emergency_stop.h"
#include "core/safety/heartbeat.h"

namespace jnd::app {

/// Connects the window directly with the haptic thread, without any session or queue between
/// them. The window owns it, keeps it alive while an apparatus uses it, and beats the heartbeat
/// from its own thread: a window that hangs stops the force within 250 ms.
struct OperatorExchange {
  core::EmergencyStop emergency_stop;  ///< Pressed from any thread; see `Apparatus::rearm`.
  core::Heartbeat heartbeat;  ///< At least every 100 ms, as long as there is a session.
  /// From the window's thread. A window that nobody sees gives no sign of life, for nobody
  /// could press the stop in it.
  void beat(bool is_in_sight) noexcept {
    if (is_in_sight) heartbeat.beat();
  }
  /// For the device "mouse"; published by one thread alone.
  core::LatestValue<core::PointerPosition> pointer;
};

}  // namespace jnd::app
