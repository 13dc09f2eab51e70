#include "app/operator/operated_session.h"
#include "core/safety/fault.h"

namespace jnd::app {

/// A fault is stored as soon as it is seen; the attempt it hit counts for nothing.
void OperatedSession::watch_for_faults() {
  const core::Fault fault = visit_.apparatus().telemetry().fault;
  if (fault == core::Fault::kNone) {
    if (known_fault_ == core::Fault::kNone || !rearming_) return;
    known_fault_ = core::Fault::kNone;
    rearming_ = false;
    resting_for_trial_ = 0;
    if (begun_ && state().paused && !state().ended) session_.go_on();
    return;
  }
  if (known_fault_ != core::Fault::kNone || !failure_.empty()) return;
  known_fault_ = fault;
  rearming_ = false;
  abandon_presentation();
  if (!begun_ || state().ended) return;
  visit_.keep_fault();
  if (const auto trial = state().current_trial(); trial && state().trial(*trial).under_way) {
    session_.discard_attempt(std::string("fault: ") + std::string(name(fault)));
  }
  visit_.keep_timing();
}

std::uint8_t OperatedSession::loose_bits() const {
  return attachment_.loose_bits(visit_.apparatus().telemetry().sample.attached_bits);
}

/// A point that comes off while something is felt: that counts for nothing, and nothing goes on
/// before the point holds again.
void OperatedSession::watch_for_loose_points() {
  if (known_fault_ != core::Fault::kNone || !failure_.empty()) return;
  if (!presenter_.under_way() && !feeling_) return;
  const std::uint8_t loose = loose_bits();
  if (loose == 0) return;
  abandon_presentation();
  const std::string reason = came_off_reason(loose);
  if (const auto trial = state().current_trial(); trial && state().trial(*trial).under_way) {
    session_.discard_attempt(reason);
  }
  session_.pause(reason);
  visit_.apparatus().put_fingers_back();
}

}  // namespace jnd::app
