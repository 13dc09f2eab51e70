#include "chaos/program_in_virtual_time.h"

#include <cmath>

#include "core/media/medium.h"

namespace jnd::chaos {
namespace {

/// `device::WatchedLoop` has these values for a device at which somebody can be hurt.
constexpr int kLongestStall_ms = 20;
constexpr int kLookEvery_ms = 2;
constexpr int kBeatEvery_ms = 10;

std::int64_t in_ns(int time_ms) { return std::int64_t{1'000'000} * time_ms; }

}  // namespace

void ProgramInVirtualTime::start(device::HapticDevice& device) {
  exchange_ = std::make_unique<Exchange>();
  loop_ = std::make_unique<device::HapticLoop>(
      device::HapticLoop::Parameters{}, device,
      device::HapticLoop::Exchange{exchange_->commands, exchange_->telemetry, stop_, nullptr,
                                   &exchange_->heartbeat, &exchange_->watchdog});
  watchdog_ = std::make_unique<device::Watchdog>(device::Watchdog::Parameters{}, device,
                                                 exchange_->watchdog);
  last_tick_ms_ = 0;
  sequence_ = 0;
  oracle_.program_started();
  send_medium(schedule_.viscosity_pa_s, false);
}

void ProgramInVirtualTime::kill() {
  watchdog_.reset();
  loop_.reset();
}

void ProgramInVirtualTime::send_medium(double viscosity_pa_s, bool is_broken) {
  core::MediumAmounts medium = core::viscous({.viscosity_pa_s = viscosity_pa_s});
  if (is_broken) medium.damping_n_s_per_m = std::nan("");
  exchange_->commands.publish({.sequence = ++sequence_,
                               .medium = medium,
                               .immersion = {.radius_m = 10.0, .depth_m = 10.0}});
  oracle_.medium_sent(is_broken);
}

void ProgramInVirtualTime::act(const Event& event) {
  switch (event.what) {
    case Trouble::kPressStop:
      stop_.press();
      return oracle_.stop_pressed();
    case Trouble::kReleaseStop:
      if (stop_.release(stop_.num_presses())) oracle_.stop_released();
      return;
    default:
      break;
  }
  if (!runs()) return;
  switch (event.what) {
    case Trouble::kArm:
      (void)exchange_->telemetry.fetch();
      loop_->rearm(exchange_->telemetry.value().num_faults);
      return oracle_.armed();
    case Trouble::kDisarm:
      loop_->disarm();
      return oracle_.disarmed();
    case Trouble::kNewMedium:
      return send_medium(event.size, false);
    case Trouble::kBrokenMedium:
      return send_medium(schedule_.viscosity_pa_s, true);
    default:
      return;
  }
}

void ProgramInVirtualTime::pass_millisecond(int now_ms) {
  // A stopped program receives no keys.
  if (is_on(Trouble::kProgramStops, now_ms)) return;
  for (const Event& event : schedule_.events) {
    if (event.at_ms == now_ms) act(event);
  }
  if (!runs()) return;
  if (now_ms % kBeatEvery_ms == 0 && !is_on(Trouble::kWindowStalls, now_ms)) {
    exchange_->heartbeat.beat();
    oracle_.window_beat();
  }
  if (now_ms % kLookEvery_ms == 0) watchdog_->look(in_ns(now_ms));
}

void ProgramInVirtualTime::tick_if_due(int now_ms) {
  if (!runs() || is_on(Trouble::kProgramStops, now_ms) || is_on(Trouble::kLoopStalls, now_ms)) {
    return;
  }
  const int num_missed = last_tick_ms_ == 0 ? 0 : now_ms - last_tick_ms_ - 1;
  // The loop's real-time thread does the same.
  if (num_missed >= kLongestStall_ms) loop_->stalled();
  loop_->due(in_ns(now_ms), num_missed);
  last_tick_ms_ = now_ms;
  is_within_tick_ = true;
  loop_->tick();
  is_within_tick_ = false;
  oracle_.loop_ticked();
}

void ProgramInVirtualTime::press_stop_within_tick(int now_ms) {
  for (const Event& event : schedule_.events) {
    if (event.what != Trouble::kPressStopWithinTick || event.at_ms != now_ms) continue;
    stop_.press();
    oracle_.stop_pressed();
  }
}

}  // namespace jnd::chaos
