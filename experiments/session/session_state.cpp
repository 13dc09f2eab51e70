#include "experiments/session/session_state.h"

#include <algorithm>

#include "core/error.h"

namespace jnd::experiments {
namespace {

struct Fold {
  SessionState& state;
  const Event& event;

  void operator()(const SessionStarted& e) const {
    state.started = true;
    state.visit_began_ns = event.time_ns;
    state.language = e.language;
  }
  void operator()(const StageEntered& e) const {
    state.stage = e.stage;
    state.stage_open = true;
    state.num_explored = 0;
    state.first_together = e.stage;
    state.num_together = e.num_together;
    state.turn_is_due = e.num_together > 1;
    state.num_put_off = 0;
  }
  void operator()(const ItemAnswered& e) const { state.answers[{e.stage, e.item}] = e.answer; }
  void operator()(const MediumExplored& e) const {
    ++state.num_explored;
    saw_tick(e.last_tick);
  }
  void operator()(const StageFinished& e) const {
    state.stage = e.stage + 1;
    state.stage_open = false;
    state.first_together = state.stage;
    state.num_together = 1;
    state.turn_is_due = false;
    state.forget_told();
  }
  void operator()(const TurnTaken& e) const {
    if (!state.is_under_way(e.stage)) damaged("a turn of a block under way");
    state.stage = e.stage;
    state.turn_is_due = false;
  }
  void operator()(const TrialsDrawn& e) const {
    if (e.first_trial != static_cast<std::int64_t>(state.trials.size()) + 1) {
      damaged("trials drawn in sequence");
    }
    for (const PlannedTrial& planned : e.trials) {
      state.trials.push_back(
          {.stage = e.stage, .planned = planned, .drawn_sequence = event.sequence});
    }
  }
  void operator()(const TrialStarted& e) const {
    TrialState& trial = of(e.trial);
    trial.attempt = e.attempt;
    trial.under_way = true;
    trial.first_tick = e.first_tick;
    trial.last_tick = e.first_tick;
    trial.presentations.clear();
    trial.set_intensity = trial.planned.starting_intensity.value_or(0.0);
    trial.num_steps = 0;
    trial.forget_answer();
    state.forget_told();
    saw_tick(e.first_tick - 1);  // The first tick is still to come.
  }
  void operator()(const PresentationStarted& e) const {
    of(e.trial).presentations.push_back({.interval = e.interval,
                                         .intensity = e.intensity,
                                         .first_tick = e.first_tick,
                                         .started_time_ns = event.time_ns,
                                         .place = e.place});
    saw_tick(e.first_tick - 1);
  }
  void operator()(const PresentationEnded& e) const {
    TrialState& trial = of(e.trial);
    if (trial.presentations.empty()) damaged("a presentation to end");
    trial.presentations.back().last_tick = e.last_tick;
    trial.presentations.back().delivered_damping_n_s_per_m =
        e.summary.measures.delivered_damping_n_s_per_m;
    trial.presentations.back().num_strokes = e.summary.measures.num_strokes;
    trial.last_tick = e.last_tick;
    if (e.summary.exposure) state.exposure += *e.summary.exposure;
    saw_tick(e.last_tick);
  }
  void operator()(const IntensityAdjusted& e) const {
    TrialState& trial = of(e.trial);
    trial.set_intensity = e.to_intensity;
    ++trial.num_steps;
  }
  void operator()(const TrialAnswered& e) const {
    TrialState& trial = of(e.trial);
    trial.under_way = false;
    trial.is_answered = true;
    trial.response = e.response;
    trial.measures = e.measures;
    trial.answer_sequence = event.sequence;
    trial.given_sequence = event.sequence;
    trial.last_tick = e.last_tick;
    state.feedback_right = e.feedback_right;
    state.turn_is_due = state.num_together > 1;
    saw_tick(e.last_tick);
  }
  void operator()(const QuestionAnswered& e) const {
    TrialState& trial = of(e.trial);
    if (!trial.is_answered || trial.attempt != e.attempt)
      damaged("a question of an answered trial");
    trial.question_answers[e.question] = e.answer;
  }
  void operator()(const AnswerUndone& e) const {
    state.forget_told();
    TrialState& undone = of(e.trial);
    undone.forget_answer();
    undone.under_way = false;
    for (TrialState& trial : state.trials) {
      if (trial.stage == undone.stage && trial.drawn_sequence > undone.drawn_sequence &&
          !trial.is_answered)
        trial.is_void = true;
    }
    // Its trial is the next one, whosever turn it was.
    if (state.num_together == 1 || !state.is_under_way(undone.stage)) return;
    state.stage = undone.stage;
    state.turn_is_due = false;
  }
  void operator()(const AnswerCorrected& e) const {
    TrialState& trial = of(e.trial);
    trial.response = e.response;
    // With "cannot tell" no interval is chosen.
    if (e.chosen_interval || !e.response) trial.measures.chosen_interval = e.chosen_interval;
    trial.answer_sequence = event.sequence;
  }
  void operator()(const AttemptDiscarded& e) const {
    TrialState& trial = of(e.trial);
    trial.under_way = false;
    trial.forget_answer();
    if (e.missed_deadline) state.missed_deadline = true;
    if (e.passes_turn) {
      state.turn_is_due = true;
      ++state.num_put_off;
    }
    if (e.again_after == 0) return;
    (void)of(e.again_after);
    trial.again_after = e.again_after;
  }
  void operator()(const TrialExcluded& e) const { of(e.trial).excluded = true; }
  void operator()(const TrialIncluded& e) const { of(e.trial).excluded = false; }
  void operator()(const NoteAdded& e) const { state.notes.push_back(e.text); }
  void operator()(const Paused& e) const {
    state.paused = true;
    state.unexplained_pause = e.reason.empty() ? event.sequence : 0;
  }
  void operator()(const PauseExplained& e) const {
    if (e.pause_sequence < 1 || e.pause_sequence != state.unexplained_pause) {
      damaged("a pause without a reason");
    }
    state.unexplained_pause = 0;
  }
  void operator()(const Continued&) const { state.paused = false; }
  void operator()(const FaultRaised&) const { state.paused = true; }
  void operator()(const SessionResumed& e) const {
    state.paused = false;
    state.earlier_visits_ns = state.visited_ns();
    state.visit_began_ns = event.time_ns;
    state.unexplained_pause = 0;  // The person who could have given the reason is gone.
    saw_tick(e.lost_last_tick);
  }
  void operator()(const LoopStarted&) const {}
  void operator()(const LoopMeasured&) const {}
  void operator()(const Unblinded&) const {}
  void operator()(const ArmingChanged&) const {}
  void operator()(const GuardNoticed&) const {}
  void operator()(const StreamOpened&) const {}
  void operator()(const StreamClosed&) const {}
  void operator()(const StreamFailed&) const {}
  void operator()(const SoundStarted&) const {}
  void operator()(const CuesPlayed&) const {}
  void operator()(const SoundMeasured&) const {}
  void operator()(const SoundMissing&) const {}
  void operator()(const MarkersOpened&) const {}
  void operator()(const MarkersSent&) const {}
  void operator()(const MarkersClosed&) const {}
  void operator()(const MarkersFailed&) const {}
  void operator()(const FittingKept&) const {}
  void operator()(const ForceMissing& e) const {
    ++state.num_without_force;
    state.missing_force_cause = e.cause;
  }
  void operator()(const ExposureTold& e) const { state.exposure += e.exposure; }
  void operator()(const SessionCompleted&) const {
    state.ended = true;
    state.completed = true;
  }
  void operator()(const SessionEndedEarly&) const { state.ended = true; }

 private:
  [[nodiscard]] TrialState& of(std::int64_t trial) const {
    if (trial < 1 || trial > static_cast<std::int64_t>(state.trials.size())) {
      damaged("a trial that was drawn");
    }
    return state.trials[trial - 1];
  }
  void saw_tick(std::int64_t tick) const { state.last_tick = std::max(state.last_tick, tick); }
  [[noreturn]] void damaged(const char* expected) const {
    throw core::Error("event " + std::to_string(event.sequence) + ": expected " + expected +
                      ", found " + kind_of(event.data) + "; the log is damaged");
  }
};

bool waits(const SessionState& state, std::int64_t number) {
  const TrialState& trial = state.trial(number);
  return trial.stage == state.stage && !trial.is_answered && !trial.is_void;
}

/// A trial that was put off comes after the trial it was put behind, and before the one that
/// follows it by number.
bool comes_before(const SessionState& state, std::int64_t left, std::int64_t right) {
  const auto place = [&state](std::int64_t number) {
    const std::int64_t after = state.trial(number).again_after;
    return std::pair(after == 0 ? number : after, after == 0 ? std::int64_t{0} : number);
  };
  return place(left) < place(right);
}

/// Returns the last answered trial of a stage, or of all stages.
std::optional<std::int64_t> last_answered(const std::vector<TrialState>& trials,
                                          std::optional<std::int64_t> of_stage) {
  std::optional<std::int64_t> last;
  std::int64_t latest_sequence = 0;
  for (std::size_t index = 0; index < trials.size(); ++index) {
    const TrialState& trial = trials[index];
    if (of_stage && trial.stage != *of_stage) continue;
    if (trial.is_answered && trial.given_sequence > latest_sequence) {
      latest_sequence = trial.given_sequence;
      last = static_cast<std::int64_t>(index) + 1;
    }
  }
  return last;
}

}  // namespace

std::optional<std::int64_t> SessionState::current_trial() const {
  std::optional<std::int64_t> first;
  for (std::size_t index = 0; index < trials.size(); ++index) {
    const auto number = static_cast<std::int64_t>(index) + 1;
    if (waits(*this, number) && (!first || comes_before(*this, number, *first))) first = number;
  }
  return first;
}

std::vector<std::int64_t> SessionState::trials_after_current() const {
  std::vector<std::int64_t> waiting;
  for (std::int64_t number = 1; number <= std::ssize(trials); ++number) {
    if (waits(*this, number)) waiting.push_back(number);
  }
  std::ranges::sort(waiting, [this](std::int64_t left, std::int64_t right) {
    return comes_before(*this, left, right);
  });
  if (!waiting.empty()) waiting.erase(waiting.begin());
  return waiting;
}

bool SessionState::has_waiting(std::int64_t of_stage) const {
  return std::ranges::any_of(trials, [&](const TrialState& trial) {
    return trial.stage == of_stage && !trial.is_answered && !trial.is_void;
  });
}

std::optional<std::int64_t> SessionState::last_answered_trial() const {
  return last_answered(trials, std::nullopt);
}

std::optional<std::int64_t> SessionState::last_answered_in(std::int64_t of_stage) const {
  return last_answered(trials, of_stage);
}

std::vector<AnsweredTrial> SessionState::answered_in(std::int64_t of_stage) const {
  std::vector<AnsweredTrial> answered;
  for (const TrialState& trial : trials) {
    if (trial.stage == of_stage && trial.is_answered) {
      answered.push_back({.planned = trial.planned, .response = trial.response});
    }
  }
  return answered;
}

void apply(SessionState& state, const Event& event) {
  if (event.sequence != state.last_sequence + 1) {
    throw core::Error("event " + std::to_string(event.sequence) + ": expected event " +
                      std::to_string(state.last_sequence + 1) + "; the log is damaged");
  }
  std::visit(Fold{state, event}, event.data);
  state.last_sequence = event.sequence;
  state.last_time_ns = event.time_ns;
  const bool is_after_end =
      state.ended && (std::holds_alternative<AnswerCorrected>(event.data) ||
                      std::holds_alternative<NoteAdded>(event.data));
  const bool is_afterwards = is_after_end ||
                             std::holds_alternative<TrialExcluded>(event.data) ||
                             std::holds_alternative<TrialIncluded>(event.data) ||
                             std::holds_alternative<Unblinded>(event.data);
  if (!is_afterwards) state.visit_last_ns = event.time_ns;
}

}  // namespace jnd::experiments
