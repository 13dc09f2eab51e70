#include "app/operator/operated_session.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "app/operator/live_trace.h"
#include "app/operator/scope_trace.h"
#include "app/session_setup.h"
#include "core/error.h"
#include "core/random_stream.h"
#include "core/safety/fault.h"
#include "experiments/session/stimulus.h"

namespace jnd::app {

using namespace experiments;

namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw core::Error(sentence); }

/// What must not wait behind a request that does: the operator has changed their mind.
bool is_urgent(const OperatorRequest& request) {
  return std::holds_alternative<operate::Pause>(request) ||
         std::holds_alternative<operate::Undo>(request) ||
         std::holds_alternative<operate::EndEarly>(request) ||
         std::holds_alternative<operate::Leave>(request) ||
         std::holds_alternative<operate::Rearm>(request);
}

bool is_answer(const OperatorRequest& request) {
  return std::holds_alternative<operate::Answer>(request);
}

bool felt_the_test(const TrialState& trial) {
  return std::any_of(trial.presentations.begin(), trial.presentations.end(),
                     [](const PresentationState& felt) { return felt.interval == "test"; });
}

bool felt_the_reference(const TrialState& trial) {
  return std::any_of(
      trial.presentations.begin(), trial.presentations.end(),
      [](const PresentationState& felt) { return felt.interval == "reference"; });
}

Apparatus::Parameters apparatus_parameters(const OperatedSession::Parameters& parameters,
                                           const core::SessionRow& row, bool hides_levels) {
  Apparatus::Parameters apparatus;
  apparatus.device = row.device;
  apparatus.realtime = parameters.realtime;
  apparatus.allow_no_realtime = parameters.allow_no_realtime;
  apparatus.doors = &parameters.doors;
  apparatus.injected_faults = parameters.injected_faults;
  if (hides_levels) return apparatus;
  apparatus.on_sample = [trace = parameters.trace,
                         scopes = parameters.scopes](const core::Sample& sample) {
    if (trace != nullptr) trace->take(sample);
    if (scopes != nullptr) scopes->take(sample);
  };
  return apparatus;
}

}  // namespace

OperatedSession::OperatedSession(const Parameters& parameters)
    : parameters_(parameters),
      row_(parameters.store.session(parameters.session)),
      hides_levels_(parameters.study.blinding == Blinding::kDouble &&
                    !parameters.store.unblinded()),
      remark_(changed_study_remark(parameters.store, row_)),
      visit_({.store = parameters.store,
              .session = parameters.session,
              .study = parameters.study,
              .apparatus = apparatus_parameters(parameters, row_, hides_levels_),
              .laboratory = parameters.laboratory}),
      session_(visit_.session()),
      presenter_(visit_.apparatus(), session_, parameters.study.device) {
  visit_.apparatus().render(core::free_space());
  // A session goes on in the language that it was begun in.
  language_ = !state().language.empty()      ? state().language
              : !parameters.language.empty() ? parameters.language
                                             : parameters.study.languages.front();
}

const SessionState& OperatedSession::state() const { return session_.state(); }

const Stage* OperatedSession::stage() const { return session_.current_stage(); }

const Block* OperatedSession::block() const {
  return stage() == nullptr ? nullptr : std::get_if<Block>(&stage()->content);
}

double OperatedSession::now_s() const {
  return static_cast<double>(visit_.apparatus().next_tick()) / parameters_.study.device.rate_hz;
}

void OperatedSession::request(OperatorRequest request) {
  if (const auto* adjust = std::get_if<operate::Adjust>(&request); adjust && adjust->held) {
    const bool waits =
        std::any_of(requests_.begin(), requests_.end(), [](const OperatorRequest& waiting) {
          return std::holds_alternative<operate::Adjust>(waiting);
        });
    if (waits) return;
  }
  requests_.push_back(std::move(request));
}

void OperatedSession::advance(double duration_s) {
  if (!parameters_.realtime && duration_s > 0.0) {
    try {
      visit_.apparatus().run_for(duration_s);
    } catch (const core::Error&) {
      if (visit_.apparatus().telemetry().fault == core::Fault::kNone) throw;
    }
  }
  try {
    watch_for_faults();
    watch_for_loose_points();
    if (presenter_.waits_for_ramp() && presenter_.ramp_has_passed()) presenter_.ramp_is_over();
    carry_out_requests();
    follow_session();
  } catch (const core::Error& error) {
    give_up(error.what());
  }
}

void OperatedSession::carry_out_requests() {
  while (!requests_.empty() && failure_.empty() && !left_) {
    if (must_wait(requests_.front())) {
      const auto urgent = std::find_if(requests_.begin(), requests_.end(), is_urgent);
      if (urgent == requests_.end()) return;
      const auto answer = std::find_if(requests_.begin(), urgent, is_answer);
      if (answer == urgent) {
        requests_.erase(requests_.begin(), urgent);
      } else if (std::holds_alternative<operate::Undo>(*urgent)) {
        // The answer meant is the one that still waits; those before it stay.
        requests_.erase(answer, std::next(urgent));
        continue;
      } else {
        return;  // No answer is dropped for a change of mind; the ramp is over soon.
      }
    }
    const OperatorRequest next = std::move(requests_.front());
    requests_.pop_front();
    try {
      carry_out(next);
      refusal_.clear();
    } catch (const StorageError&) {
      throw;
    } catch (const core::Error& error) {
      refusal_ = error.what();
      ++num_refusals_;
    }
    follow_session();
  }
  // The disk may have given up: leaving is all that is left.
  if (!failure_.empty()) {
    left_ = std::any_of(requests_.begin(), requests_.end(), [](const OperatorRequest& request) {
      return std::holds_alternative<operate::Leave>(request);
    });
    requests_.clear();
  }
}

bool OperatedSession::must_wait(const OperatorRequest& request) const {
  if (state().paused || known_fault_ != core::Fault::kNone) return false;
  if (std::holds_alternative<operate::Present>(request)) {
    return step() == Step::kRest || (presenter_.under_way() && !presenter_.ramp_has_passed());
  }
  if (std::holds_alternative<operate::Answer>(request) ||
      std::holds_alternative<operate::Adjust>(request)) {
    return presenter_.under_way() && !presenter_.ramp_has_passed();
  }
  return false;
}

/// What each request does. Throws `Error` for one that is not possible now.
struct OperatedSession::Act {
  OperatedSession& my;

  void operator()(const operate::Begin& begin) const {
    if (my.begun_) refuse("the session has begun already");
    my.visit_.begin(begin.choice, my.language_);
    my.begun_ = true;
    my.begun_s_ = my.now_s();
  }

  void operator()(const operate::AnswerItem& given) const {
    require_running();
    if (given.stage != my.state().stage) refuse("that question's stage is over");
    if (given.answer.empty()) refuse("expected an answer, found none");
    const Step step = my.step();
    if (step != Step::kItem && step != Step::kFeeling && step != Step::kStageDone &&
        step != Step::kMedium) {
      refuse("nothing is asked now");
    }
    if (step == Step::kFeeling) my.end_feeling(true);
    my.session_.answer_item(given.item, given.answer);
  }

  void operator()(const operate::FeelMedium&) const {
    require_running();
    const std::optional<Exploration> medium = my.next_medium();
    if (my.step() != Step::kMedium || !medium) refuse("no medium waits to be felt");
    begin_feeling();
    my.feeling_ =
        Feeling{.first_tick = my.visit_.apparatus().next_tick(), .setting = medium->setting};
    my.visit_.apparatus().render(amounts_of(medium->setting));
    constexpr double kTouchingM = -0.005;  // Of the surface, for a solid.
    my.move_simulated_hand(medium->setting.medium == "solid" ? kTouchingM : -0.15);
  }

  void operator()(const operate::FinishMedium&) const {
    require_running();
    if (my.step() != Step::kFeeling) refuse("no medium is being felt");
    my.end_feeling(true);
  }

  void operator()(const operate::FinishStage& finish) const {
    require_running();
    if (finish.stage != my.state().stage) return;  // Pressed twice: it is finished.
    const Step step = my.step();
    if (step == Step::kBreak) {
      if (my.now_s() < my.break_until_s_) {
        if (finish.reason.empty())
          refuse("the rest is not over; going on early needs a reason");
        my.session_.note("went on before the end of the rest: " + finish.reason);
      }
    } else if (step != Step::kStageDone) {
      refuse("the stage is not done yet");
    }
    my.session_.finish_stage();
    my.visit_.keep_timing();
  }

  void operator()(const operate::Present& present) const {
    const TrialState& trial = require_trial(present.trial);
    const TrialForm form = my.session_.current_form();
    if (present.interval == "test" && form.has_reference && !felt_the_reference(trial)) {
      refuse("the reference comes first");
    }
    if (present.interval == "reference" && !form.has_reference) {
      refuse("this block has no reference");
    }
    begin_feeling();
    if (!trial.under_way) {
      my.reference_felt_s_.reset();
      my.session_.start_trial(my.visit_.apparatus().next_tick());
    }
    end_presentation();
    my.presenter_.begin(*my.block(), present.interval);
    my.move_simulated_hand(-0.15);
  }

  void operator()(const operate::Answer& answer) const {
    const TrialState& trial = require_trial(answer.trial);
    if (!trial.under_way || !felt_the_test(trial)) {
      refuse("the test has not been felt yet");
    }
    const double response_time_s = my.presenter_.felt_s();
    end_presentation();
    my.session_.answer(answer.value, response_time_s, my.visit_.apparatus().next_tick() - 1);
    my.visit_.apparatus().render(core::free_space());
  }

  void operator()(const operate::Adjust& adjust) const {
    const TrialState& trial = require_trial(adjust.trial);
    if (!my.presenter_.under_way() || trial.presentations.back().interval != "test") {
      refuse("the fluid to adjust is not being felt");
    }
    const bool possible = my.session_.can_adjust(adjust.direction, adjust.size);
    // Where levels are hidden, an end of the range looks like any other step.
    if (!possible && !my.hides_levels_) {
      refuse(adjust.direction == Direction::kLower ? "it cannot go lower"
                                                   : "it cannot go higher");
    }
    end_presentation();
    my.session_.adjust(adjust.direction, adjust.size);
    my.presenter_.begin(*my.block(), "test");
  }

  void operator()(const operate::Undo& undo) const {
    require_running();
    require_reason(undo.reason);
    my.presenter_.abandon();
    my.visit_.apparatus().render(core::free_space());
    my.session_.undo(undo.reason);
    my.resting_for_trial_ = 0;
  }

  void operator()(const operate::Correct& correct) const {
    require_reason(correct.reason);
    my.session_.correct(correct.trial, correct.value, correct.reason);
  }

  void operator()(const operate::AddNote& note) const {
    const bool has_words = note.text.find_first_not_of(" \t\n") != std::string::npos;
    if (!my.begun_ || !has_words) refuse("expected a note, found no words");
    my.session_.note(note.text);
  }

  void operator()(const operate::Pause& pause) const {
    require_running();
    my.abandon_presentation();
    if (my.state().current_trial() && my.state().trial(*my.state().current_trial()).under_way) {
      my.session_.discard_attempt("paused");
    }
    my.session_.pause(pause.reason);
  }

  void operator()(const operate::GoOn&) const {
    if (my.known_fault_ != core::Fault::kNone) refuse("the device has to be armed first");
    require_held();
    my.session_.go_on();
    my.resting_for_trial_ = 0;
  }

  void operator()(const operate::Rearm& rearm) const {
    if (my.known_fault_ == core::Fault::kNone) refuse("there is nothing to arm");
    if (!my.parameters_.doors.emergency_stop.release(rearm.num_stop_presses)) {
      refuse("the emergency stop was pressed again");
    }
    my.visit_.apparatus().rearm();
    my.rearming_ = true;
  }

  void operator()(const operate::EndEarly& end) const {
    if (!my.begun_ || my.state().ended) refuse("there is no session under way");
    require_reason(end.reason);
    my.abandon_presentation();
    my.visit_.keep_timing();
    my.session_.end_early(end.reason);
  }

  void operator()(const operate::Leave& leave) const {
    my.abandon_presentation();
    my.left_ = true;
    if (!my.begun_ || my.state().ended) return;
    my.visit_.keep_timing();
    my.session_.pause(leave.reason.empty() ? "left by the operator" : leave.reason);
  }

 private:
  void require_running() const {
    if (!my.begun_) refuse("the session has not begun yet");
    if (my.state().ended) refuse("the session is over");
    if (my.known_fault_ != core::Fault::kNone) refuse("the device has to be armed first");
    if (my.state().paused) refuse("the session is paused");
  }

  /// Every point that has ever held, so that none is forgotten between two trials.
  void require_held() const {
    const std::uint8_t loose = my.loose_bits();
    if (loose == 0) return;
    my.visit_.apparatus().put_fingers_back();
    refuse(words_of_points(loose) + " came off: put back what came off first");
  }

  void begin_feeling() const {
    require_held();
    my.attachment_.begin(my.visit_.apparatus().telemetry().sample.attached_bits);
  }

  static void require_reason(const std::string& reason) {
    if (reason.empty()) refuse("expected a reason, found none");
  }

  /// The trial that the operator saw must still be the one that waits: a key pressed twice
  /// does not reach into the next.
  const TrialState& require_trial(std::int64_t number) const {
    require_running();
    const std::optional<std::int64_t> current = my.state().current_trial();
    if (my.block() == nullptr || !my.state().stage_open || current != number) {
      refuse("that trial is answered already");
    }
    return my.state().trial(number);
  }

  void end_presentation() const {
    if (!my.presenter_.under_way()) return;
    const bool was_reference =
        my.state().trial(*my.state().current_trial()).presentations.back().interval ==
        "reference";
    const Presenter::Felt felt = my.presenter_.end();
    if (was_reference) my.reference_felt_s_ = felt.duration_s;
  }
};

void OperatedSession::carry_out(const OperatorRequest& request) {
  std::visit(Act{*this}, request);
}

void OperatedSession::abandon_presentation() {
  presenter_.abandon();
  feeling_.reset();
  visit_.apparatus().render(core::free_space());
  visit_.apparatus().go_home();
}

void OperatedSession::end_feeling(bool counts) {
  const Feeling felt = *feeling_;
  feeling_.reset();
  visit_.apparatus().render(core::free_space());
  visit_.apparatus().go_home();
  if (!counts) return;
  session_.explored(felt.setting.medium, felt.setting.intensity, felt.first_tick,
                    visit_.apparatus().next_tick() - 1);
}

/// What follows of itself: the next stage, the next trial's rest, the end.
void OperatedSession::follow_session() {
  if (!begun_ || left_ || !failure_.empty()) return;
  while (!state().ended && !state().paused && known_fault_ == core::Fault::kNone) {
    if (stage() == nullptr) {
      visit_.keep_timing();
      session_.complete();
      return;
    }
    if (!state().stage_open) {
      enter_stage();
    } else if (stage_is_complete() && !std::holds_alternative<Break>(stage()->content) &&
               !std::holds_alternative<Questionnaire>(stage()->content) && block() == nullptr) {
      session_.finish_stage();
      visit_.keep_timing();
    } else {
      break;
    }
  }
  if (!state().ended && !state().paused && block() != nullptr) rest_before_trial();
}

void OperatedSession::enter_stage() {
  session_.enter_stage();
  resting_for_trial_ = 0;
  if (const auto* rest = std::get_if<Break>(&stage()->content)) {
    break_until_s_ = now_s() + rest->duration_s;
  }
}

void OperatedSession::rest_before_trial() {
  const std::optional<std::int64_t> trial = state().current_trial();
  if (!trial || state().trial(*trial).under_way || resting_for_trial_ == *trial) return;
  if (resting_for_trial_ == 0) {
    block_begun_s_ = now_s();
    answered_before_ = static_cast<std::int64_t>(state().answered_in(state().stage).size());
  }
  resting_for_trial_ = *trial;
  rest_until_s_ = now_s() + block()->free_space_between_s;
  visit_.apparatus().go_home();
}

void OperatedSession::give_up(const std::string& why) {
  if (!failure_.empty()) return;
  failure_ = why;
  parameters_.doors.emergency_stop.press();
  presenter_.abandon();
  feeling_.reset();
}

/// Of a device that moves by itself; others take no notice.
void OperatedSession::move_simulated_hand(double height_m) {
  visit_.apparatus().begin_strokes(
      {.height_m = height_m},
      core::RandomStream(row_.seed, "stroke", {state().stage, visit_.apparatus().next_tick()}));
}

}  // namespace jnd::app
