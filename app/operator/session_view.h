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

/// What the session waits for, and so what stands on the card in the middle.
enum class Step {
  kBegin,       ///< Nothing has begun, or it was interrupted: waits for `Begin`.
  kItem,        ///< A checklist's item, the consent or a question waits for its answer.
  kMedium,      ///< A medium waits to be felt outside of any trial.
  kFeeling,     ///< It is being felt.
  kBreak,       ///< Rest.
  kRest,        ///< Free space before a trial, still running.
  kReady,       ///< The trial waits for its first presentation.
  kPresenting,  ///< A trial's stimulus, or free space in it, is being felt.
  kStageDone,   ///< Everything in the stage is done; waits for `FinishStage`.
  kPaused,
  kFault,     ///< A fault, or nobody has armed the device: no force. Waits for `Rearm`.
  kFailed,    ///< The disk or the device gave up: nothing more can be stored. Only leaving.
  kFinished,  ///< Every stage was run, or it was ended early.
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

/// A checklist's item, a consent or a question, also one after a trial, waiting for an answer.
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
  std::int64_t trial = 0;  ///< Whose answer the question follows; 0 outside of trials.
  std::string name;        ///< As in `AnswerItem`.
  Kind kind = Kind::kTick;
  std::string text;                     ///< What to do, or the question.
  std::string say;                      ///< Word for word; may be empty.
  std::vector<std::string> paragraphs;  ///< Of a consent.
  std::string unit;
  std::optional<double> minimum, maximum;
  std::vector<Option> options;
  int num_steps = 10;
  std::string low_label, high_label;
  int num_words = 0;
  bool required = true;
  int index = 1, count = 1;  ///< "item 2 of 7" of its stage, or after its trial.
  std::string answer;        ///< The one that stands; "" for none yet.
};

struct TrialView {
  std::int64_t trial = 0;  ///< In the session, as in requests.
  std::int64_t attempt = 1;
  int in_block = 1, num_in_block = 1;  ///< "trial 23 of 40"
  bool num_is_expected = false;        ///< "of about 40": the answers decide.
  int repetition = 1, num_repetitions = 1;
  experiments::AnswerKind answer = experiments::AnswerKind::kYesNo;
  bool has_reference = false;
  bool adjustable = false;
  bool is_solid = false;        ///< A surface that is pressed, not a fluid.
  bool order_is_drawn = false;  ///< Intervals are "first" and "second"; which is the test is
                                ///< nowhere in a view.
  /// Being felt: "test", "reference", "first", "second", "third", "free_space"; "" for none.
  std::string interval;
  double felt_s = 0.0;  ///< For how long already.
  /// The last stimulus came to its longest time, after `felt_s`; what is felt is free space.
  bool stimulus_is_over = false;
  double least_left_s = 0.0;              ///< That it has to be felt yet, before anything else.
  std::optional<double> deadline_left_s;  ///< To answer; none where there is no deadline.
  std::vector<std::string> closed_intervals;  ///< That nobody may go back to any more.
  int num_strokes = 0;                        ///< Whole ones, in this presentation.
  std::optional<double> first_felt_s;  ///< Reference or first interval, the last time before.
  bool can_answer = false;             ///< What is asked about was felt in this attempt.
  bool takes_cannot_tell = false;      ///< "Cannot tell" is an answer, too.
  std::string question;
  std::string yes_label, no_label;  ///< What the two answers are called; the intervals.
  /// The intervals that can be chosen, and what they are called.
  struct Choice {
    int interval = 1;
    std::string label;
  };
  std::vector<Choice> choices;
  int num_intervals = 2;      ///< Where the order is drawn.
  std::string next_interval;  ///< The first that was not felt yet; "" for none.
  std::optional<double> target_percent;
  std::optional<double> modulus_value;  ///< The number of the standard, where it has one.
  int num_steps = 0;                    ///< Of a rating: its last step.
  std::string low_label, high_label;    ///< Of a rating: what stands at its ends.
  std::string level;         ///< "1.65 Pa s, reference 1.85 Pa s"; "" where it is hidden.
  double rest_left_s = 0.0;  ///< Time left of the free space before it.
};

struct MediumView {
  std::string name;  ///< "water, scale 2"; "a fluid" where it is hidden.
  std::string say;
  double felt_s = 0.0, duration_s = 0.0;
  int index = 1, count = 1;
};

/// What an answer can be: the buttons or the field that its trial has.
struct AnswerForm {
  experiments::AnswerKind kind = experiments::AnswerKind::kYesNo;
  std::string yes_label, no_label;
  std::vector<TrialView::Choice> choices;  ///< Where an interval is chosen.
  int num_steps = 0;                       ///< Of a rating: its last step.
  std::string low_label, high_label;       ///< Of a rating: what stands at its ends.
  std::string unit;                        ///< Of an intensity; may be empty.
  bool takes_cannot_tell = false;
  bool is_hidden = false;  ///< An intensity that nobody may know, and so nobody can type.
};

/// An answer as it stands in the list of the last ones.
struct AnswerLine {
  std::int64_t trial = 0;
  int in_block = 1;
  std::string block;   ///< Title, or "Block 1".
  std::string answer;  ///< "yes", "120 %", "2.4" ("set" where it is hidden).
  AnswerForm form;
  double response_time_s = 0.0;
  std::string hint;       ///< What speaks against it: "no stroke in the test"; "" for nothing.
  bool can_undo = false;  ///< The last one of the block under way.
  bool can_run_again = false;  ///< As `RunAgain`.
};

/// An answer that is asked about before it is stored.
struct DoubtView {
  std::int64_t trial = 0;
  std::string sentence;  ///< "The answer is 99999 %: 700 times the last answer."
};

struct LoopView {
  double rate_hz = 0.0;
  double lateness_p99_us = 0.0, max_lateness_us = 0.0;
  std::int64_t missed_ticks = 0;
  std::uint64_t num_dropped_samples = 0;
  std::uint64_t num_limited_ticks = 0;  ///< The limiter changed the force; 0 where hidden.
  std::string scheduler;  ///< What the system gave: "SCHED_FIFO 80, memory locked".
  bool realtime = false;  ///< What a real device needs was given.
};

/// Everything a window may know of a session: a picture of one moment, nothing to change. What
/// a double-blind study hides is not in it at all.
struct SessionView {
  std::string study, participant, device, language;
  bool pilot = false, simulated = false;
  experiments::Blinding blinding = experiments::Blinding::kNone;
  bool hides_levels = false;  ///< Double-blind and nobody has unblinded the study.
  /// Who moves the mouse is the participant and sees this screen: no level is on it.
  bool is_alone = false;

  Step step = Step::kBegin;
  std::string heading;   ///< "Test fluid", "Checklist", "Break": what the card is about.
  std::string sentence;  ///< What to do now.
  std::string say;       ///< What to say, word for word; may be empty.
  HandSign sign = HandSign::kNone;
  std::string participant_text;  ///< For the participant's screen, in the study's language.

  std::vector<StageLine> stages;
  std::int64_t stage = 0;
  std::optional<ItemView> item;
  /// Of a questionnaire under way; answering one of them again supersedes.
  std::vector<ItemView> answered_items;
  std::optional<TrialView> trial;    ///< In a block, once it is drawn.
  bool participant_answers = false;  ///< The block's trials, by a control of theirs.
  /// What mapped controls are called, by what they do: "first" is "FootSwitch: B".
  std::map<std::string, std::string> controls;
  std::optional<MediumView> medium;
  double break_left_s = 0.0, break_s = 0.0;
  std::optional<DoubtView> doubt;      ///< Waits for `StoreDoubted` or `GoBack`.
  std::optional<bool> feedback_right;  ///< To be told of the last answer.
  bool missed_deadline = false;        ///< To be told: the last answer did.
  std::string practice;                ///< What a practice has come to, once it is over.
  /// What the answers of a block say against it, once it is over; "" where nothing does, and
  /// where levels are hidden.
  std::string caution;
  std::vector<AnswerLine> answers;  ///< The newest first; at most fifty.
  std::vector<std::string> notes;

  double elapsed_s = 0.0;   ///< In all visits, without what lay between them.
  double left_s = 0.0;      ///< Expected.
  double done_ratio = 0.0;  ///< Share of the session that is done.

  core::Telemetry telemetry;
  double max_total_force_n = 0.0;
  int num_contact_points = 5;  ///< That the device declares.
  SurroundingsView surroundings;
  LoopView loop;
  std::int64_t trials_on_disk = 0;  ///< Answers, that is.
  /// That the whole session will have, in every block.
  std::int64_t num_trials = 0;
  bool num_trials_is_expected = false;  ///< The answers decide how many.
  std::int64_t last_sequence = 0;       ///< Of the last event on disk.
  std::string fault;                    ///< One sentence; "" for none.
  std::string fault_name;               ///< "emergency_stop"
  std::string loose_points;             ///< "the index finger": it came off; "" for none.
  std::uint8_t loose_bits = 0;          ///< These points as bits, as `GoOnWithout` takes them.
  std::string came_off_points;          ///< Why the session is paused; "" for another reason.
  bool asks_why_paused = false;         ///< The last pause holds, and nobody has said why.
  std::string absent_points;  ///< That do not hold the hand and never did; "" for none.
  bool stop_pressed = false;
  std::uint64_t num_stop_presses = 0;  ///< As in `ReleaseStop`.
  bool is_disarmed = false;            ///< Nobody has armed the device yet: no fault.
  std::string refusal;             ///< Why the last request was not carried out; "" otherwise.
  std::uint64_t num_refusals = 0;  ///< So that the same sentence twice is seen twice.
  std::string advice;         ///< "62 trials without a break, of at most 60"; "" otherwise.
  std::string sound_warning;  ///< "default, 2 gaps", or why it is not heard; "" otherwise.
  std::string remark;         ///< "the study file has changed since ..."; "" otherwise.
};

}  // namespace jnd::app
