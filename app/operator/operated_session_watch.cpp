#include "app/language/words.h"
#include "app/operator/operated_session.h"
#include "core/safety/fault.h"

namespace jnd::app {

void OperatedSession::watch_apparatus() {
  watch_for_faults();
  if (begun_ && !state().ended && failure_.empty()) {
    running_.keep_arming(as_is("armed by the experimenter"));
  }
  watch_for_loose_points();
}

/// With the device or this machine: not a person who stopped, a switch that was opened, or a
/// link that has to become good first.
static bool says_something_is_wrong(core::Fault fault) noexcept {
  return core::is_failure(fault) && fault != core::Fault::kEmergencyStop &&
         fault != core::Fault::kNotEnabled && fault != core::Fault::kLinkLost;
}

/// A fault is stored as soon as it is seen; the attempt it hit counts for nothing. The next one
/// may latch before anybody has seen that the last was over.
void OperatedSession::watch_for_faults() {
  const core::Telemetry now = running_.apparatus().telemetry();
  if (now.fault == core::Fault::kNone) return arming_succeeded();
  const bool latched_anew = rearming_ && now.num_faults != known_num_faults_;
  if ((now.fault == known_fault_ && !latched_anew) || !failure_.empty()) return;
  if (known_fault_ == core::Fault::kNone) {
    was_paused_before_fault_ = state().paused;
    if (says_something_is_wrong(now.fault)) ++num_own_faults_;
  }
  known_fault_ = now.fault;
  rearming_ = false;
  abandon_presentation();
  if (now.fault == core::Fault::kEmergencyStop) remember_stop();
  if (!begun_ || state().ended || !core::is_failure(now.fault)) return;
  running_.keep_fault();
  if (const auto trial = state().current_trial(); trial && state().trial(*trial).under_way) {
    session_.put_off_attempt(std::string(as_is("fault: ")) + std::string(name(now.fault)));
  }
  running_.keep_timing();
}

/// The session goes on by itself only from what the fault alone had stopped.
void OperatedSession::arming_succeeded() {
  if (known_fault_ == core::Fault::kNone || !rearming_) return;
  known_fault_ = core::Fault::kNone;
  rearming_ = false;
  resting_for_trial_ = 0;
  const bool may_go_on = !was_paused_before_fault_ && loose_bits() == 0;
  if (begun_ && may_go_on && state().paused && !state().ended) session_.go_on();
}

std::uint8_t OperatedSession::loose_bits() const {
  return attachment_.loose_bits(running_.apparatus().telemetry());
}

/// A point that comes off while something is felt: that counts for nothing, and nothing goes on
/// before the operator says so, even if the point holds again.
void OperatedSession::watch_for_loose_points() {
  if (known_fault_ != core::Fault::kNone || !failure_.empty()) return;
  if (!presenter_.under_way() && !feeling_) return;
  const std::uint8_t came_off = attachment_.came_off_bits(running_.apparatus().telemetry());
  if (came_off == 0) return;
  abandon_presentation();
  const std::string reason = came_off_reason(came_off);
  if (const auto trial = state().current_trial(); trial && state().trial(*trial).under_way) {
    session_.put_off_attempt(reason);
  }
  session_.pause(reason);
  paused_for_bits_ = came_off;
  running_.apparatus().put_fingers_back();
}

}  // namespace jnd::app
