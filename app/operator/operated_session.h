#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/operator/answer_doubts.h"
#include "app/operator/answer_forms.h"
#include "app/operator/operator_request.h"
#include "app/operator/session_view.h"
#include "app/session/attachment_watch.h"
#include "app/session/operator_exchange.h"
#include "app/session/presenter.h"
#include "app/session/running_session.h"
#include "app/sound/session_sound.h"
#include "core/storage/study_store.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::app {

class LiveTrace;
class ScopeTrace;

/// A session that an operator runs for a participant. It takes requests in their order, moves
/// the session on, and says what it waits for. Every act is on disk before the view tells of
/// it. Only one thread uses it; `SessionWorker` is the thread beside a window. Not real time.
class OperatedSession {
 public:
  struct Parameters {
    core::StudyStore& store;
    std::int64_t session = 0;  ///< The store already has the session's row.
    const experiments::Study& study;
    /// The laboratory of the simulated hand; nullptr for a device that needs none.
    const experiments::Laboratory* laboratory = nullptr;
    OperatorExchange& exchange;
    /// Gets every sample, unless levels are hidden.
    LiveTrace* trace = nullptr;
    /// Gets every sample, unless levels are hidden.
    ScopeTrace* scopes = nullptr;
    /// The language of the study's texts; "" for the study's first language.
    std::string language;
    /// How the device was fitted when the session begins; empty if nobody said it.
    std::map<std::string, std::string> fitting{};
    /// If false, time passes only in `advance`, as tests need it.
    bool realtime = true;
    bool allow_no_realtime = false;
    /// Where stops are remembered that nobody released; "" for nowhere. See `remember_stop`.
    std::filesystem::path stops;
    /// Faults for tests and rehearsals.
    std::vector<device::ScheduledFault> injected_faults;
    WantedStreams streams{};  ///< Streams to and from other recorders, in real time.
    SoundChoice sound{};      ///< The output of the study's sound.
    WantedMarkers markers{};  ///< Pulses to another recorder, in real time.
    /// The names of the participant's controls, by action; see `operate::UseControl`.
    std::map<std::string, std::string> controls{};
    /// Called with every sample by the thread that stores it, as `trace` gets it; may be empty.
    std::function<void(const core::Sample&)> on_sample;
    /// Asks about an unlikely answer before it is stored; see answer_doubts.h.
    bool asks_about_answers = true;
  };

  /// Starts the device. Throws `Error` if it cannot be started.
  explicit OperatedSession(const Parameters& parameters);

  void request(OperatorRequest request);
  /// Carries out the requests that are due. Without real time, `duration_s` passes first.
  void advance(double duration_s);
  [[nodiscard]] SessionView view() const;
  /// True if the operator has left, the session is over, or nothing more can be stored.
  [[nodiscard]] bool over() const noexcept { return left_; }
  /// True while a request waits for a ramp, or for the rest before a trial.
  [[nodiscard]] bool has_waiting_requests() const noexcept { return !requests_.empty(); }
  /// After `over`: stores the notes, corrections and adverse events among what was requested
  /// since.
  void keep_what_was_written();

 private:
  struct Act;  ///< It has one overload for each request.

  /// A medium that is being felt outside of any trial.
  struct Feeling {
    std::int64_t first_tick = 0;
    experiments::MediumSetting setting;
  };

  /// An answer that is not stored until somebody has confirmed it.
  struct Doubted {
    operate::Answer answer;
    std::int64_t attempt = 0;
    /// Until the answer was given, not until it was confirmed.
    double response_time_s = 0.0;
    std::vector<AnswerDoubt> doubts;
  };

  /// What a pressed control asks for now; none if it asks for nothing.
  [[nodiscard]] std::optional<OperatorRequest> meaning_of(const operate::UseControl& use) const;
  /// How long before the end of the loop's newest tick an answer was given; 0 for one that was
  /// given in the window.
  [[nodiscard]] double given_before_s(const operate::Answer& answer) const;
  void carry_out_requests();
  [[nodiscard]] bool make_way_for_urgent();
  [[nodiscard]] std::string taken_back_words(const OperatorRequest& request,
                                             const std::string& reason) const;
  void carry_out(const OperatorRequest& request);
  [[nodiscard]] bool must_wait(const OperatorRequest& request) const;
  void watch_apparatus();
  void watch_for_faults();
  void arming_succeeded();
  void watch_for_loose_points();
  void watch_times();
  void watch_sound();
  [[nodiscard]] std::uint8_t loose_bits() const;
  void follow_session();
  void enter_stage();
  [[nodiscard]] bool stage_is_complete() const;
  void rest_before_trial();
  void abandon_presentation();
  void end_feeling(bool counts);
  [[nodiscard]] GivenAnswer given_answer(const experiments::TrialState& trial,
                                         experiments::AnswerKind kind,
                                         const std::optional<double>& value) const;
  /// True while the operator has not decided about the doubtful answer.
  [[nodiscard]] bool doubt_stands() const;
  [[nodiscard]] std::string doubted_words() const;
  [[nodiscard]] std::optional<DoubtView> doubt_view() const;
  [[nodiscard]] std::string note_of_doubt(const char* outcome) const;
  void give_up(const std::string& why);
  void remember_new_stop();
  void forget_stop() const;
  void move_simulated_hand(double height_m);

  /// True while a stimulus is under way; free space in a trial is none.
  [[nodiscard]] bool feels_stimulus() const;
  /// How much longer the stimulus under way has to be felt; 0 if there is none. `before_s` asks
  /// for the value of so many seconds ago.
  [[nodiscard]] double least_left_s(double before_s = 0.0) const;
  /// The time that is left to answer the trial under way; none if no answer can be given yet,
  /// or if there is no deadline.
  [[nodiscard]] std::optional<double> deadline_left_s() const;
  /// True if the last stimulus has reached its longest time, and nothing has followed.
  [[nodiscard]] bool stimulus_is_over() const;

  [[nodiscard]] bool is_alone() const { return row_.device == "mouse"; }
  [[nodiscard]] double now_s() const;
  /// The time since this visit began.
  [[nodiscard]] double visit_s() const { return begun_ ? now_s() - begun_s_ : 0.0; }
  [[nodiscard]] const experiments::SessionState& state() const;
  [[nodiscard]] const experiments::Stage* stage() const;
  [[nodiscard]] const experiments::Block* block() const;
  [[nodiscard]] std::optional<experiments::Exploration> next_medium() const;
  /// True if the stage is something to read, write or wait for: lists and consent come before
  /// anybody arms the device.
  [[nodiscard]] bool stage_needs_no_force() const;
  /// True if a fault keeps the session from going on. A device that is only disarmed does not,
  /// where nothing is felt.
  [[nodiscard]] bool is_held_up() const;
  [[nodiscard]] Step step() const;
  [[nodiscard]] Step step_in_stage() const;

  [[nodiscard]] AnswerForms answer_forms() const;
  [[nodiscard]] std::string words(const experiments::Text& text) const;
  [[nodiscard]] std::string title_of(std::size_t stage) const;
  [[nodiscard]] std::optional<ItemView> item_view() const;
  [[nodiscard]] ItemView question_view(
      const experiments::QuestionnaireItem& question, int index,
      const std::vector<experiments::QuestionnaireItem>& all) const;
  [[nodiscard]] std::vector<ItemView> answered_items() const;
  [[nodiscard]] std::vector<TrialView::Choice> choices_of(
      const experiments::Block& block, const experiments::TrialForm& form) const;
  [[nodiscard]] TrialView trial_view(std::int64_t number) const;
  [[nodiscard]] MediumView medium_view(const experiments::Exploration& medium) const;
  [[nodiscard]] std::string instructions() const;
  [[nodiscard]] std::string cautions() const;
  void count_trials(TrialView& view) const;
  [[nodiscard]] std::size_t first_together(std::size_t stage) const;
  [[nodiscard]] std::vector<std::size_t> trials_in_order() const;
  [[nodiscard]] std::vector<AnswerLine> answer_lines() const;
  [[nodiscard]] std::pair<std::string, std::string> labels_of(
      const experiments::Block& block) const;
  /// The answer in words, as it was given: a percentage, 1 and 0, or the chosen interval; none
  /// is "cannot tell".
  [[nodiscard]] std::string answer_in_words(const experiments::Block& block,
                                            const std::optional<double>& given) const;
  [[nodiscard]] AnswerForm form_of(const experiments::Block& block) const;
  [[nodiscard]] std::string level_of(const experiments::TrialState& trial) const;
  void describe_loop(SessionView& view) const;
  void describe_progress(SessionView& view) const;

  Parameters parameters_;
  core::SessionRow row_;
  bool hides_levels_;
  std::string remark_;
  RunningSession running_;
  experiments::Session& session_;
  Presenter presenter_;

  std::deque<OperatorRequest> requests_;
  std::string language_;
  bool begun_ = false;
  bool left_ = false;
  core::Fault known_fault_ = core::Fault::kNone;
  std::uint64_t known_stop_presses_ = 0;  ///< As far as they are remembered.
  std::uint64_t seen_num_faults_ = 0;     ///< With the fault that is shown.
  std::uint64_t known_num_faults_ = 0;    ///< When `rearm` was asked for.
  int num_own_faults_ = 0;  ///< That ended a force, of the device or this machine.
  bool rearming_ = false;
  bool was_paused_before_fault_ = false;
  AttachmentWatch attachment_;
  std::uint8_t paused_for_bits_ = 0;  ///< The points that came off before this pause.
  std::string failure_;
  std::string refusal_;
  std::uint64_t num_refusals_ = 0;
  std::optional<Feeling> feeling_;
  double begun_s_ = 0.0;
  double rest_until_s_ = 0.0;
  std::int64_t resting_for_trial_ = 0;
  /// The participant was told that the trial can begin after the rest before it.
  bool is_ready_told_ = false;
  double break_until_s_ = 0.0;
  /// For how long the trial's reference, or its first interval, was felt.
  std::optional<double> first_felt_s_;
  std::optional<Doubted> doubted_;  ///< See `doubt_stands`.
};

/// An answer that did not count, in words for the stored reason.
[[nodiscard]] std::string given_words(const operate::Answer& answer);

}  // namespace jnd::app
