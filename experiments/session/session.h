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

/// Where a session puts its events. `append` returns once the commit is as safe as promised and
/// throws `Error` if it is not; then the act did not happen.
class EventLog {
 public:
  virtual ~EventLog() = default;
  virtual void append(const core::Commit& commit) = 0;
};

enum class Direction { kRaise, kLower };
enum class StepSize { kCoarse, kFine };

/// The seed of one participant's session. The study's name is part of it: P01 of one study is
/// another person than P01 of the next.
[[nodiscard]] std::uint64_t session_seed(std::uint64_t seed, const std::string& study,
                                         const std::string& participant);

/// A question after a trial that nobody has answered yet.
struct OpenQuestion {
  std::int64_t trial = 0;
  const QuestionnaireItem* item = nullptr;  ///< Of the session's block, never null.
  int index = 1;                            ///< Place among the questions of the block, from 1.
};

/// One visit of one participant. Every act commits its event first and moves the state on
/// after. An act that is not possible now throws `Error` and leaves everything as it was. Not
/// real time.
class Session {
 public:
  struct Parameters {
    std::int64_t session = 0;
    std::uint64_t seed = 0;
    std::vector<const Stage*> stages;  ///< The participant's own, counterbalance resolved.
    Cell cell{};                       ///< The participant's, for the squares of blocks.
    FieldValues fields{};              ///< What the participant brought; kept with the start.
    SessionLimits limits{};            ///< Of exposure: no trial begins beyond them.
  };

  /// Replays `history`; empty for a new session. The references must outlive the session.
  Session(Parameters parameters, const std::vector<core::EventRow>& history, EventLog& log,
          const core::Clock& clock);

  [[nodiscard]] const SessionState& state() const noexcept { return state_; }
  [[nodiscard]] std::int64_t id() const noexcept { return parameters_.session; }
  [[nodiscard]] std::uint64_t seed() const noexcept { return parameters_.seed; }
  [[nodiscard]] const SessionLimits& limits() const noexcept { return parameters_.limits; }
  [[nodiscard]] const std::vector<const Stage*>& stages() const noexcept {
    return parameters_.stages;
  }
  /// The stage under way or next; null after the last one. Of interleaved blocks the one whose
  /// turn it is.
  [[nodiscard]] const Stage* current_stage() const noexcept;
  /// Places of the stages that are run together with the current one, itself among them: the
  /// blocks of a group, or itself alone. Empty after the last stage.
  [[nodiscard]] std::vector<std::int64_t> current_stages() const;
  /// Of the current stage; throws `Error` if it is no block.
  [[nodiscard]] const Block& current_block() const;
  /// The same as its trials are drawn and felt: with the row of its square, and with the levels
  /// that it has for this participant; see `block_of`. Throws as `current_block`.
  [[nodiscard]] Block current_block_as_drawn() const;
  /// Of the current trial, or of the block where none waits.
  [[nodiscard]] TrialForm current_form() const;

  /// `language`: of the texts that the participant gets; "" for a simulated one.
  void start(const std::string& language = "");
  /// Entering a block draws its order. Interleaved blocks are entered all at once, and whose
  /// trial comes first is drawn.
  void enter_stage();
  void answer_item(const std::string& item, const std::string& answer);
  void explored(const std::string& medium, double intensity, std::int64_t first_tick,
                std::int64_t last_tick);
  void finish_stage();

  void start_trial(std::int64_t tick);
  /// Of the current trial, under way or not: throws as `begin_presentation` would for an
  /// interval that it has not, or to which nobody may go back any more.
  void require_interval(const std::string& interval) const;
  /// `interval`: "test", "reference" or "free_space"; or "first" or "second" of a trial whose
  /// order is drawn, stored as what it holds. The presentation under way, if any, must have
  /// been ended before.
  void begin_presentation(const std::string& interval, std::int64_t tick);
  void end_presentation(std::int64_t last_tick, const PresentationSummary& summary);
  /// Production: one step, beyond the range of starting values if need be, never below 0.
  /// Returns false, and does nothing, where the intensity cannot go further.
  bool adjust(Direction direction, StepSize size);
  [[nodiscard]] bool can_adjust(Direction direction, StepSize size) const;
  /// Throws as `answer` would for this value, so that nothing need be ended for it in vain.
  void require_answer(const std::optional<double>& value) const;
  /// The answer as it was given: percent, 1 and 0, or the interval that was chosen; in
  /// production the set intensity is the answer and `value` is ignored. None is "cannot tell",
  /// where the block takes that.
  void answer(const std::optional<double>& value, const core::AnswerMeasures& measures,
              std::int64_t last_tick);
  /// The question that waits for its answer: the first of the block that an answered trial of
  /// it has none to. The next turn of interleaved blocks is drawn after the last. While there
  /// is one, no trial begins and the block does not end.
  [[nodiscard]] std::optional<OpenQuestion> open_question() const;
  /// Answers it; throws `Error` where another one waits, or none, and where `answer` is none
  /// that its kind can have. `kNoAnswer` leaves out one that is not required.
  void answer_question(const std::string& question, const std::string& answer);
  /// Gives the attempt under way up; its trial is the next one again.
  void discard_attempt(const std::string& reason);
  /// Gives it up for what the apparatus or the machine did. Its trial comes again at a later
  /// place of the block, drawn evenly from all that are left, so that nobody feels a stimulus
  /// right after half of it; at once where answers decide what comes next, or nothing is left.
  /// Among interleaved blocks it comes with a later turn of its block, and whose turn it is now
  /// is drawn anew.
  void put_off_attempt(const std::string& reason);
  /// The same for an answer that did not come before the block's `answer_deadline_s`: it counts
  /// as missed. `given`: what came too late, for the reason; "" where nothing came.
  void miss_deadline(const std::string& given = "");

  /// Throws as `undo` would where there is nothing to be taken back.
  void require_undo() const;
  /// Takes the last answer of the current block back, of interleaved blocks the last one of
  /// all; its trial is run again.
  void undo(const std::string& reason);
  /// The same for any answer of the block under way that nothing has been drawn for since: of
  /// procedures whose answers decide what comes next, and of practice, the last one alone.
  [[nodiscard]] bool can_run_again(std::int64_t number) const;
  /// Throws as `run_again` would.
  void require_run_again(std::int64_t number) const;
  void run_again(std::int64_t number, const std::string& reason);
  /// Sets an earlier answer right, its presentations untouched; `value` as in `answer`, in
  /// production the intensity.
  void correct(std::int64_t number, const std::optional<double>& value,
               const std::string& reason);
  /// All answers of the current block are taken back; the order stays. Interleaved blocks begin
  /// anew together.
  void restart_block(const std::string& reason);
  void exclude(std::int64_t trial, const std::string& reason);
  void include(std::int64_t trial, const std::string& reason);

  void note(const std::string& text);
  /// `reason`: "" where it is still to come, see `explain_pause`.
  void pause(const std::string& reason);
  /// Says why the last pause was, which was stored without a reason and stays as it is.
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
  /// Throws `Error` where the hand was exposed to all that the study allows.
  void require_exposure_left() const;
  void loop_measured(const LoopMeasured& timing);
  void unblind(const std::string& reason);
  /// After the last stage.
  void complete();
  /// Before it; what there is stays, nothing more can be added.
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
