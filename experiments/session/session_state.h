#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/session/event.h"

namespace jnd::experiments {

struct PresentationState {
  std::string interval;
  double intensity = 0.0;
  std::int64_t first_tick = 0;
  std::int64_t started_time_ns = 0;
  std::optional<std::int64_t> last_tick;                ///< None while it is being felt.
  std::optional<double> delivered_damping_n_s_per_m{};  ///< As in `core::PresentationMeasures`.
  std::int64_t place = 0;        ///< Which of three intervals it is, from 1; 0 for none.
  std::int64_t num_strokes = 0;  ///< Set when the presentation has ended.
};

struct TrialState {
  std::int64_t stage = 0;
  PlannedTrial planned;
  std::int64_t drawn_sequence = 0;  ///< Sequence number of the event that drew the trial.
  /// Drawn because of an answer that was taken back; never run.
  bool is_void = false;
  std::int64_t attempt = 0;  ///< 0 before the first start.
  bool under_way = false;    ///< Started, and neither answered nor discarded.
  /// A trial that was put off runs after this trial; 0 for a trial in its own place.
  std::int64_t again_after = 0;
  std::int64_t first_tick = 0, last_tick = 0;
  std::vector<PresentationState> presentations;  ///< Presentations of this attempt.
  /// For adjustments: the intensity that the steps have reached.
  double set_intensity = 0.0;
  std::int64_t num_steps = 0;
  bool is_answered = false;          ///< Also by "cannot tell".
  std::optional<double> response;    ///< Of an answered trial; none: "cannot tell".
  std::int64_t answer_sequence = 0;  ///< Of the event that holds the answer.
  std::int64_t given_sequence = 0;   ///< Of the event by which it was given; corrections aside.
  core::AnswerMeasures measures;     ///< Of it.
  /// To the questions that follow it, by their names; gone with it where it is taken back.
  std::map<std::string, std::string> question_answers;
  bool excluded = false;

  void forget_answer() {
    is_answered = false;
    response.reset();
    question_answers.clear();
  }
};

/// The state of a session: the fold of its events. Only `apply` changes it.
struct SessionState {
  bool started = false;
  std::string language;  ///< The language that `SessionStarted` names.
  bool ended = false;
  bool completed = false;
  bool paused = false;
  std::int64_t unexplained_pause = 0;  ///< Event of a pause without a reason; 0 for none.
  /// The stage under way, or the next one. For interleaved blocks it is the one whose turn it
  /// is.
  std::int64_t stage = 0;
  bool stage_open = false;          ///< The stage was entered and is not finished.
  std::int64_t first_together = 0;  ///< First of the stages that were entered with this one.
  /// Number of these stages; more than 1 for interleaved blocks.
  std::int64_t num_together = 1;
  /// For interleaved blocks: the next turn has not been drawn yet.
  bool turn_is_due = false;
  std::int64_t num_put_off = 0;    ///< How often a trial of these stages was put off so far.
  std::int64_t num_explored = 0;   ///< Media explored in this stage.
  std::vector<TrialState> trials;  ///< Trial number n has the index n - 1.
  /// Last answer to (stage, item).
  std::map<std::pair<std::int64_t, std::string>, std::string> answers;
  /// Feedback on the last answer, until the next trial begins.
  std::optional<bool> feedback_right;
  /// The last answer missed its deadline; until the next trial begins.
  bool missed_deadline = false;
  std::vector<std::string> notes;
  core::Exposure exposure;  ///< As far as presentations tell of it.
  /// Presentations of stimuli that ask for a force and in which none acted; why, of the last.
  std::int64_t num_without_force = 0;
  std::string missing_force_cause;
  std::int64_t last_sequence = 0;
  std::int64_t last_time_ns = 0;
  std::int64_t last_tick = -1;  ///< The last tick to which any event refers.
  /// Duration of earlier visits, and begin and last event of the present one. Acts on a session
  /// long after it belong to no visit.
  std::int64_t earlier_visits_ns = 0;
  std::int64_t visit_began_ns = 0, visit_last_ns = 0;

  /// Returns the duration of all visits up to the last event, without the time between them.
  [[nodiscard]] std::int64_t visited_ns() const {
    return earlier_visits_ns +
           (visit_last_ns > visit_began_ns ? visit_last_ns - visit_began_ns : 0);
  }

  /// Whether this is one of the stages that were entered and not finished.
  [[nodiscard]] bool is_under_way(std::int64_t of_stage) const {
    return stage_open && of_stage >= first_together && of_stage < first_together + num_together;
  }
  void forget_told() {
    feedback_right.reset();
    missed_deadline = false;
  }
  [[nodiscard]] const TrialState& trial(std::int64_t number) const {
    return trials.at(number - 1);
  }
  /// Returns the trial to run in this stage: the first one that has no answer and is not void,
  /// with trials that were put off in their later place. None if all trials have an answer.
  [[nodiscard]] std::optional<std::int64_t> current_trial() const;
  /// Returns the trials of the stage that wait behind the current one, in order.
  [[nodiscard]] std::vector<std::int64_t> trials_after_current() const;
  /// Whether a trial of this stage waits, whosever turn it is.
  [[nodiscard]] bool has_waiting(std::int64_t of_stage) const;
  /// The trial that was answered last, in any stage; corrections change nothing of that.
  [[nodiscard]] std::optional<std::int64_t> last_answered_trial() const;
  /// Returns the last answered trial of a stage.
  [[nodiscard]] std::optional<std::int64_t> last_answered_in(std::int64_t of_stage) const;
  /// Returns the trials of a stage with their answers, in the order in which they were drawn.
  [[nodiscard]] std::vector<AnsweredTrial> answered_in(std::int64_t of_stage) const;
};

/// Changes the state by one event. It draws nothing and asks nothing, so a replay gives the
/// same state. Throws `Error` if the event cannot follow, which means that the log is damaged.
void apply(SessionState& state, const Event& event);

}  // namespace jnd::experiments
