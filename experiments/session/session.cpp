#include "experiments/session/session.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/procedures/adjustment.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/rating.h"
#include "experiments/procedures/task.h"
#include "experiments/session/session_limits.h"
#include "experiments/session/trial_course.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/question_answer.h"

namespace jnd::experiments {
namespace {

[[noreturn]] void cannot(const std::string& act, const std::string& expected) {
  throw core::Error("session: expected " + expected + " in order to " + act +
                    ", found none; nothing was stored");
}

std::string what_an_answer_is(AnswerKind kind, const Block& block) {
  if (kind == AnswerKind::kStep) {
    return "a step from 1 to " + std::to_string(num_steps_of(block));
  }
  if (kind == AnswerKind::kYesNo) return "1 or 0 for yes or no,";
  if (kind == AnswerKind::kInterval) {
    const TrialForm form = procedure_named(block.procedure).form(block);
    std::string words = std::to_string(form.first_choice);
    for (int more = 1; more < form.num_choices; ++more) {
      words += (more + 1 == form.num_choices ? " or " : ", ") +
               std::to_string(form.first_choice + more);
    }
    return words + " for an interval,";
  }
  return kind == AnswerKind::kNumber ? "a number > 0" : "a number >= 0";
}

bool is_answer(AnswerKind kind, const Block& block, double value) {
  if (kind == AnswerKind::kStep) {
    return value == std::floor(value) && value >= 1.0 && value <= num_steps_of(block);
  }
  if (kind == AnswerKind::kYesNo) return value == 0.0 || value == 1.0;
  if (kind == AnswerKind::kInterval) {
    const TrialForm form = procedure_named(block.procedure).form(block);
    return value == std::floor(value) && value >= form.first_choice &&
           value < form.first_choice + form.num_choices;
  }
  return std::isfinite(value) && (kind == AnswerKind::kNumber ? value > 0.0 : value >= 0.0);
}

/// Throws `Error` if this is no valid answer in the block. None means "cannot tell".
void require_answer_of(AnswerKind kind, const Block& block, const std::optional<double>& value,
                       const char* act) {
  if (!value && !block.cannot_tell) cannot(act, "a block with `cannot_tell` for no choice");
  if (value && !is_answer(kind, block, *value)) cannot(act, what_an_answer_is(kind, block));
}

/// Returns 1 for "first" and so on, or 0 for an interval that has no place in an order.
int place_of(const std::string& interval) {
  if (interval == "first") return 1;
  if (interval == "second") return 2;
  return interval == "third" ? 3 : 0;
}

/// Returns the same for a trial of three intervals, whose places are stored, and otherwise 0.
std::int64_t place_in(const std::string& interval, const PlannedTrial& trial) {
  return trial.intervals.empty() ? 0 : place_of(interval);
}

/// Returns what an interval of the trial holds: "test" or "reference" for "first" and "second",
/// if their order is drawn.
std::string stimulus_in(const std::string& interval, const PlannedTrial& trial) {
  const int place = place_of(interval);
  if (place > 0 && place <= std::ssize(trial.intervals)) {
    return trial.intervals[static_cast<std::size_t>(place) - 1] == 't' ? "test" : "reference";
  }
  if (!trial.test_interval || place == 0 || place > 2) return interval;
  return (interval == "first") == (*trial.test_interval == 1) ? "test" : "reference";
}

}  // namespace

std::uint64_t session_seed(std::uint64_t seed, const std::string& study,
                           const std::string& participant) {
  return core::derived_seed(seed, "session/" + study + "/" + participant);
}

Session::Session(Parameters parameters, const std::vector<core::EventRow>& history,
                 EventLog& log, const core::Clock& clock)
    : parameters_(std::move(parameters)), log_(log), clock_(clock) {
  for (const core::EventRow& row : history) apply(state_, event_from_row(row));
}

const Stage* Session::current_stage() const noexcept {
  const auto index = static_cast<std::size_t>(state_.stage);
  return index < parameters_.stages.size() ? parameters_.stages[index] : nullptr;
}

const Block& Session::current_block() const {
  const Stage* stage = current_stage();
  const Block* block = stage == nullptr ? nullptr : std::get_if<Block>(&stage->content);
  if (block == nullptr) cannot("run a trial", "a block under way");
  return *block;
}

TrialForm Session::current_form() const {
  TrialForm form = procedure_named(current_block().procedure).form(current_block());
  // A standard may be felt only in every n-th trial.
  if (const std::optional<std::int64_t> trial = state_.current_trial()) {
    form.has_reference =
        form.has_reference && state_.trial(*trial).planned.reference_intensity.has_value();
  }
  return form;
}

void Session::start(const std::string& language) {
  if (state_.started) cannot("start", "a session that has not begun");
  core::Commit rows;
  for (const auto& [field, value] : parameters_.fields) {
    rows.answers.push_back({.session = parameters_.session,
                            .sequence = state_.last_sequence + 1,
                            .stage = "participant",
                            .item = field,
                            .answer = value});
  }
  commit(SessionStarted{language, parameters_.fields}, std::move(rows));
}

void Session::answer_item(const std::string& item, const std::string& answer) {
  const Stage* stage = current_stage();
  if (stage == nullptr || !state_.stage_open) cannot("answer " + item, "a stage under way");
  core::Commit rows;
  rows.answers.push_back({.session = parameters_.session,
                          .sequence = state_.last_sequence + 1,
                          .stage = stage->name,
                          .item = item,
                          .answer = answer,
                          .stage_index = state_.stage});
  commit(ItemAnswered{state_.stage, stage->name, item, answer}, std::move(rows));
}

void Session::explored(const std::string& medium, double intensity, std::int64_t first_tick,
                       std::int64_t last_tick) {
  if (!state_.stage_open) cannot("explore a medium", "a stage under way");
  if (!std::isfinite(intensity)) cannot("explore a medium", "a finite intensity");
  commit(MediumExplored{state_.stage, medium, intensity, first_tick, last_tick});
}

void Session::finish_stage() {
  if (!state_.stage_open) cannot("finish the stage", "a stage under way");
  for (const std::int64_t stage : current_stages()) {
    if (state_.has_waiting(stage)) cannot("finish the block", "an answer to every trial");
  }
  if (open_question()) cannot("finish the block", "an answer to every question");
  const auto* block = std::get_if<Block>(&current_stage()->content);
  if (block != nullptr && block->practice) {
    note(practice_words(*block, practice_state(*block, state_.answered_in(state_.stage))));
  }
  commit(StageFinished{state_.first_together + state_.num_together - 1});
}

void Session::start_trial(std::int64_t tick) {
  const std::optional<std::int64_t> trial = state_.current_trial();
  if (!state_.stage_open || !trial || state_.trial(*trial).under_way) {
    cannot("start a trial", "a trial that waits");
  }
  if (open_question()) cannot("start a trial", "an answer to every question of the one before");
  require_exposure_left();
  commit(TrialStarted{*trial, state_.trial(*trial).attempt + 1, tick});
}

std::int64_t Session::open_trial(const char* act) const {
  const std::optional<std::int64_t> trial = state_.current_trial();
  if (!trial || !state_.trial(*trial).under_way) cannot(act, "a trial under way");
  return *trial;
}

double Session::intensity_of(const TrialState& trial, const std::string& interval) const {
  if (interval == "free_space") return 0.0;
  if (interval == "reference") {
    if (!trial.planned.reference_intensity) cannot("present the reference", "a reference");
    return *trial.planned.reference_intensity;
  }
  if (interval != "test") {
    cannot("present " + interval, "test, reference, free_space or an interval of the trial");
  }
  return trial.planned.intensity.value_or(trial.set_intensity);
}

void Session::require_interval(const std::string& interval) const {
  const std::optional<std::int64_t> trial = state_.current_trial();
  if (!trial) cannot("present " + interval, "a trial that waits");
  const TrialState& state = state_.trial(*trial);
  (void)intensity_of(state, stimulus_in(interval, state.planned));
  if (state.under_way) require_return(state, interval);
}

/// Throws `Error` if the interval was presented before and the block allows no further return.
void Session::require_return(const TrialState& trial, const std::string& interval) const {
  const std::optional<int>& most = current_block().max_returns;
  if (!most || num_returns(trial) < *most) return;
  if (was_presented(trial, stimulus_in(interval, trial.planned),
                    place_in(interval, trial.planned))) {
    cannot("present " + interval + " again",
           "a return that is left of `max_returns`, " + std::to_string(*most) + ",");
  }
}

void Session::begin_presentation(const std::string& interval, std::int64_t tick) {
  const std::int64_t number = open_trial("present a stimulus");
  const TrialState& trial = state_.trial(number);
  if (!trial.presentations.empty() && !trial.presentations.back().last_tick) {
    cannot("present another stimulus", "an end of the presentation under way");
  }
  require_return(trial, interval);
  const std::string stimulus = stimulus_in(interval, trial.planned);
  commit(PresentationStarted{
      .trial = number,
      .attempt = trial.attempt,
      .presentation = static_cast<std::int64_t>(trial.presentations.size()) + 1,
      .interval = stimulus,
      .intensity = intensity_of(trial, stimulus),
      .first_tick = tick,
      .place = place_in(interval, trial.planned)});
}

void Session::end_presentation(std::int64_t last_tick, const PresentationSummary& summary) {
  const std::int64_t number = open_trial("end a presentation");
  const TrialState& trial = state_.trial(number);
  if (trial.presentations.empty() || trial.presentations.back().last_tick) {
    cannot("end a presentation", "a presentation under way");
  }
  const PresentationState& open = trial.presentations.back();
  const auto presentation = static_cast<std::int64_t>(trial.presentations.size());
  core::Commit rows;
  rows.presentation = core::PresentationRow{.session = parameters_.session,
                                            .trial = number,
                                            .attempt = trial.attempt,
                                            .presentation = presentation,
                                            .sequence = state_.last_sequence + 1,
                                            .interval = open.interval,
                                            .intensity = open.intensity,
                                            .first_tick = open.first_tick,
                                            .last_tick = last_tick,
                                            .measures = summary.measures};
  commit(PresentationEnded{number, trial.attempt, presentation, last_tick, summary},
         std::move(rows));
}

/// Returns where a step leads from the intensity of the trial under way.
double Session::adjusted(Direction direction, StepSize size) const {
  const Block& block = current_block();
  const TrialState& trial = state_.trial(open_trial("adjust the intensity"));
  if (!current_form().adjustable) cannot("adjust the intensity", "a production");
  const double step = size == StepSize::kCoarse ? block.coarse_step : block.fine_step;
  return stepped_intensity(block, trial.planned.starting_intensity.value_or(0.0),
                           trial.set_intensity, direction == Direction::kRaise ? step : -step);
}

bool Session::can_adjust(Direction direction, StepSize size) const {
  return adjusted(direction, size) != state_.trial(*state_.current_trial()).set_intensity;
}

bool Session::adjust(Direction direction, StepSize size) {
  const double target = adjusted(direction, size);
  const std::int64_t number = *state_.current_trial();
  const TrialState& trial = state_.trial(number);
  if (target == trial.set_intensity) return false;
  commit(IntensityAdjusted{number, trial.attempt, trial.set_intensity, target});
  return true;
}

core::TrialRow Session::answered_row(std::int64_t number,
                                     const std::optional<double>& response) const {
  const TrialState& trial = state_.trial(number);
  const Stage& stage = *parameters_.stages.at(static_cast<std::size_t>(trial.stage));
  const Block& block = std::get<Block>(stage.content);
  const bool is_match =
      procedure_named(block.procedure).form(block).answer == AnswerKind::kMatch;
  core::TrialRow row{.session = parameters_.session,
                     .trial = number,
                     .attempt = trial.attempt,
                     .sequence = state_.last_sequence + 1,
                     .block = stage.name,
                     .procedure = block.procedure,
                     .medium = block.medium,
                     .quantity = block.quantity,
                     .response = response,
                     .measures = trial.measures,
                     .num_presentations = static_cast<std::int64_t>(trial.presentations.size()),
                     .num_steps = trial.num_steps,
                     .first_tick = trial.first_tick,
                     .last_tick = trial.last_tick};
  core::copy_columns(trial.planned, row);
  if (is_match) row.intensity = response;
  return row;
}

/// Returns what is stored for an answer.
std::optional<double> Session::response_for(const std::optional<double>& value) const {
  const TrialState& trial = state_.trial(open_trial("take an answer"));
  const AnswerKind kind = current_form().answer;
  std::optional<double> answer = value;
  if (answer && kind == AnswerKind::kMatch) answer = trial.set_intensity;
  require_answer_of(kind, current_block(), answer, "take an answer");
  return response_of(kind, trial.planned, answer);
}

/// Returns the feedback on a response in this block.
std::optional<bool> Session::feedback(const PlannedTrial& trial,
                                      const std::optional<double>& response) const {
  const Block& block = current_block();
  if (!block.feedback || !response) return std::nullopt;
  const std::optional<double> right =
      procedure_named(block.procedure).feedback_response(block, trial);
  return right ? std::optional(response == *right) : std::nullopt;
}

void Session::require_answer(const std::optional<double>& value) const {
  (void)response_for(value);
}

void Session::answer(const std::optional<double>& value, const core::AnswerMeasures& measures,
                     std::int64_t last_tick) {
  const std::int64_t number = open_trial("take an answer");
  const TrialState& trial = state_.trial(number);
  if (trial.presentations.empty() || !trial.presentations.back().last_tick) {
    cannot("take an answer", "a finished presentation");
  }
  const std::optional<double> response = response_for(value);
  const double response_time_s = measures.response_time_s.value_or(-1.0);
  if (!(response_time_s >= 0.0) || !std::isfinite(response_time_s)) {
    cannot("take an answer", "a response time >= 0");
  }
  core::AnswerMeasures kept = measures;
  if (trial.planned.right_interval && value) kept.chosen_interval = std::lround(*value);
  core::Commit rows;
  rows.trial = answered_row(number, response);
  rows.trial->measures = kept;
  rows.trial->last_tick = last_tick;
  commit(TrialAnswered{.trial = number,
                       .attempt = trial.attempt,
                       .response = response,
                       .measures = kept,
                       .last_tick = last_tick,
                       .feedback_right = feedback(trial.planned, response)},
         std::move(rows));
  if (!state_.current_trial()) draw_trials(state_.stage);
  take_turn_if_due();
}

std::optional<OpenQuestion> Session::open_question() const {
  const Stage* stage = current_stage();
  const Block* block = stage == nullptr ? nullptr : std::get_if<Block>(&stage->content);
  if (block == nullptr || block->questions.empty() || !state_.stage_open) return std::nullopt;
  for (std::int64_t number = std::ssize(state_.trials); number >= 1; --number) {
    const TrialState& trial = state_.trial(number);
    if (!state_.is_under_way(trial.stage)) break;
    if (trial.stage != state_.stage || !trial.is_answered ||
        trial.question_answers.size() == block->questions.size())
      continue;
    for (std::size_t i = 0; i < block->questions.size(); ++i) {
      const QuestionnaireItem& item = block->questions[i];
      if (trial.question_answers.contains(item.name)) continue;
      return OpenQuestion{number, &item, static_cast<int>(i) + 1};
    }
  }
  return std::nullopt;
}

void Session::answer_question(const std::string& question, const std::string& answer) {
  const std::optional<OpenQuestion> open = open_question();
  if (!open || open->item->name != question) cannot("answer " + question, "that question");
  if (const std::string expected = expected_answer(*open->item, answer); !expected.empty()) {
    cannot("answer " + question, expected);
  }
  const TrialState& trial = state_.trial(open->trial);
  core::Commit rows;
  rows.question_answer = core::QuestionAnswerRow{.session = parameters_.session,
                                                 .trial = open->trial,
                                                 .attempt = trial.attempt,
                                                 .sequence = state_.last_sequence + 1,
                                                 .block = current_stage()->name,
                                                 .question = question,
                                                 .answer = answer};
  commit(QuestionAnswered{open->trial, trial.attempt, question, answer}, std::move(rows));
  take_turn_if_due();
}

void Session::discard_attempt(const std::string& reason) {
  const std::int64_t number = open_trial("discard an attempt");
  commit(AttemptDiscarded{number, state_.trial(number).attempt, reason});
}

void Session::put_off_attempt(const std::string& reason) { put_off({.reason = reason}); }

void Session::miss_deadline(const std::string& given) {
  const std::optional<double>& deadline_s = current_block().answer_deadline_s;
  if (!deadline_s) cannot("miss a deadline", "a block with `answer_deadline_s`");
  put_off(
      {.reason = "no answer within the deadline of " + plain_number(*deadline_s) + " s" + given,
       .missed_deadline = true});
}

void Session::put_off(AttemptDiscarded discarded) {
  const std::int64_t number = open_trial("put a trial off");
  const TrialState& trial = state_.trial(number);
  discarded.trial = number;
  discarded.attempt = trial.attempt;
  const std::vector<std::int64_t> later = state_.trials_after_current();
  if (!later.empty() && !procedure_named(current_block().procedure).adapts()) {
    core::RandomStream stream(parameters_.seed, "put off", {number, trial.attempt});
    // If the chosen trial was put off itself, the trial comes after the same trial as that one.
    const std::int64_t chosen = later[stream.below(later.size())];
    const std::int64_t after = state_.trial(chosen).again_after;
    discarded.again_after = after == 0 ? chosen : after;
  }
  discarded.passes_turn = state_.num_together > 1;
  commit(std::move(discarded));
  take_turn_if_due();
}

void Session::require_undo() const {
  const std::optional<std::int64_t> last = state_.last_answered_trial();
  if (!last || !state_.is_under_way(state_.trial(*last).stage)) {
    cannot("undo", "an answer in this block (correct an earlier one instead)");
  }
}

void Session::undo(const std::string& reason) {
  require_undo();
  run_again(*state_.last_answered_trial(), reason);
}

bool Session::can_run_again(std::int64_t number) const {
  if (number < 1 || number > std::ssize(state_.trials)) return false;
  const TrialState& trial = state_.trial(number);
  if (!trial.is_answered || !state_.is_under_way(trial.stage)) return false;
  if (state_.last_answered_trial() == number) return true;
  const Stage& stage = *parameters_.stages.at(static_cast<std::size_t>(trial.stage));
  const Block& block = std::get<Block>(stage.content);
  return !block.practice && !procedure_named(block.procedure).adapts();
}

void Session::require_run_again(std::int64_t number) const {
  if (!can_run_again(number)) {
    cannot("run a trial again",
           "an answer of this block that decided nothing (correct it instead)");
  }
  // The turn would pass to another block, and nobody would ask the question any more.
  const std::optional<OpenQuestion> open = open_question();
  if (open && state_.trial(open->trial).stage != state_.trial(number).stage) {
    cannot("run a trial of another block again", "an answer to every question of the last one");
  }
}

void Session::run_again(std::int64_t number, const std::string& reason) {
  require_run_again(number);
  if (const auto open = state_.current_trial(); open && state_.trial(*open).under_way) {
    discard_attempt("undo of the answer before");
  }
  const TrialState& trial = state_.trial(number);
  commit(AnswerUndone{number, trial.attempt, trial.answer_sequence, reason});
}

void Session::correct(std::int64_t number, const std::optional<double>& value,
                      const std::string& reason) {
  if (number < 1 || number > static_cast<std::int64_t>(state_.trials.size()) ||
      !state_.trial(number).is_answered) {
    cannot("correct an answer", "an answered trial");
  }
  const Stage& stage =
      *parameters_.stages.at(static_cast<std::size_t>(state_.trial(number).stage));
  const Block& block = std::get<Block>(stage.content);
  const AnswerKind kind = procedure_named(block.procedure).form(block).answer;
  require_answer_of(kind, block, value, "correct an answer");
  const TrialState& trial = state_.trial(number);
  const std::optional<double> response = response_of(kind, trial.planned, value);
  core::Commit rows;
  rows.trial = answered_row(number, response);
  AnswerCorrected corrected{number, trial.attempt, trial.answer_sequence, response, reason};
  if (trial.planned.right_interval) {
    if (value) corrected.chosen_interval = std::lround(*value);
    rows.trial->measures.chosen_interval = corrected.chosen_interval;
  }
  commit(std::move(corrected), std::move(rows));
  // The rule of its block may have an end no more.
  if (!state_.ended && state_.is_under_way(state_.trial(number).stage)) draw_missing_trials();
}

void Session::restart_block(const std::string& reason) {
  (void)current_block();
  if (const auto open = state_.current_trial(); open && state_.trial(*open).under_way) {
    discard_attempt(reason);
  }
  // The latest answer is undone first, as if they were undone one by one.
  for (auto number = static_cast<std::int64_t>(state_.trials.size()); number >= 1; --number) {
    const TrialState& trial = state_.trial(number);
    if (state_.is_under_way(trial.stage) && trial.is_answered) {
      commit(AnswerUndone{number, trial.attempt, trial.answer_sequence, reason});
    }
  }
  if (state_.num_together > 1) take_turn();
}

void Session::exclude(std::int64_t trial, const std::string& reason) {
  if (trial < 1 || trial > static_cast<std::int64_t>(state_.trials.size())) {
    cannot("exclude trial " + std::to_string(trial), "a trial of this session");
  }
  commit(TrialExcluded{trial, reason});
}

void Session::include(std::int64_t trial, const std::string& reason) {
  if (trial < 1 || trial > static_cast<std::int64_t>(state_.trials.size()) ||
      !state_.trial(trial).excluded) {
    cannot("include trial " + std::to_string(trial), "an excluded trial");
  }
  commit(TrialIncluded{trial, reason});
}

void Session::note(const std::string& text) { commit(NoteAdded{text}); }

void Session::pause(const std::string& reason) { commit(Paused{reason}); }

void Session::explain_pause(const std::string& reason) {
  if (state_.unexplained_pause == 0) cannot("explain a pause", "one without a reason");
  commit(PauseExplained{state_.unexplained_pause, reason});
}

void Session::go_on() {
  if (!state_.paused) cannot("go on", "a pause");
  commit(Continued{});
}

void Session::fault(const std::string& words) { commit(FaultRaised{words}); }

void Session::resume(const std::string& choice, std::int64_t lost_first_tick,
                     std::int64_t lost_last_tick) {
  if (!state_.started || state_.ended) cannot("resume", "a session that was interrupted");
  commit(SessionResumed{choice, lost_first_tick, lost_last_tick});
  if (const auto open = state_.current_trial(); open && state_.trial(*open).under_way) {
    discard_attempt("interrupted");
  }
  if (choice == "restart" && state_.stage_open && current_stage() != nullptr &&
      std::holds_alternative<Block>(current_stage()->content)) {
    restart_block("restarted after an interruption");
  }
  if (choice == "end") return end_early("ended after an interruption");
  // The session may have been interrupted between entering the block, or its last answer, and
  // the draw that follows.
  draw_missing_trials();
}

void Session::loop_started(const LoopStarted& given) { commit(given); }

void Session::fitting_kept(const FittingKept& kept) { commit(kept); }

void Session::exposed(const core::Exposure& exposure) { commit(ExposureTold{exposure}); }

void Session::guard_noticed(const GuardNoticed& noticed) { commit(noticed); }

void Session::stream_opened(const StreamOpened& stream) { commit(stream); }

void Session::stream_closed(const StreamClosed& stream) { commit(stream); }

void Session::force_missing(const ForceMissing& missing) { commit(missing); }

void Session::stream_failed(const StreamFailed& stream) { commit(stream); }

void Session::sound_started(const SoundStarted& sound) { commit(sound); }

void Session::cues_played(const CuesPlayed& played) { commit(played); }

void Session::sound_measured(const SoundMeasured& sound) { commit(sound); }

void Session::sound_missing(const SoundMissing& sound) { commit(sound); }

void Session::markers_opened(const MarkersOpened& port) { commit(port); }

void Session::markers_sent(const MarkersSent& sent) { commit(sent); }

void Session::markers_closed(const MarkersClosed& port) { commit(port); }

void Session::markers_failed(const MarkersFailed& port) { commit(port); }

void Session::require_exposure_left() const {
  if (const std::string over = exposure_words(parameters_.limits, state_.exposure);
      !over.empty()) {
    throw core::Error("session " + std::to_string(parameters_.session) +
                      ": expected less force than the study allows for a session, found " +
                      over + "; let the person rest, and end the session");
  }
}

void Session::arming_changed(const std::string& arming, const std::string& cause) {
  commit(ArmingChanged{arming, cause});
}

void Session::loop_measured(const LoopMeasured& timing) { commit(timing); }

void Session::unblind(const std::string& reason) { commit(Unblinded{reason}); }

void Session::complete() {
  if (state_.ended || current_stage() != nullptr)
    cannot("complete the session", "a last stage");
  commit(SessionCompleted{});
}

void Session::end_early(const std::string& reason) {
  if (state_.ended) cannot("end", "a session that goes on");
  commit(SessionEndedEarly{reason});
}

void Session::commit(EventData data) { commit(std::move(data), core::Commit{}); }

void Session::commit(EventData data, core::Commit rows) {
  const Event event{.sequence = state_.last_sequence + 1,
                    .time_ns = clock_.now_ns(),
                    .data = std::move(data)};
  rows.event = row_from_event(parameters_.session, event);
  // What cannot be read back must not be stored, or the session could never be opened again.
  (void)event_from_row(rows.event);
  log_.append(rows);
  apply(state_, event);
}

}  // namespace jnd::experiments
