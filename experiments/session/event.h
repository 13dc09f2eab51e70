#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/clock_comparison.h"
#include "core/exposure.h"
#include "core/marker.h"
#include "core/storage/study_store.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Everything that can happen in a session, as data. A session is the list of its events; its
/// state is what `apply` makes of them. Each event is one row, committed before it counts.

struct SessionStarted {
  /// Of the texts that the participant gets: "de". "": of a simulated one, or unknown.
  std::string language;
  /// What the participant brought: name of a field to its value.
  std::map<std::string, std::string> fields{};
};

struct StageEntered {
  std::int64_t stage = 0;  ///< Index into the participant's own list of stages, from 0.
  /// How many stages from this one on are entered at once: the blocks of a group, else 1.
  std::int64_t num_together = 1;
};

/// A checklist ticked, a consent given, a question answered.
struct ItemAnswered {
  std::int64_t stage = 0;
  std::string stage_name;
  std::string item;
  std::string answer;
};

/// A medium explored outside of any trial.
struct MediumExplored {
  std::int64_t stage = 0;
  std::string medium;
  double intensity = 0.0;
  std::int64_t first_tick = 0, last_tick = 0;
};

struct StageFinished {
  std::int64_t stage = 0;
};

/// The order of trials, drawn once and stored. `first_trial` is the running number in the
/// session.
struct TrialsDrawn {
  std::int64_t stage = 0;
  std::int64_t first_trial = 1;
  std::vector<PlannedTrial> trials;
};

/// Of interleaved blocks: the one whose trial comes next.
struct TurnTaken {
  std::int64_t stage = 0;
};

struct TrialStarted {
  std::int64_t trial = 0, attempt = 1;
  std::int64_t first_tick = 0;
};

/// The medium was switched to a stimulus; from the tick on it is being felt.
struct PresentationStarted {
  std::int64_t trial = 0, attempt = 1, presentation = 1;
  std::string interval;  ///< "test", "reference" or "free_space".
  double intensity = 0.0;
  std::int64_t first_tick = 0;
  std::int64_t place = 0;  ///< Of three intervals which one, from 1; 0: of none.
};

/// What came of one presentation.
struct PresentationSummary {
  core::PresentationMeasures measures;
  /// Of the hand since the presentation before, in between as well: of a real device, or where
  /// the study limits it.
  std::optional<core::Exposure> exposure{};
};

struct PresentationEnded {
  std::int64_t trial = 0, attempt = 1, presentation = 1;
  std::int64_t last_tick = 0;
  PresentationSummary summary;
};

/// One step of a production; the new intensity is presented next.
struct IntensityAdjusted {
  std::int64_t trial = 0, attempt = 1;
  double from_intensity = 0.0, to_intensity = 0.0;
};

struct TrialAnswered {
  std::int64_t trial = 0, attempt = 1;
  std::optional<double> response;  ///< Percent; 1 or 0; the intensity set; none: "cannot tell".
  core::AnswerMeasures measures;
  std::int64_t last_tick = 0;
  std::optional<bool> feedback_right;  ///< What was told of it; none where nothing is.
};

/// A question that follows the answer to a trial, answered.
struct QuestionAnswered {
  std::int64_t trial = 0, attempt = 1;
  std::string question;  ///< Name of the question in the study file.
  std::string answer;    ///< As it was given; "no_answer" where it was left out.
};

/// An answer taken back; the trial is run again as a new attempt. Trials of its block that were
/// drawn since and not answered are void: another answer draws others.
struct AnswerUndone {
  std::int64_t trial = 0, attempt = 1;
  std::int64_t answer_sequence = 0;
  std::string reason;
};

/// An answer set right later, the presentations untouched.
struct AnswerCorrected {
  std::int64_t trial = 0, attempt = 1;
  std::int64_t answer_sequence = 0;
  std::optional<double> response;  ///< None: "cannot tell".
  std::string reason;
  std::optional<std::int64_t> chosen_interval{};  ///< Of three intervals, from 1.
};

/// An attempt without an answer given up: interrupted, or invalid. The trial is run again.
struct AttemptDiscarded {
  std::int64_t trial = 0, attempt = 1;
  std::string reason;
  std::int64_t again_after = 0;  ///< The trial after which it comes again; 0: it is the next.
  bool missed_deadline = false;  ///< No answer came before the block's deadline.
  bool passes_turn = false;      ///< Of an interleaved block: the next turn is drawn anew.
};

struct TrialExcluded {
  std::int64_t trial = 0;
  std::string reason;
};
struct TrialIncluded {
  std::int64_t trial = 0;
  std::string reason;
};

struct NoteAdded {
  std::string text;
};
struct Paused {
  std::string reason;
};
/// Why a session was paused, said after the pause was stored.
struct PauseExplained {
  std::int64_t pause_sequence = 0;  ///< Of the event `Paused` that holds no reason.
  std::string reason;
};
struct Continued {};

/// The loop latched a fault.
struct FaultRaised {
  std::string fault;
};

/// Whether there may be force, in real time.
struct ArmingChanged {
  std::string state;  ///< The name that `core::name` gives an `Arming`.
  std::string cause;  ///< Who or what: "armed by the experimenter", a fault's name.
};

/// What a hand was exposed to outside of presentations that were ended: while a medium was
/// explored, or in an attempt that was given up.
struct ExposureTold {
  core::Exposure exposure;
};

/// The session goes on after its program ended without ending the session.
struct SessionResumed {
  std::string choice;                                     ///< "repeat", "restart" or "end".
  std::int64_t lost_first_tick = 0, lost_last_tick = -1;  ///< Recorded, but of no answer.
};

/// How the device was fitted to this person, and where the hand is in it at rest.
struct FittingKept {
  std::map<std::string, std::string> fitting;  ///< In people's words: "glove" is "M".
  std::vector<std::string> held;               ///< Points, by their names.
  /// Of each that is held, workspace frame.
  std::map<std::string, std::array<double, 3>> neutral_pose_m;
};

/// What the device said of itself.
struct DeviceTold {
  std::string model, serial, firmware;  ///< "": it does not say.
  std::vector<double> share_ratio;      ///< Of each contact point; 0: it has none there.
  std::vector<std::string> has;         ///< What it measures besides: "measured_force".
  double own_mass_kg = 0.0, own_damping_n_s_per_m = 0.0, closed_loop_delay_s = 0.0;
};

/// The real-time loop began to run, and what the system gave it.
struct LoopStarted {
  std::string scheduler;  ///< "SCHED_FIFO 80"
  bool memory_locked = false;
  std::vector<int> cpus;  ///< That it may run on, ascending.
  std::int64_t first_tick = 0;
  std::optional<DeviceTold> device;  ///< Not told by older programs.
};

/// How many durations were up to `up_to_ns` long, and longer than the bucket before.
struct DurationBucket {
  std::int64_t up_to_ns = 0, count = 0;
};

/// How punctual the loop has been since it was started.
struct LoopMeasured {
  std::int64_t num_ticks = 0, missed_ticks = 0, num_dropped_samples = 0;
  std::int64_t max_lateness_ns = 0, max_tick_cost_ns = 0;
  std::vector<DurationBucket> lateness, tick_cost;  ///< Buckets that are not empty, ascending.
  std::optional<core::ClockDrift> device_clock;     ///< Where it was measured for long enough.
};

/// Somebody asked to see what a double-blind study hides.
struct Unblinded {
  std::string reason;
};

/// Every stage was run.
struct SessionCompleted {};

/// What a guard of the loop has noticed since it was told last: how often it warned, and how
/// often, in shadow mode, it would have been a fault.
struct GuardNoticed {
  std::string guard;  ///< Its fault: "force_oscillates".
  std::int64_t num_warnings = 0, num_shadowed = 0;
};

/// A stream of the Lab Streaming Layer that goes out from this session, or is recorded with it.
struct StreamOpened {
  std::string direction;  ///< "out" or "in".
  std::string name, type, channel_format, source_id;
  std::string hostname;  ///< Of the other machine; "" for one of ours.
  std::int64_t channel_count = 0;
  double nominal_rate_hz = 0.0;
  std::string file;  ///< Beside the recording, where it is recorded; else "".
  std::string by;    ///< "jnd", or the library that carries it.
  /// Of the clock that streams tell their times by, at the time of the event.
  double monotonic_s = 0.0;
};

/// What became of it.
struct StreamClosed {
  std::string direction, name;
  std::string file;
  std::int64_t num_samples = 0, num_offsets = 0;
  std::int64_t num_dropped = 0;  ///< That came or went and were lost, as far as is known.
  std::string sha256;            ///< Of the file, where there is one; see `StreamFileSeal`.
};

/// A stream that was asked for and is not there, or went away: the session goes on without.
struct StreamFailed {
  std::string direction, name;
  std::string problem;  ///< A sentence.
};

/// What the participant hears began to play, or plays again.
struct SoundStarted {
  std::string output;     ///< In words: "ALSA 1.2.8, default, 48000 Hz, ...".
  std::string scheduler;  ///< Of its thread: "SCHED_FIFO 20".
  double rate_hz = 0.0;
  /// From the moment that a cue is asked for to its being heard, as the library reports the
  /// buffers that it knows of; the same for every cue.
  double cue_delay_s = 0.0;
  /// Sound pressure level of a sine of full scale; none where the output is not calibrated.
  std::optional<double> full_scale_db_spl;
  std::string calibrated_on;  ///< The day; "".
  /// Of the study's noise as it is played; none where there is none.
  std::optional<double> noise_level_dbfs;
};

/// A tone that the participant heard.
struct PlayedCue {
  std::string moment;                   ///< "ready", "begin" or "end".
  std::int64_t trial = 0, attempt = 1;  ///< Of a cue `ready`, the attempt that comes.
  std::int64_t presentation = 0;        ///< Of the attempt, from 1; 0: none.
  /// Of the monotonic clock, which samples have as well: when it was asked for, and when its
  /// first sample was heard as far as the library knows.
  double asked_monotonic_s = 0.0, heard_monotonic_s = 0.0;
};

/// Cues since this was told last.
struct CuesPlayed {
  std::vector<PlayedCue> cues;
};

/// How the sound has been since it began to play.
struct SoundMeasured {
  std::int64_t num_frames = 0;     ///< Samples of a channel.
  std::int64_t num_underruns = 0;  ///< Gaps.
  std::int64_t num_limited = 0;    ///< Samples that the limiter turned down.
  std::int64_t num_lost_cues = 0;  ///< That were asked for and found no place.
  double max_latency_s = 0.0;      ///< Longest from computation to hearing, as reported.
};

/// The study has sound and it is not heard, or not any more.
struct SoundMissing {
  std::string problem;
};

/// The port by which another recorder is told of what happens: it is open.
struct MarkersOpened {
  std::string port;  ///< "/dev/ttyUSB0"
  std::string way;   ///< "bytes", "rts", "dtr" or "parallel".
  double width_s = 0.0;
  std::map<std::string, int> codes{};  ///< By the names of `core::kMarkerNames`.
};

/// Pulses that were written since this was told last, in their order.
struct MarkersSent {
  std::vector<core::MarkerPulse> pulses;
};

/// What became of the port: how many pulses were written, and how many were not.
struct MarkersClosed {
  std::string port;
  std::int64_t num_sent = 0, num_dropped = 0;
};

/// A port that was asked for and does not do what it should: the session goes on without.
struct MarkersFailed {
  std::string port;
  std::string problem;  ///< A sentence.
};

/// A stimulus that asks for a force was presented, and no force acted on the hand meanwhile.
struct ForceMissing {
  std::int64_t trial = 0, attempt = 1, presentation = 1;
  std::string cause;  ///< What was missing, a part of a sentence.
};

/// Ended before its last stage; not resumable.
struct SessionEndedEarly {
  std::string reason;
};

using EventData = std::variant<
    SessionStarted, StageEntered, ItemAnswered, MediumExplored, StageFinished, TrialsDrawn,
    TrialStarted, PresentationStarted, PresentationEnded, IntensityAdjusted, TrialAnswered,
    AnswerUndone, AnswerCorrected, AttemptDiscarded, TrialExcluded, TrialIncluded, NoteAdded,
    Paused, Continued, FaultRaised, SessionResumed, LoopStarted, LoopMeasured, Unblinded,
    ArmingChanged, ExposureTold, GuardNoticed, FittingKept, QuestionAnswered, TurnTaken,
    PauseExplained, StreamOpened, StreamClosed, StreamFailed, SoundStarted, CuesPlayed,
    SoundMeasured, SoundMissing, MarkersOpened, MarkersSent, MarkersClosed, MarkersFailed,
    ForceMissing, SessionCompleted, SessionEndedEarly>;

struct Event {
  std::int64_t sequence = 0;  ///< 1, 2, 3 ...
  std::int64_t time_ns = 0;
  EventData data;
};

/// The word an event is stored under: "trial_answered".
[[nodiscard]] std::string kind_of(const EventData& data);

/// To and from its stored form. `event_from_row` throws `Error` naming session and sequence for
/// an unknown kind or damaged data.
[[nodiscard]] core::EventRow row_from_event(std::int64_t session, const Event& event);
[[nodiscard]] Event event_from_row(const core::EventRow& row);

}  // namespace jnd::experiments
