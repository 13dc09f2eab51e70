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
  /// Any thread may press it; see `Apparatus::rearm`.
  core::EmergencyStop emergency_stop;
  /// Beaten at least every 100 ms, as long as there is a session.
  core::Heartbeat heartbeat;
  /// For the device "mouse"; only one thread publishes it.
  core::LatestValue<core::PointerPosition> pointer;
};

}  // namespace jnd::app
