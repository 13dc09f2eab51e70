#include <algorithm>
#include <utility>

#include "app/language/words.h"
#include "app/operator/operated_session.h"
#include "core/safety/fault.h"
#include "experiments/session/trial_course.h"

namespace jnd::app {

using experiments::CueMoment;

void OperatedSession::watch_apparatus() {
  remember_new_stop();
  watch_for_faults();
  if (begun_ && !state().ended && failure_.empty()) {
    running_.keep_arming(as_is("armed by the experimenter"));
    running_.follow_streams();
    if (!presenter_.under_way() && !feeling_) running_.follow_markers();
  }
  watch_for_loose_points();
}

/// True for faults of the device or of this machine. A person who stops, an open switch, or a
/// link that has to become good first are no such faults.
static bool says_something_is_wrong(core::Fault fault) noexcept {
  return core::is_failure(fault) && fault != core::Fault::kEmergencyStop &&
         fault != core::Fault::kNotEnabled && fault != core::Fault::kLinkLost;
}

/// Stores a fault as soon as it is seen, and gives up the attempt that it hit. The next fault
/// may latch before anybody has seen that the last one was over.
void OperatedSession::watch_for_faults() {
  const core::Telemetry now = running_.apparatus().telemetry();
  seen_num_faults_ = now.num_faults;
  if (now.fault == core::Fault::kNone) return arming_succeeded();
  const bool latched_anew = rearming_ && now.num_faults != known_num_faults_;
  if ((now.fault == known_fault_ && !latched_anew) || !failure_.empty()) return;
  if (known_fault_ == core::Fault::kNone) {
    was_paused_before_fault_ = state().paused;
    if (says_something_is_wrong(now.fault)) ++num_own_faults_;
  }
  const std::string given = doubted_words();
  known_fault_ = now.fault;
  rearming_ = false;
  abandon_presentation();
  if (!begun_ || state().ended || !core::is_failure(now.fault)) return;
  running_.keep_fault();
  if (const auto trial = state().current_trial(); trial && state().trial(*trial).under_way) {
    session_.put_off_attempt(std::string(as_is("fault: ")) + std::string(name(now.fault)) +
                             given);
  }
  running_.keep_timing();
}

/// The session goes on by itself only if nothing but the fault had stopped it.
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

/// When a point comes off while something is felt, that does not count, and nothing goes on
/// until the operator says so, even if the point holds again.
void OperatedSession::watch_for_loose_points() {
  if (known_fault_ != core::Fault::kNone || !failure_.empty()) return;
  if (!presenter_.under_way() && !feeling_) return;
  const std::uint8_t came_off = attachment_.came_off_bits(running_.apparatus().telemetry());
  if (came_off == 0) return;
  const std::string given = doubted_words();
  abandon_presentation();
  const std::string reason = came_off_reason(came_off);
  if (const auto trial = state().current_trial(); trial && state().trial(*trial).under_way) {
    session_.put_off_attempt(reason + given);
  }
  session_.pause(reason);
  paused_for_bits_ = came_off;
  running_.apparatus().put_fingers_back();
}

/// Plays the block's noise and the cue that a trial can begin. What has to be stored of them
/// waits until nothing is felt.
void OperatedSession::watch_sound() {
  SessionSound* sound = running_.sound();
  if (sound == nullptr || !begun_ || state().ended || !failure_.empty() || left_) return;
  sound->play(state().stage_open ? block() : nullptr);
  if (step() == Step::kReady && !std::exchange(is_ready_told_, true)) {
    const std::int64_t trial = *state().current_trial();
    sound->cue(CueMoment::kReady, trial, state().trial(trial).attempt + 1, 0);
  }
  if (!presenter_.under_way() && !feeling_) running_.follow_sound();
}

bool OperatedSession::feels_stimulus() const {
  const std::optional<std::int64_t> trial = state().current_trial();
  return presenter_.under_way() && trial && block() != nullptr &&
         state().trial(*trial).presentations.back().interval != "free_space";
}

double OperatedSession::least_left_s(double before_s) const {
  if (!feels_stimulus() || block()->min_stimulus_s <= 0.0) return 0.0;
  return std::max(0.0, block()->min_stimulus_s - presenter_.felt_s() + before_s);
}

std::optional<double> OperatedSession::deadline_left_s() const {
  const std::optional<std::int64_t> number = state().current_trial();
  if (block() == nullptr || !block()->answer_deadline_s || !number) return std::nullopt;
  const experiments::TrialState& trial = state().trial(*number);
  if (!trial.under_way) return std::nullopt;
  const auto asked = experiments::asked_tick(session_.current_form(), trial);
  if (!asked) return std::nullopt;
  const auto since = static_cast<double>(running_.apparatus().next_tick() - *asked);
  return *block()->answer_deadline_s - since / parameters_.study.device.rate_hz;
}

bool OperatedSession::stimulus_is_over() const {
  const std::optional<std::int64_t> number = state().current_trial();
  if (block() == nullptr || presenter_.under_way() || !number) return false;
  const experiments::TrialState& trial = state().trial(*number);
  return trial.under_way && !trial.presentations.empty();
}

}  // namespace jnd::app
