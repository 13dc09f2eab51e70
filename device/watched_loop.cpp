#include "device/watched_loop.h"

#include "core/error.h"

namespace jnd::device {

WatchedLoop::WatchedLoop(HapticDevice& device, HapticLoop& loop, core::WatchdogState& watched,
                         const Parameters& parameters)
    : device_(device),
      thread_({.cpu = parameters.cpu,
               .clear_cpu = parameters.clear_cpu,
               .max_stall_s = device.capabilities().watchdog_timeout_s}) {
  if (!loop.is_watched_by(watched)) {
    throw core::Error(
        "haptic loop: expected a heartbeat and the state of its watchdog, found none; no "
        "device "
        "is opened without them");
  }
  if (parameters.cpu >= 0 && !thread_.report().pinned)
    throw core::Error(thread_.report().lacks);
  watchdog_.emplace(
      WatchdogThread::Parameters{
          .watchdog = {.timeout_s = device.capabilities().watchdog_timeout_s}},
      device, watched);
  start_haptics(device, loop, thread_, parameters.allow_no_realtime, &watchdog_->report());
}

void WatchedLoop::stop() noexcept {
  if (!watchdog_) return;
  thread_.stop();
  device_.halt();
  // Until now it watched over a loop that may be stuck in the device and never end.
  watchdog_.reset();
  device_.close();
}

}  // namespace jnd::device
