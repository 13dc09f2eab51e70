#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <variant>

#include "app/language/words.h"
#include "app/operator/operated_session.h"
#include "app/operator/session_words.h"
#include "app/operator/trial_intervals.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/safety/fault.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/session/trial_course.h"
#include "experiments/study/media.h"

namespace jnd::app {

using namespace experiments;

namespace {

/// The height relative to the surface at which a solid is touched.
constexpr double kTouchingM = -0.005;
/// After so many faults in one sitting, somebody has to look at the device.
constexpr int kMostFaults = 3;

[[noreturn]] void refuse(const std::string& sentence) { throw core::Error(sentence); }

/// True if the words are empty or white space only.
bool is_blank(const std::string& words) {
  return words.find_first_not_of(" \t\n") == std::string::npos;
}

/// Refuses an interval that cannot be asked for now, in trials whose intervals have an order.
void require_order(const TrialForm& form, const TrialState& trial,
                   const std::string& interval) {
  if (form.order_is_drawn && form.num_intervals > 2 && interval == "third" &&
      !(trial.under_way && felt(trial, "second"))) {
    refuse(tr("the intervals come in their order"));
  }
  if (form.order_is_drawn && interval == "second" &&
      !(trial.under_way && felt(trial, "first"))) {
    refuse(tr("the first interval comes first"));
  }
  const std::string before = first_interval(form);
  if (interval == last_interval(form) && before != interval &&
      !(trial.under_way && felt(trial, before))) {
    refuse(form.order_is_drawn ? tr("the first interval comes first")
                               : tr("the reference comes first"));
  }
  if (interval == "reference" && !form.has_reference) refuse(tr("this block has no reference"));
  if (form.order_is_drawn && (interval == "reference" || interval == "test")) {
    refuse(tr("this block has a first and a second interval"));
  }
}

}  // namespace

/// What each request does. Each throws `Error` if it is not possible now.
struct OperatedSession::Act {
  OperatedSession& my;

  void operator()(const operate::Begin& begin) const {
    if (my.begun_) refuse(tr("the session has begun already"));
    require_sound(begin.choice);
    const bool is_new = !my.state().started;
    my.running_.begin(begin.choice, my.language_);
    my.begun_ = true;
    my.begun_s_ = my.now_s();
    if (is_new && !my.parameters_.fitting.empty()) {
      my.running_.keep_fitting(my.parameters_.fitting);
    }
  }

  void operator()(const operate::AnswerItem& given) const {
    require_running();
    if (given.stage != my.state().stage) refuse(tr("that question's stage is over"));
    if (is_blank(given.answer)) refuse(tr("expected an answer, found none"));
    const Step step = my.step();
    if (step != Step::kItem && step != Step::kFeeling && step != Step::kStageDone &&
        step != Step::kMedium) {
      refuse(tr("nothing is asked now"));
    }
    if (my.block() != nullptr) {
      const std::optional<OpenQuestion> open = my.session_.open_question();
      if (!open || open->trial != given.trial || open->item->name != given.item) {
        refuse(tr("that question is answered already"));
      }
      return my.session_.answer_question(given.item, given.answer);
    }
    if (step == Step::kFeeling) my.end_feeling(true);
    my.session_.answer_item(given.item, given.answer);
  }

  void operator()(const operate::FeelMedium&) const {
    require_running();
    const std::optional<Exploration> medium = my.next_medium();
    if (my.step() != Step::kMedium || !medium) refuse(tr("no medium waits to be felt"));
    my.session_.require_exposure_left();
    begin_feeling();
    my.feeling_ =
        Feeling{.first_tick = my.running_.apparatus().next_tick(), .setting = medium->setting};
    my.running_.apparatus().render(amounts_of(medium->setting));
    my.move_simulated_hand(experiments::is_pressed(medium->setting.medium) ? kTouchingM
                                                                           : -0.15);
  }

  void operator()(const operate::FinishMedium&) const {
    require_running();
    if (my.step() != Step::kFeeling) refuse(tr("no medium is being felt"));
    my.end_feeling(true);
  }

  void operator()(const operate::FinishStage& finish) const {
    require_running();
    // The button was pressed twice, and the stage is finished.
    if (finish.stage != my.state().stage) return;
    const Step step = my.step();
    if (step == Step::kBreak) {
      if (my.now_s() < my.break_until_s_) {
        if (is_blank(finish.reason))
          refuse(tr("the rest is not over; going on early needs a reason"));
        my.session_.note(as_is("went on before the end of the rest: ") + finish.reason);
      }
    } else if (step != Step::kStageDone) {
      refuse(tr("the stage is not done yet"));
    }
    my.session_.finish_stage();
    my.running_.keep_timing();
  }

  void operator()(const operate::Present& present) const {
    const TrialState& trial = require_trial(present.trial);
    require_order(my.session_.current_form(), trial, present.interval);
    require_return(trial, present.interval);
    my.session_.require_interval(present.interval);
    require_felt();
    require_in_time();
    my.doubted_.reset();
    begin_feeling();
    if (!trial.under_way) {
      my.first_felt_s_.reset();
      my.session_.start_trial(my.running_.apparatus().next_tick());
    }
    end_presentation();
    my.presenter_.begin(*my.block(), present.interval);
    const bool is_pressed = my.block()->is_pressed_in(present.interval);
    my.move_simulated_hand(is_pressed ? kTouchingM : -0.15);
  }

  void operator()(const operate::Answer& answer) const {
    const TrialState& trial = require_trial(answer.trial);
    const TrialForm form = my.session_.current_form();
    const bool is_over = my.stimulus_is_over() && !form.adjustable;
    if (!(my.presenter_.under_way() || is_over) || !can_answer(form, trial)) {
      refuse(tr("the test has not been felt yet"));
    }
    if (form.adjustable && trial.presentations.back().interval == "reference") {
      refuse(tr("the fluid to adjust is not being felt"));
    }
    my.session_.require_answer(answer.value);
    const double before_s = my.given_before_s(answer);
    require_felt(before_s);
    if (my.doubt_stands()) refuse(tr("the answer before waits to be confirmed"));
    require_in_time(given_words(answer), before_s);
    double response_time_s = my.presenter_.felt_s();
    if (is_over) {
      const std::int64_t now_tick = my.running_.apparatus().next_tick() - 1;
      const auto since = static_cast<double>(now_tick - trial.presentations.back().first_tick);
      response_time_s = since / my.parameters_.study.device.rate_hz;
    }
    response_time_s -= before_s;
    // The button was pressed before there was anything to answer.
    if (!(response_time_s >= 0.0)) return;
    std::vector<AnswerDoubt> doubts =
        my.parameters_.asks_about_answers
            ? doubts_about(my.given_answer(trial, form.answer, answer.value))
            : std::vector<AnswerDoubt>();
    if (doubts.empty()) return store(answer, response_time_s);
    my.doubted_ = Doubted{answer, trial.attempt, response_time_s, std::move(doubts)};
    // Whatever happens before somebody confirms it, the log knows of it.
    my.session_.note(my.note_of_doubt(as_is("not confirmed yet")));
  }

  void operator()(const operate::UseControl& use) const {
    if (const std::optional<OperatorRequest> meant = my.meaning_of(use)) my.carry_out(*meant);
  }

  void operator()(const operate::StoreDoubted& confirmed) const {
    require_doubt(confirmed.trial);
    my.session_.note(my.note_of_doubt(as_is("stored")));
    const Doubted doubted = *std::exchange(my.doubted_, std::nullopt);
    store(doubted.answer, doubted.response_time_s);
  }

  void operator()(const operate::GoBack& back) const {
    require_doubt(back.trial);
    my.session_.note(my.note_of_doubt(as_is("not stored, the trial went on")));
    my.doubted_.reset();
  }

  void operator()(const operate::Adjust& adjust) const {
    const TrialState& trial = require_trial(adjust.trial);
    if (!my.presenter_.under_way() || trial.presentations.back().interval != "test") {
      refuse(tr("the fluid to adjust is not being felt"));
    }
    const bool possible = my.session_.can_adjust(adjust.direction, adjust.size);
    // Where levels are hidden, an end of the range looks like any other step.
    if (!possible && !my.hides_levels_) {
      refuse(adjust.direction == Direction::kLower ? tr("it cannot go lower")
                                                   : tr("it cannot go higher"));
    }
    require_felt();
    require_in_time();
    my.doubted_.reset();
    end_presentation(Presenter::Afterwards::kNextStep);
    my.session_.adjust(adjust.direction, adjust.size);
    my.presenter_.begin(*my.block(), "test", Presenter::Beginning::kStep);
  }

  void operator()(const operate::Undo& undo) const {
    require_running();
    require_reason(undo.reason);
    my.session_.require_undo();
    abandon_presentation();
    my.session_.undo(undo.reason);
    my.resting_for_trial_ = 0;
  }

  void operator()(const operate::RunAgain& again) const {
    require_running();
    require_reason(again.reason);
    my.session_.require_run_again(again.trial);
    abandon_presentation();
    my.session_.run_again(again.trial, again.reason);
    my.resting_for_trial_ = 0;
  }

  void operator()(const operate::Correct& correct) const {
    require_reason(correct.reason);
    my.session_.correct(correct.trial, correct.value, correct.reason);
  }

  void operator()(const operate::AddNote& note) const {
    if (!my.begun_ || is_blank(note.text)) refuse(tr("expected a note, found no words"));
    my.session_.note(note.text);
  }

  /// May happen at any time, also before the first stimulus and after the last one.
  void operator()(const operate::ReportAdverseEvent& report) const {
    if (is_blank(report.text)) refuse(tr("expected what happened, found no words"));
    my.parameters_.store.add_adverse_event(my.row_.session, core::SystemClock().now_ns(),
                                           report.text);
  }

  void operator()(const operate::Pause& pause) const {
    require_running();
    const std::string given = my.doubted_words();
    my.abandon_presentation();
    if (my.state().current_trial() && my.state().trial(*my.state().current_trial()).under_way) {
      my.session_.discard_attempt("paused" + given);
    }
    my.was_paused_before_fault_ = true;  // Arming is no going on.
    my.session_.pause(pause.reason);
  }

  /// The reason may also come after a fault in between.
  void operator()(const operate::ExplainPause& why) const {
    require_reason(why.reason);
    if (my.state().unexplained_pause == 0 || my.state().ended) {
      refuse(tr("no pause waits for its reason"));
    }
    my.session_.explain_pause(why.reason);
  }

  void operator()(const operate::GoOn&) const {
    require_begun_and_armed();
    require_held();
    if (my.running_.sound() != nullptr) my.running_.sound()->try_again();
    go_on();
  }

  void operator()(const operate::GoOnWithout& without) const {
    require_begun_and_armed();
    require_reason(without.reason);
    const std::uint8_t loose = my.loose_bits();
    if (loose == 0) refuse(tr("nothing has come off that does not hold again"));
    if (without.point_bits != loose) refuse(tr("other points have come off by now"));
    my.session_.note(as_is("goes on without ") + words_of_points(loose) + ": " +
                     without.reason);
    my.attachment_.give_up(loose);
    if (my.state().paused) go_on();
  }

  void operator()(const operate::ReleaseStop& release) const {
    if (!my.parameters_.exchange.emergency_stop.release(release.num_stop_presses)) {
      refuse(tr("the emergency stop was pressed again"));
    }
    my.forget_stop();
    if (my.begun_ && !my.state().ended) {
      my.session_.arming_changed(std::string(core::name(core::Arming::kFaulted)),
                                 as_is("the emergency stop was released by the experimenter"));
    }
  }

  void operator()(const operate::Rearm& rearm) const {
    if (my.known_fault_ == core::Fault::kNone) refuse(tr("there is nothing to arm"));
    if (my.parameters_.exchange.emergency_stop.is_pressed()) {
      refuse(tr("the emergency stop is pressed: release it first"));
    }
    if (my.num_own_faults_ >= kMostFaults) {
      refuse(
          tr("three faults of the device or this machine in one sitting are enough: leave the "
             "session, find out why, and resume it"));
    }
    const core::Telemetry now = my.running_.apparatus().telemetry();
    if (now.arming_wait_s > 0.0) {
      refuse(tr("the emergency stop was released just now: wait half a second, then arm"));
    }
    if (rearm.num_faults_seen != now.num_faults) {
      refuse(tr("another fault has come meanwhile: look at it, then arm again"));
    }
    my.known_num_faults_ = rearm.num_faults_seen;
    my.running_.apparatus().rearm(rearm.num_faults_seen);
    my.rearming_ = true;
  }

  void operator()(const operate::EndEarly& end) const {
    if (!my.begun_ || my.state().ended) refuse(tr("there is no session under way"));
    require_reason(end.reason);
    abandon_presentation();
    my.running_.keep_timing();
    my.running_.close_streams();
    my.running_.close_sound();
    my.session_.end_early(end.reason);
  }

  void operator()(const operate::Leave& leave) const {
    my.left_ = true;  // Whatever the disk says to the rest.
    const std::string unconfirmed = my.doubt_stands() ? unconfirmed_words() : "";
    my.abandon_presentation();
    if (!my.begun_ || my.state().ended) return;
    if (!unconfirmed.empty()) my.session_.note(unconfirmed);
    my.running_.keep_timing();
    my.running_.close_streams();
    my.running_.close_sound();
    my.session_.pause(leave.reason.empty() ? as_is("left by the operator") : leave.reason);
  }

  // What happens without a request. Like requests, these throw `Error` if the result is a
  // different one.

  /// No answer came in time; `given` tells of one that came too late, or is "".
  void miss_deadline(const std::string& given) const {
    if (my.presenter_.under_way()) {
      require_ticks(my.presenter_.end(Presenter::Afterwards::kFreeSpace), given);
    }
    my.session_.miss_deadline(given);
    my.resting_for_trial_ = 0;
  }

  /// The stimulus has reached its longest time. The trial goes on in free space.
  void end_stimulus() const { end_presentation(Presenter::Afterwards::kFreeSpace); }

 private:
  [[nodiscard]] std::string unconfirmed_words() const {
    return my.note_of_doubt(as_is("not stored, for nobody confirmed it"));
  }
  /// Takes the medium away, and then stores what became of the answer that was asked about:
  /// the disk may take its time, the force may not.
  void abandon_presentation() const {
    const std::string unconfirmed = my.doubt_stands() ? unconfirmed_words() : "";
    my.abandon_presentation();
    if (!unconfirmed.empty()) my.session_.note(unconfirmed);
  }
  void require_doubt(std::int64_t trial) const {
    (void)require_trial(trial);
    if (!my.doubt_stands()) refuse(tr("no answer waits to be confirmed"));
  }

  /// Stores the answer with what was felt until now; the response time ends when it was given.
  void store(const operate::Answer& answer, double response_time_s) const {
    core::AnswerMeasures measures{.response_time_s = response_time_s,
                                  .answered_by = who_gave(answer),
                                  .control = answer.control};
    if (answer.pressed_ns != 0) {
      measures.control_monotonic_s = 1e-9 * static_cast<double>(answer.pressed_ns);
    }
    if (!my.presenter_.under_way()) {
      return my.session_.answer(answer.value, measures,
                                my.running_.apparatus().next_tick() - 1);
    }
    const Presenter::Felt felt = my.presenter_.end(Presenter::Afterwards::kFreeSpace);
    require_ticks(felt, given_words(answer));
    my.session_.answer(answer.value, measures, felt.last_tick);
  }

  /// The window belongs to the experimenter, unless the participant is alone with it. The study
  /// says whose a control is.
  [[nodiscard]] std::string who_gave(const operate::Answer& answer) const {
    const bool is_theirs = !answer.control.empty() && my.block()->participant_answers;
    return my.is_alone() || is_theirs ? as_is("participant") : as_is("experimenter");
  }

  /// Refuses to go on from a stimulus that was not felt for as long as the study asks.
  /// `before_s` says how long ago somebody wanted to go on.
  void require_felt(double before_s = 0.0) const {
    if (const double left_s = my.least_left_s(before_s); left_s > 0.0) {
      refuse(tr("it has to be felt for {:.1f} s more", left_s));
    }
  }

  /// Refuses an answer after the deadline, which nobody may have noticed yet.
  void require_in_time(const std::string& given = "", double before_s = 0.0) const {
    if (my.deadline_left_s().value_or(1.0) + before_s > 0.0) return;
    miss_deadline(given);
    refuse(tr("that was too late, and the trial comes again"));
  }

  void require_return(const TrialState& trial, const std::string& interval) const {
    if (trial.under_way && felt(trial, interval) && interval != "free_space" &&
        my.block()->max_returns && num_returns(trial) >= *my.block()->max_returns) {
      refuse(tr("this trial allows no more going back"));
    }
  }

  /// Refuses to go on without sound if the study says that nobody takes part without it. A
  /// session that is only to be ended needs none.
  void require_sound(const std::string& choice) const {
    SessionSound* sound = my.running_.sound();
    if (sound == nullptr || choice == "end") return;
    sound->try_again();
    sound->require_heard();
  }

  void require_begun_and_armed() const {
    if (!my.begun_) refuse(tr("the session has not begun yet"));
    if (my.state().ended) refuse(tr("the session is over"));
    if (my.is_held_up()) refuse(tr("the device has to be armed first"));
  }

  void require_running() const {
    require_begun_and_armed();
    if (my.state().paused) refuse(tr("the session is paused"));
  }

  void go_on() const {
    my.session_.go_on();
    my.paused_for_bits_ = 0;
    my.resting_for_trial_ = 0;
  }

  /// Requires every point that has ever held, so that none is forgotten between two trials.
  void require_held() const {
    const std::uint8_t loose = my.loose_bits();
    if (loose == 0) return;
    my.running_.apparatus().put_fingers_back();
    refuse(tr("{} came off: put back what came off first, or go on without it",
              told_points(loose)));
  }

  void begin_feeling() const {
    require_held();
    my.attachment_.begin(my.running_.apparatus().telemetry());
  }

  static void require_reason(const std::string& reason) {
    if (is_blank(reason)) refuse(tr("expected a reason, found none"));
  }

  /// Requires that the trial that the operator saw is still the one that waits, so that a key
  /// pressed twice does not reach the next trial.
  const TrialState& require_trial(std::int64_t number) const {
    require_running();
    const std::optional<std::int64_t> current = my.state().current_trial();
    if (my.block() == nullptr || !my.state().stage_open || current != number) {
      refuse(tr("that trial is answered already"));
    }
    if (my.session_.open_question())
      refuse(tr("a question after the trial before comes first"));
    return my.state().trial(number);
  }

  void end_presentation(
      Presenter::Afterwards afterwards = Presenter::Afterwards::kSameMedium) const {
    if (!my.presenter_.under_way()) return;
    const TrialForm form = my.session_.current_form();
    const TrialState& trial = my.state().trial(*my.state().current_trial());
    const bool was_first =
        form.has_reference && shown_interval(form, trial) == first_interval(form);
    const Presenter::Felt felt = my.presenter_.end(afterwards);
    require_ticks(felt);
    if (was_first) my.first_felt_s_ = felt.duration_s;
  }

  /// If the loop was held up for too long, what was felt does not count, and the trial comes
  /// again later. The stored reason keeps an answer that was given to it.
  void require_ticks(const Presenter::Felt& felt, const std::string& answer = "") const {
    const std::string reason = my.presenter_.missed_reason(felt);
    if (reason.empty()) return;
    my.running_.apparatus().render(core::free_space());
    my.presenter_.abandon();
    my.session_.put_off_attempt(reason + answer);
    my.resting_for_trial_ = 0;
    refuse(
        tr("that did not count, and the trial comes again later ({}): close what burdens this "
           "machine",
           reason));
  }
};

void OperatedSession::carry_out(const OperatorRequest& request) {
  std::visit(Act{*this}, request);
}

/// Ends a stimulus at its longest time and an attempt at its deadline, without a request.
void OperatedSession::watch_times() {
  if (!failure_.empty() || left_ || !begun_ || state().paused || block() == nullptr) return;
  // An answer that the operator is asked about came in time.
  const bool is_late = !doubt_stands() && deadline_left_s().value_or(1.0) <= 0.0;
  const std::optional<double>& longest_s = block()->max_stimulus_s;
  const bool is_long = longest_s && presenter_.under_way() && feels_stimulus() &&
                       presenter_.felt_s() >= *longest_s;
  if (!is_late && !is_long) return;
  try {
    const Act act{*this};
    if (is_late) return act.miss_deadline("");
    act.end_stimulus();
  } catch (const StorageError&) {
    throw;
  } catch (const core::Error& error) {
    refusal_ = error.what();
    ++num_refusals_;
  }
}

}  // namespace jnd::app
