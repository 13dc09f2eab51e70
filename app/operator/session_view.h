#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/operator/surroundings_view.h"
#include "core/exchange/telemetry.h"
#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// What the session waits for; it decides what the card in the middle shows.
enum class Step {
  /// Nothing has begun, or the session was interrupted; it waits for `Begin`.
  kBegin,
  /// A checklist's item, the consent or a question waits for its answer.
  kItem,
  kMedium,      ///< A medium waits to be felt outside of any trial.
  kFeeling,     ///< Such a medium is being felt.
  kBreak,       ///< The participant has a break.
  kRest,        ///< The free space before a trial is not over yet.
  kReady,       ///< The trial waits for its first presentation.
  kPresenting,  ///< A stimulus of a trial, or free space in it, is being felt.
  /// Everything in the stage is done; the session waits for `FinishStage`.
  kStageDone,
  kPaused,
  /// There was a fault, or something is to be felt and nobody has armed the device. There is no
  /// force; the session waits for `Rearm`.
  kFault,
  /// The disk or the device has failed. Nothing more can be stored; the operator can only
  /// leave.
  kFailed,
  kFinished,  ///< Every stage was run, or the session was ended early.
};

/// What the experimenter shows to the participant, who hears nothing.
enum class HandSign {
  kNone,
  kFist,
  kOneFinger,
  kTwoFingers,
  kThreeFingers,
  kReady,
  kRaise,
  kLower,
  kMatches,
  kOpenHand
};

struct StageLine {
  enum class Status { kDone, kNow, kLater };
  std::string title;  ///< "Block 1" where a name could tell the level.
  Status status = Status::kLater;
};

/// A checklist's item, a consent or a question, also one after a trial, that waits for an
/// answer.
struct ItemView {
  enum class Kind {
    kTick,
    kConsent,
    kNumber,
    kText,
    kWords,
    kChoice,
    kYesNo,
    kYesNoWhich,
    kScale
  };
  struct Option {
    std::string value, label;
  };
  std::int64_t stage = 0;
  /// The trial whose answer the question follows; 0 outside of trials.
  std::int64_t trial = 0;
  std::string name;  ///< As in `AnswerItem`.
  Kind kind = Kind::kTick;
  std::string text;                     ///< What to do, or the question.
  std::string say;                      ///< What to say, word for word; may be empty.
  std::vector<std::string> paragraphs;  ///< The text of a consent.
  std::string unit;
  std::optional<double> minimum, maximum;
  std::vector<Option> options;
  int num_steps = 10;
  std::string low_label, high_label;
  int num_words = 0;
  bool required = true;
  /// The numbers in "item 2 of 7", of its stage or after its trial.
  int index = 1, count = 1;
  std::string answer;  ///< The answer so far; "" for none yet.
};

struct TrialView {
  std::int64_t trial = 0;  ///< The trial's number in the session, as in requests.
  std::int64_t attempt = 1;
  int in_block = 1, num_in_block = 1;  ///< The numbers in "trial 23 of 40".
  /// The number is shown as "of about 40", because the answers decide it.
  bool num_is_expected = false;
  int repetition = 1, num_repetitions = 1;
  experiments::AnswerKind answer = experiments::AnswerKind::kYesNo;
  bool has_reference = false;
  bool adjustable = false;
  bool is_solid = false;  ///< A surface that is pressed, not a fluid.
  /// Intervals are called "first" and "second"; no view tells which one is the test.
  bool order_is_drawn = false;
  /// What is being felt: "test", "reference", "first", "second", "third" or "free_space"; ""
  /// for nothing.
  std::string interval;
  double felt_s = 0.0;  ///< For how long it has been felt.
  /// The last stimulus reached its longest time after `felt_s`; free space is felt now.
  bool stimulus_is_over = false;
  /// How much longer it has to be felt before anything else.
  double least_left_s = 0.0;
  /// The time left to answer; none if there is no deadline.
  std::optional<double> deadline_left_s;
  /// Intervals to which nobody may return.
  std::vector<std::string> closed_intervals;
  int num_strokes = 0;  ///< Whole strokes in this presentation.
  /// For how long the reference or the first interval was felt, the last time.
  std::optional<double> first_felt_s;
  /// What the question is about was felt in this attempt.
  bool can_answer = false;
  bool takes_cannot_tell = false;  ///< "Cannot tell" is an answer, too.
  std::string question;
  std::string yes_label, no_label;  ///< The labels of the two answers, or of the intervals.
  /// An interval that can be chosen, and its label.
  struct Choice {
    int interval = 1;
    std::string label;
  };
  std::vector<Choice> choices;
  int num_intervals = 2;  ///< Where the order is drawn.
  /// The first interval that was not felt yet; "" for none.
  std::string next_interval;
  std::optional<double> target_percent;
  /// The number of the standard, if it has one.
  std::optional<double> modulus_value;
  int num_steps = 0;                  ///< For a rating, the last step.
  std::string low_label, high_label;  ///< For a rating, the words at its ends.
  /// Such as "1.65 Pa s, reference 1.85 Pa s"; "" where it is hidden.
  std::string level;
  double rest_left_s = 0.0;  ///< The rest of the free space before the trial.
};

struct MediumView {
  std::string name;  ///< Such as "water, scale 2"; "a fluid" where it is hidden.
  std::string say;
  double felt_s = 0.0, duration_s = 0.0;
  int index = 1, count = 1;
};

/// The form of an answer: the buttons or the field of its trial.
struct AnswerForm {
  experiments::AnswerKind kind = experiments::AnswerKind::kYesNo;
  std::string yes_label, no_label;
  std::vector<TrialView::Choice> choices;  ///< The intervals that can be chosen.
  int num_steps = 0;                       ///< For a rating, the last step.
  std::string low_label, high_label;       ///< For a rating, the words at its ends.
  std::string unit;                        ///< The unit of an intensity; may be empty.
  bool takes_cannot_tell = false;
  /// An intensity that nobody may know, so nobody can type it.
  bool is_hidden = false;
};

/// An answer in the list of the last answers.
struct AnswerLine {
  std::int64_t trial = 0;
  int in_block = 1;
  std::string block;  ///< The block's title, or "Block 1".
  /// Such as "yes", "120 %" or "2.4"; "set" where it is hidden.
  std::string answer;
  AnswerForm form;
  double response_time_s = 0.0;
  /// Why it is doubtful, such as "no stroke in the test"; "" if it is not.
  std::string hint;
  bool can_undo = false;       ///< It is the last answer of the block under way.
  bool can_run_again = false;  ///< It can be run again, as by `RunAgain`.
};

/// An answer that the operator is asked about before it is stored.
struct DoubtView {
  std::int64_t trial = 0;
  /// Such as "The answer is 99999 %: 700 times the last answer."
  std::string sentence;
};

struct LoopView {
  double rate_hz = 0.0;
  double lateness_p99_us = 0.0, max_lateness_us = 0.0;
  std::int64_t missed_ticks = 0;
  std::uint64_t num_dropped_samples = 0;
  /// How often the limiter changed the force; 0 where hidden.
  std::uint64_t num_limited_ticks = 0;
  /// What the system granted, such as "SCHED_FIFO 80, memory locked".
  std::string scheduler;
  bool realtime = false;  ///< The system granted what a real device needs.
};

/// Everything that a window may know about a session: a picture of one moment, which changes
/// nothing. It does not contain what a double-blind study hides.
struct SessionView {
  std::string study, participant, device, language;
  bool pilot = false, simulated = false;
  experiments::Blinding blinding = experiments::Blinding::kNone;
  /// The study is double-blind, and nobody has unblinded it.
  bool hides_levels = false;
  /// The participant moves the mouse and sees this screen, so it shows no level.
  bool is_alone = false;

  Step step = Step::kBegin;
  /// What the card is about, such as "Test fluid", "Checklist" or "Break".
  std::string heading;
  std::string sentence;  ///< What to do now.
  std::string say;       ///< What to say, word for word; may be empty.
  HandSign sign = HandSign::kNone;
  /// For the participant's screen, in the study's language.
  std::string participant_text;

  std::vector<StageLine> stages;
  std::int64_t stage = 0;
  std::optional<ItemView> item;
  /// The answers to the questionnaire under way; a new answer to one of them replaces it.
  std::vector<ItemView> answered_items;
  std::optional<TrialView> trial;  ///< The block's trial, once it is drawn.
  /// The participant answers the block's trials by a control of their own.
  bool participant_answers = false;
  /// The names of mapped controls by their actions, such as "FootSwitch: B" for "first".
  std::map<std::string, std::string> controls;
  std::optional<MediumView> medium;
  double break_left_s = 0.0, break_s = 0.0;
  std::optional<DoubtView> doubt;  ///< Waits for `StoreDoubted` or `GoBack`.
  /// Whether the last answer was right, to be told to the participant.
  std::optional<bool> feedback_right;
  /// The last answer missed its deadline, which has to be told.
  bool missed_deadline = false;
  std::string practice;  ///< The result of a practice that is over.
  /// Doubts about the answers of a block that is over; "" if there are none, and where levels
  /// are hidden.
  std::string caution;
  std::vector<AnswerLine> answers;  ///< The newest comes first; at most fifty.
  std::vector<std::string> notes;

  double elapsed_s = 0.0;   ///< The time in all visits, without the time between them.
  double left_s = 0.0;      ///< Expected.
  double done_ratio = 0.0;  ///< The share of the session that is done, from 0 to 1.

  /// What the loop tells, but `num_faults` as of when `fault` was looked for, as `Rearm` takes
  /// it.
  core::Telemetry telemetry;
  double max_total_force_n = 0.0;
  int num_contact_points = 5;  ///< As the device declares it.
  SurroundingsView surroundings;
  LoopView loop;
  std::int64_t trials_on_disk = 0;  ///< The number of answers on disk.
  /// How many trials the whole session will have, in all blocks.
  std::int64_t num_trials = 0;
  bool num_trials_is_expected = false;  ///< The answers decide how many.
  std::int64_t last_sequence = 0;       ///< The number of the last event on disk.
  std::string fault;                    ///< One sentence; "" for none.
  std::string fault_name;               ///< Such as "emergency_stop".
  /// The points that came off, such as "the index finger"; "" for none.
  std::string loose_points;
  /// The same points as bits, as `GoOnWithout` takes them.
  std::uint8_t loose_bits = 0;
  /// The points that paused the session by coming off; "" if there is another reason.
  std::string came_off_points;
  /// The last pause has begun, and nobody has said why.
  bool asks_why_paused = false;
  /// The points that do not hold the hand and never did; "" for none.
  std::string absent_points;
  bool stop_pressed = false;
  std::uint64_t num_stop_presses = 0;  ///< As in `ReleaseStop`.
  /// Nobody has armed the device yet, which is no fault. Lists, consent and breaks go on.
  bool is_disarmed = false;
  /// Why the last request was not carried out; "" otherwise.
  std::string refusal;
  /// Increases with each refusal, so that the same sentence is noticed again.
  std::uint64_t num_refusals = 0;
  /// Such as "62 trials without a break, of at most 60"; "" otherwise.
  std::string advice;
  /// Such as "default, 2 gaps", or why the sound is not heard; "" otherwise.
  std::string sound_warning;
  /// Such as "the study file has changed since ..."; "" otherwise.
  std::string remark;
};

}  // namespace jnd::app
