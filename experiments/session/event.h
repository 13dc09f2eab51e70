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

/// Everything that can happen in a session, as data. A session is the list of its events, and
/// its state is what `apply` makes of them. Each event is one row, which is committed before it
/// counts.

struct SessionStarted {
  /// Language of the texts that the participant gets, such as "de". "" for a simulated
  /// participant, or if unknown.
  std::string language;
  /// The participant's fields: name of a field to its value.
  std::map<std::string, std::string> fields{};
};

struct StageEntered {
  std::int64_t stage = 0;  ///< Index into the participant's own list of stages, from 0.
  /// How many stages from this one on are entered at once: the blocks of a group, or 1.
  std::int64_t num_together = 1;
};

/// An item of a checklist was ticked, consent was given, or a question was answered.
struct ItemAnswered {
  std::int64_t stage = 0;
  std::string stage_name;
  std::string item;
  std::string answer;
};

/// A medium was explored outside of any trial.
struct MediumExplored {
  std::int64_t stage = 0;
  std::string medium;
  double intensity = 0.0;
  std::int64_t first_tick = 0, last_tick = 0;
};

struct StageFinished {
  std::int64_t stage = 0;
};

/// The order of trials, drawn once and stored. `first_trial` is its running number in the
/// session.
struct TrialsDrawn {
  std::int64_t stage = 0;
  std::int64_t first_trial = 1;
  std::vector<PlannedTrial> trials;
};

/// For interleaved blocks: the block whose trial comes next.
struct TurnTaken {
  std::int64_t stage = 0;
};

struct TrialStarted {
  std::int64_t trial = 0, attempt = 1;
  std::int64_t first_tick = 0;
};

/// The medium was switched to a stimulus, which is felt from this tick on.
struct PresentationStarted {
  std::int64_t trial = 0, attempt = 1, presentation = 1;
  std::string interval;  ///< "test", "reference" or "free_space".
  double intensity = 0.0;
  std::int64_t first_tick = 0;
  std::int64_t place = 0;  ///< Which of three intervals it is, from 1; 0 for none.
};

/// Results of one presentation.
struct PresentationSummary {
  core::PresentationMeasures measures;
  /// Exposure of the hand since the previous presentation, including the time in between. Set
  /// on a real device, or if the study limits it.
  std::optional<core::Exposure> exposure{};
};

struct PresentationEnded {
  std::int64_t trial = 0, attempt = 1, presentation = 1;
  std::int64_t last_tick = 0;
  PresentationSummary summary;
};

/// One step of an adjustment. The new intensity is presented next.
struct IntensityAdjusted {
  std::int64_t trial = 0, attempt = 1;
  double from_intensity = 0.0, to_intensity = 0.0;
};

struct TrialAnswered {
  std::int64_t trial = 0, attempt = 1;
  /// Percent, 1 or 0, or the intensity that was set; none means "cannot tell".
  std::optional<double> response;
  core::AnswerMeasures measures;
  std::int64_t last_tick = 0;
  std::optional<bool> feedback_right;  ///< The feedback that was given; none if there was none.
};

/// A question after the answer to a trial was answered.
struct QuestionAnswered {
  std::int64_t trial = 0, attempt = 1;
  std::string question;  ///< Name of the question in the study file.
  std::string answer;    ///< As it was given; "no_answer" if it was left out.
};

/// An answer was taken back, and the trial is run again as a new attempt. Trials of its block
/// that were drawn since and not answered are void, because another answer leads to others.
struct AnswerUndone {
  std::int64_t trial = 0, attempt = 1;
  std::int64_t answer_sequence = 0;
  std::string reason;
};

/// An answer was corrected later; its presentations are unchanged.
struct AnswerCorrected {
  std::int64_t trial = 0, attempt = 1;
  std::int64_t answer_sequence = 0;
  std::optional<double> response;  ///< None means "cannot tell".
  std::string reason;
  std::optional<std::int64_t> chosen_interval{};  ///< Chosen of three intervals, from 1.
};

/// An attempt without an answer was given up, because it was interrupted or invalid. The trial
/// is run again.
struct AttemptDiscarded {
  std::int64_t trial = 0, attempt = 1;
  std::string reason;
  /// The trial after which it is repeated; 0 if it is the next one.
  std::int64_t again_after = 0;
  bool missed_deadline = false;  ///< No answer came before the block's deadline.
  bool passes_turn = false;      ///< For an interleaved block: the next turn is drawn again.
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
/// The reason of a pause, given after the pause was stored.
struct PauseExplained {
  /// Sequence number of the event `Paused`, which has no reason.
  std::int64_t pause_sequence = 0;
  std::string reason;
};
struct Continued {};

/// The loop latched a fault.
struct FaultRaised {
  std::string fault;
};

/// Tells whether there may be force, in real time.
struct ArmingChanged {
  std::string state;  ///< The name that `core::name` gives an `Arming`.
  /// Who or what caused it: "armed by the experimenter", or a fault's name.
  std::string cause;
};

/// Exposure of a hand outside of ended presentations: while a medium was explored, or in an
/// attempt that was given up.
struct ExposureTold {
  core::Exposure exposure;
};

/// The session continues after its program ended without ending the session.
struct SessionResumed {
  std::string choice;  ///< "repeat", "restart" or "end".
  /// Recorded ticks that belong to no answer.
  std::int64_t lost_first_tick = 0, lost_last_tick = -1;
};

/// How the device was fitted to this person, and where the hand rests in it.
struct FittingKept {
  std::map<std::string, std::string> fitting;  ///< In people's words: "glove" is "M".
  std::vector<std::string> held;               ///< Attached points, by name.
  /// Position of each attached point, in the workspace frame.
  std::map<std::string, std::array<double, 3>> neutral_pose_m;
};

/// What the device reported about itself.
struct DeviceTold {
  std::string model, serial, firmware;  ///< "" if the device does not report it.
  /// Share of each contact point; 0 if the device lacks it.
  std::vector<double> share_ratio;
  std::vector<std::string> has;  ///< What it measures besides, such as "measured_force".
  double own_mass_kg = 0.0, own_damping_n_s_per_m = 0.0, closed_loop_delay_s = 0.0;
};

/// The real-time loop began to run, with what the system granted.
struct LoopStarted {
  std::string scheduler;  ///< "SCHED_FIFO 80"
  bool memory_locked = false;
  std::vector<int> cpus;  ///< Processors on which it may run, ascending.
  std::int64_t first_tick = 0;
  std::optional<DeviceTold> device;  ///< Older programs did not store it.
};

/// The number of durations up to `up_to_ns` that are longer than the bucket before.
struct DurationBucket {
  std::int64_t up_to_ns = 0, count = 0;
};

/// How punctual the loop has been since its start.
struct LoopMeasured {
  std::int64_t num_ticks = 0, missed_ticks = 0, num_dropped_samples = 0;
  std::int64_t max_lateness_ns = 0, max_tick_cost_ns = 0;
  /// The buckets that are not empty, ascending.
  std::vector<DurationBucket> lateness, tick_cost;
  std::optional<core::ClockDrift> device_clock;  ///< Set if it was measured for long enough.
};

/// Somebody asked to see what a double-blind study hides.
struct Unblinded {
  std::string reason;
};

/// Every stage was run.
struct SessionCompleted {};

/// What a guard of the loop has noticed since the last such event: how often it warned, and how
/// often, in shadow mode, it would have been a fault.
struct GuardNoticed {
  std::string guard;  ///< The guard's fault: "force_oscillates".
  std::int64_t num_warnings = 0, num_shadowed = 0;
};

/// A stream of the Lab Streaming Layer that this session sends or records.
struct StreamOpened {
  std::string direction;  ///< "out" or "in".
  std::string name, type, channel_format, source_id;
  std::string hostname;  ///< Name of the other machine; "" for a stream of ours.
  std::int64_t channel_count = 0;
  double nominal_rate_hz = 0.0;
  std::string file;  ///< File beside the recording, if the stream is recorded; otherwise "".
  std::string by;    ///< "jnd", or the library that carries the stream.
  /// Time of the event by the clock of streams.
  double monotonic_s = 0.0;
};

/// The end of a stream.
struct StreamClosed {
  std::string direction, name;
  std::string file;
  std::int64_t num_samples = 0, num_offsets = 0;
  std::int64_t num_dropped = 0;  ///< Samples that were lost on the way, as far as is known.
  std::string sha256;            ///< Hash of the file, if there is one; see `StreamFileSeal`.
};

/// A requested stream is missing or went away. The session continues without it.
struct StreamFailed {
  std::string direction, name;
  std::string problem;  ///< A sentence.
};

/// The participant's sound began to play, or plays again.
struct SoundStarted {
  std::string output;     ///< In words: "ALSA 1.2.8, default, 48000 Hz, ...".
  std::string scheduler;  ///< Of the sound's thread: "SCHED_FIFO 20".
  double rate_hz = 0.0;
  /// Delay from the request of a cue until it is heard, based on the buffers that the library
  /// reports. It is the same for every cue.
  double cue_delay_s = 0.0;
  /// Sound pressure level of a sine of full scale; none if the output is not calibrated.
  std::optional<double> full_scale_db_spl;
  std::string calibrated_on;  ///< Day of the calibration; "" without one.
  /// Level of the study's noise as it is played; none without noise.
  std::optional<double> noise_level_dbfs;
};

/// A tone that the participant heard.
struct PlayedCue {
  std::string moment;                   ///< "ready", "begin" or "end".
  std::int64_t trial = 0, attempt = 1;  ///< For the cue `ready`, this is the next attempt.
  std::int64_t presentation = 0;        ///< Of the attempt, from 1; 0 for none.
  /// Time of the request, and time when the first sample was heard as far as the library knows,
  /// by the monotonic clock, which samples have as well.
  double asked_monotonic_s = 0.0, heard_monotonic_s = 0.0;
};

/// Cues since the last such event.
struct CuesPlayed {
  std::vector<PlayedCue> cues;
};

/// The quality of the sound since it began to play.
struct SoundMeasured {
  std::int64_t num_frames = 0;     ///< Samples in each channel.
  std::int64_t num_underruns = 0;  ///< Gaps in the sound.
  std::int64_t num_limited = 0;    ///< Samples that the limiter turned down.
  std::int64_t num_lost_cues = 0;  ///< Requested cues that found no place.
  double max_latency_s = 0.0;      ///< Longest time from computation to hearing, as reported.
};

/// The study has sound that is not heard, or no longer.
struct SoundMissing {
  std::string problem;
};

/// The port that sends pulses to another recorder was opened.
struct MarkersOpened {
  std::string port;  ///< "/dev/ttyUSB0"
  std::string way;   ///< "bytes", "rts", "dtr" or "parallel".
  double width_s = 0.0;
  std::map<std::string, int> codes{};  ///< By the names of `core::kMarkerNames`.
};

/// Pulses that were written since the last such event, in order.
struct MarkersSent {
  std::vector<core::MarkerPulse> pulses;
};

/// The port was closed, with the numbers of pulses that were written and that were not.
struct MarkersClosed {
  std::string port;
  std::int64_t num_sent = 0, num_dropped = 0;
};

/// A requested port does not work. The session continues without it.
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

/// Returns the word under which an event is stored: "trial_answered".
[[nodiscard]] std::string kind_of(const EventData& data);

/// These convert to and from the stored form. `event_from_row` throws `Error` naming session
/// and sequence for an unknown kind or damaged data.
[[nodiscard]] core::EventRow row_from_event(std::int64_t session, const Event& event);
[[nodiscard]] Event event_from_row(const core::EventRow& row);

}  // namespace jnd::experiments
