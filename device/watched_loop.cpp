#include "device/watched_loop.h"

#include <string>

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
  const double timeout_s = device.capabilities().watchdog_timeout_s;
  if (!(loop.period_s() < 0.5 * timeout_s)) {
    throw core::Error("rate_hz: expected a rate above " + std::to_string(2.0 / timeout_s) +
                      " Hz, so that two ticks come within the watchdog's timeout, found " +
                      std::to_string(1.0 / loop.period_s()) + " Hz");
  }
  if (parameters.cpu >= 0 && !thread_.report().pinned)
    throw core::Error(thread_.report().lacks);
  watchdog_.emplace(WatchdogThread::Parameters{.watchdog = {.timeout_s = timeout_s}}, device,
                    watched);
  start_haptics(device, loop, thread_, parameters.allow_no_realtime, &watchdog_->report());
}

void WatchedLoop::stop() noexcept {
  if (!watchdog_) return;
  thread_.stop();
  device_.halt();
  // Until here the watchdog watched a loop that may be stuck in the device and never end.
  watchdog_.reset();
  device_.close();
}

}  // namespace jnd::device
