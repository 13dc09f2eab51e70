#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/storage/study_store.h"
#include "experiments/order/block_turns.h"
#include "experiments/order/counterbalance.h"
#include "experiments/procedures/procedure.h"
#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Where a session writes its events. `append` returns once the commit is as safe as promised.
/// If it throws `Error`, the act did not happen.
class EventLog {
 public:
  virtual ~EventLog() = default;
  virtual void append(const core::Commit& commit) = 0;
};

enum class Direction { kRaise, kLower };
enum class StepSize { kCoarse, kFine };

/// Returns the seed of one participant's session. It depends on the study's name, because P01
/// of one study is another person than P01 of the next.
[[nodiscard]] std::uint64_t session_seed(std::uint64_t seed, const std::string& study,
                                         const std::string& participant);

/// A question after a trial that has not been answered yet.
struct OpenQuestion {
  std::int64_t trial = 0;
  const QuestionnaireItem* item = nullptr;  ///< A question of the session's block, never null.
  int index = 1;                            ///< Place among the questions of the block, from 1.
};

/// One visit of one participant. Every act commits its event first and then changes the state.
/// An act that is not possible now throws `Error` and changes nothing. Not real time.
class Session {
 public:
  struct Parameters {
    std::int64_t session = 0;
    std::uint64_t seed = 0;
    /// The participant's own stages, with counterbalances resolved.
    std::vector<const Stage*> stages;
    Cell cell{};  ///< The participant's cell, for the squares of blocks.
    /// The participant's fields, which are stored with the start.
    FieldValues fields{};
    SessionLimits limits{};  ///< Limits of exposure; no trial begins beyond them.
  };

  /// Replays `history`, which is empty for a new session. The references must outlive the
  /// session.
  Session(Parameters parameters, const std::vector<core::EventRow>& history, EventLog& log,
          const core::Clock& clock);

  [[nodiscard]] const SessionState& state() const noexcept { return state_; }
  [[nodiscard]] std::int64_t id() const noexcept { return parameters_.session; }
  [[nodiscard]] std::uint64_t seed() const noexcept { return parameters_.seed; }
  [[nodiscard]] const SessionLimits& limits() const noexcept { return parameters_.limits; }
  [[nodiscard]] const std::vector<const Stage*>& stages() const noexcept {
    return parameters_.stages;
  }
  /// Returns the stage under way or next, or null after the last one. For interleaved blocks it
  /// is the one whose turn it is.
  [[nodiscard]] const Stage* current_stage() const noexcept;
  /// Returns the indices of the stages that run together with the current one, including
  /// itself: the blocks of a group, or itself alone. Empty after the last stage.
  [[nodiscard]] std::vector<std::int64_t> current_stages() const;
  /// Returns the block of the current stage. Throws `Error` if it is no block.
  [[nodiscard]] const Block& current_block() const;
  /// Returns the same block as its trials are drawn and felt: with the row of its square and
  /// with its levels for this participant; see `block_of`. Throws like `current_block`.
  [[nodiscard]] Block current_block_as_drawn() const;
  /// Returns the form of the current trial, or of the block if no trial waits.
  [[nodiscard]] TrialForm current_form() const;

  /// `language` is that of the texts that the participant gets; "" for a simulated one.
  void start(const std::string& language = "");
  /// Enters a stage. Entering a block draws its order. Interleaved blocks are entered all at
  /// once, and the block of the first trial is drawn.
  void enter_stage();
  void answer_item(const std::string& item, const std::string& answer);
  void explored(const std::string& medium, double intensity, std::int64_t first_tick,
                std::int64_t last_tick);
  void finish_stage();

  void start_trial(std::int64_t tick);
  /// Throws what `begin_presentation` would throw in the current trial, under way or not: for
  /// an interval that it lacks, or to which the participant may not return any more.
  void require_interval(const std::string& interval) const;
  /// `interval` is "test", "reference" or "free_space", or "first" or "second" in a trial whose
  /// order is drawn, which is stored as what it holds. The presentation before must have ended.
  void begin_presentation(const std::string& interval, std::int64_t tick);
  void end_presentation(std::int64_t last_tick, const PresentationSummary& summary);
  /// Makes one step of an adjustment, also beyond the range of starting values, but never below
  /// 0. Returns false, and does nothing, if the intensity cannot go further.
  bool adjust(Direction direction, StepSize size);
  [[nodiscard]] bool can_adjust(Direction direction, StepSize size) const;
  /// Throws what `answer` would throw for this value, so that a presentation need not be ended
  /// in vain.
  void require_answer(const std::optional<double>& value) const;
  /// `value` is the answer as given: percent, 1 or 0, or the chosen interval. In an adjustment
  /// the set intensity is the answer, and `value` is ignored. None means "cannot tell", if the
  /// block allows that.
  void answer(const std::optional<double>& value, const core::AnswerMeasures& measures,
              std::int64_t last_tick);
  /// Returns the question that waits for its answer: the first question of the block without an
  /// answer in an answered trial. While there is one, no trial begins and the block does not
  /// end. The next turn of interleaved blocks is drawn after the last question.
  [[nodiscard]] std::optional<OpenQuestion> open_question() const;
  /// Answers that question. Throws `Error` if another one waits, or none, or if `answer` is
  /// invalid for its kind. `kNoAnswer` leaves out a question that is not required.
  void answer_question(const std::string& question, const std::string& answer);
  /// Gives up the attempt under way. Its trial is the next one again.
  void discard_attempt(const std::string& reason);
  /// Gives up the attempt because of the apparatus or the machine. The trial is repeated at a
  /// later place of the block, drawn uniformly from all that are left, so that nobody feels a
  /// stimulus right after half of it. It is repeated at once if answers determine what comes
  /// next, or if no trial is left. Among interleaved blocks it is repeated in a later turn of
  /// its block, and the present turn is drawn again.
  void put_off_attempt(const std::string& reason);
  /// Does the same if no answer came before the block's `answer_deadline_s`. The attempt counts
  /// as missed. `given` is an answer that came too late, for the reason; "" if none came.
  void miss_deadline(const std::string& given = "");

  /// Throws what `undo` would throw if there is nothing to take back.
  void require_undo() const;
  /// Takes back the last answer of the current block, or of all interleaved blocks. Its trial
  /// is run again.
  void undo(const std::string& reason);
  /// Whether `run_again` can do the same for this answer of the block under way. Nothing may
  /// have been drawn because of the answer since. So for procedures whose answers determine
  /// what comes next, and for practice, it is only the last answer.
  [[nodiscard]] bool can_run_again(std::int64_t number) const;
  /// Throws what `run_again` would throw.
  void require_run_again(std::int64_t number) const;
  void run_again(std::int64_t number, const std::string& reason);
  /// Corrects an earlier answer without touching its presentations. `value` is as in `answer`;
  /// in an adjustment it is the intensity.
  void correct(std::int64_t number, const std::optional<double>& value,
               const std::string& reason);
  /// Takes back all answers of the current block; the order stays. Interleaved blocks restart
  /// together.
  void restart_block(const std::string& reason);
  void exclude(std::int64_t trial, const std::string& reason);
  void include(std::int64_t trial, const std::string& reason);

  void note(const std::string& text);
  /// `reason` is "" if it will be given later; see `explain_pause`.
  void pause(const std::string& reason);
  /// Gives the reason of the last pause, which was stored without one and stays as it is.
  void explain_pause(const std::string& reason);
  void go_on();
  void fault(const std::string& words);
  void resume(const std::string& choice, std::int64_t lost_first_tick,
              std::int64_t lost_last_tick);
  void loop_started(const LoopStarted& given);
  void fitting_kept(const FittingKept& kept);
  void arming_changed(const std::string& arming, const std::string& cause);
  void exposed(const core::Exposure& exposure);
  void guard_noticed(const GuardNoticed& noticed);
  void force_missing(const ForceMissing& missing);
  void stream_opened(const StreamOpened& stream);
  void stream_closed(const StreamClosed& stream);
  void stream_failed(const StreamFailed& stream);
  void sound_started(const SoundStarted& sound);
  void cues_played(const CuesPlayed& played);
  void sound_measured(const SoundMeasured& sound);
  void sound_missing(const SoundMissing& sound);
  void markers_opened(const MarkersOpened& port);
  void markers_sent(const MarkersSent& sent);
  void markers_closed(const MarkersClosed& port);
  void markers_failed(const MarkersFailed& port);
  /// Throws `Error` if the hand has reached the exposure that the study allows.
  void require_exposure_left() const;
  void loop_measured(const LoopMeasured& timing);
  void unblind(const std::string& reason);
  /// Completes the session, after the last stage.
  void complete();
  /// Ends the session before the last stage. The data stay, but nothing more can be added.
  void end_early(const std::string& reason);

 private:
  void commit(EventData data);
  void commit(EventData data, core::Commit rows);
  void draw_trials(std::int64_t stage);
  void draw_missing_trials();
  void take_turn();
  void take_turn_if_due();
  [[nodiscard]] BlockProgress progress_of(std::int64_t stage) const;
  [[nodiscard]] Block block_as_drawn(std::int64_t stage) const;
  void put_off(AttemptDiscarded discarded);
  void require_return(const TrialState& trial, const std::string& interval) const;
  [[nodiscard]] std::int64_t open_trial(const char* act) const;
  [[nodiscard]] std::optional<bool> feedback(const PlannedTrial& trial,
                                             const std::optional<double>& response) const;
  [[nodiscard]] double intensity_of(const TrialState& trial, const std::string& interval) const;
  [[nodiscard]] std::optional<double> response_for(const std::optional<double>& value) const;
  [[nodiscard]] double adjusted(Direction direction, StepSize size) const;
  [[nodiscard]] core::TrialRow answered_row(std::int64_t number,
                                            const std::optional<double>& response) const;

  Parameters parameters_;
  EventLog& log_;
  const core::Clock& clock_;
  SessionState state_;
};

}  // namespace jnd::experiments
