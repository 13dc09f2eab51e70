#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "core/stored_column.h"

namespace jnd::core {

// The rows of study.sqlite and their columns. A new column needs a field, a line in the table
// below its struct, and a step of data/database. The code that measures its value sets the
// field.

/// One act in a session, as it is stored. Storage never reads inside of `data`, which is JSON.
struct EventRow {
  std::int64_t session = 0;
  std::int64_t sequence = 0;  ///< Number within the session, without gaps.
  std::string kind;
  int version = 1;
  std::int64_t time_ns = 0;
  std::optional<std::int64_t> stage;  ///< Index into the participant's own list of stages.
  std::optional<std::int64_t> trial, attempt;
  std::optional<std::int64_t> first_tick, last_tick;
  std::optional<double> intensity;
  std::optional<std::int64_t> supersedes;
  std::string data = "{}";
};
template <>
inline constexpr auto kColumns<EventRow> = std::tuple{
    StoredColumn{&EventRow::session, "session"},
    StoredColumn{&EventRow::sequence, "sequence", "",
                 "1, 2, 3 ... in the order in which it happened"},
    StoredColumn{&EventRow::kind, "kind", "", "What happened"},
    StoredColumn{&EventRow::version, "version", "", "Of the layout of data"},
    StoredColumn{&EventRow::time_ns, "time_ns", "ns",
                 "Since 1970-01-01 UTC; a simulated session counts from 0"},
    StoredColumn{&EventRow::stage, "stage", "",
                 "Place of the stage in the participant's list, from 0"},
    StoredColumn{&EventRow::trial, "trial", "", "Running number in the session"},
    StoredColumn{&EventRow::attempt, "attempt", "", "1 is the first"},
    StoredColumn{&EventRow::first_tick, "first_tick", "tick", "In the recording"},
    StoredColumn{&EventRow::last_tick, "last_tick", "tick", "In the recording"},
    StoredColumn{&EventRow::intensity, "intensity", "unit of quantity", "Presented or set"},
    StoredColumn{&EventRow::supersedes, "supersedes", "",
                 "Sequence of the event that no longer counts"},
    StoredColumn{&EventRow::data, "data", "", "Everything else, as JSON"}};

/// One trial as it was drawn.
struct DesignRow {
  std::int64_t session = 0;
  std::int64_t trial = 0;
  std::int64_t stage = 0;
  std::string block;  ///< Name of the block's stage.
  std::string procedure;
  std::string medium;
  std::string quantity;
  std::int64_t repetition = 0;  ///< Counted from 1.
  std::int64_t position = 0;    ///< Position within the repetition, from 1.
  std::optional<double> intensity, reference_intensity, starting_intensity, target_percent;
  /// Sequence number of the event that drew the trial.
  std::optional<std::int64_t> sequence;
  std::optional<std::int64_t> series;         ///< Staircase or series of the block, from 1.
  std::optional<std::int64_t> test_interval;  ///< 1 or 2, if the order is drawn.
  bool is_catch = false;                      ///< A catch trial: there is nothing to find.
  std::string intervals;  ///< What three intervals hold, as in "rtr"; otherwise "".
  std::optional<std::int64_t> right_interval;  ///< The right answer of three intervals, from 1.
};
template <>
inline constexpr auto kColumns<DesignRow> =
    std::tuple{StoredColumn{&DesignRow::session, "session"},
               StoredColumn{&DesignRow::trial, "trial"},
               StoredColumn{&DesignRow::stage, "stage"},
               StoredColumn{&DesignRow::block, "block"},
               StoredColumn{&DesignRow::procedure, "procedure"},
               StoredColumn{&DesignRow::medium, "medium"},
               StoredColumn{&DesignRow::quantity, "quantity"},
               StoredColumn{&DesignRow::repetition, "repetition"},
               StoredColumn{&DesignRow::position, "position"},
               StoredColumn{&DesignRow::intensity, "intensity"},
               StoredColumn{&DesignRow::reference_intensity, "reference_intensity"},
               StoredColumn{&DesignRow::starting_intensity, "starting_intensity"},
               StoredColumn{&DesignRow::target_percent, "target_percent"},
               StoredColumn{&DesignRow::sequence, "sequence"},
               StoredColumn{&DesignRow::series, "series"},
               StoredColumn{&DesignRow::test_interval, "test_interval"},
               StoredColumn{&DesignRow::is_catch, "is_catch"},
               StoredColumn{&DesignRow::intervals, "intervals"},
               StoredColumn{&DesignRow::right_interval, "right_interval"}};

/// How the hand moved in a presentation, and what was delivered.
struct PresentationMeasures {
  std::int64_t num_strokes = 0;
  std::optional<double> stroke_width_m, max_speed_m_per_s, mean_height_m;
  /// The stimulus as delivered: regression slope of the delivered force against the motion on
  /// speed.
  std::optional<double> delivered_damping_n_s_per_m;
  std::optional<double> commanded_damping_n_s_per_m;
  std::int64_t limited_ticks = 0;
  std::int64_t missed_ticks = 0;
  std::optional<double> finger_lag_s;
};
template <>
inline constexpr auto kColumns<PresentationMeasures> = [] {
  using Row = PresentationMeasures;
  using enum EventKey;
  using enum BidsEvents;
  return std::tuple{
      StoredColumn{&Row::num_strokes, "num_strokes", "",
                   "Whole strokes: to a turning point and back", kAlways, kHaveNot},
      StoredColumn{&Row::stroke_width_m, "stroke_width_m", "m",
                   "Mean distance between turning points", kAlways, kHaveNot},
      StoredColumn{&Row::max_speed_m_per_s, "max_speed_m_per_s", "m/s",
                   "Mean of the highest speed in each stroke", kAlways, kHaveNot},
      StoredColumn{&Row::mean_height_m, "mean_height_m", "m",
                   "Mean height of the hand, workspace frame", kAlways, kHaveNot},
      StoredColumn{&Row::delivered_damping_n_s_per_m, "delivered_damping_n_s_per_m", "N s/m",
                   "Delivered force over speed, regression slope", kAlways, kHaveNot},
      StoredColumn{&Row::commanded_damping_n_s_per_m, "commanded_damping_n_s_per_m", "N s/m",
                   "Commanded; empty for water", kAlways, kHaveNot},
      StoredColumn{&Row::limited_ticks, "limited_ticks", "ticks",
                   "Ticks in which the force limiter changed the force", kAlways, kHaveNot},
      StoredColumn{&Row::missed_ticks, "missed_ticks", "ticks",
                   "Ticks that were due and never ran", kWhereThere, kHaveNot},
      StoredColumn{&Row::finger_lag_s, "finger_lag_s", "s",
                   "By which thumb, index and middle trail behind the palm", kLater, kHaveNot}};
}();

/// One presentation of a stimulus.
struct PresentationRow {
  std::int64_t session = 0;
  std::int64_t trial = 0;
  std::int64_t attempt = 0;
  std::int64_t presentation = 0;
  std::int64_t sequence = 0;  ///< Sequence number of the event that reported it.
  std::string interval;
  double intensity = 0.0;
  std::int64_t first_tick = 0, last_tick = 0;
  PresentationMeasures measures;
};
template <>
inline constexpr auto kColumns<PresentationRow> = std::tuple{
    StoredColumn{&PresentationRow::session, "session"},
    StoredColumn{&PresentationRow::trial, "trial", "", "Running number in the session"},
    StoredColumn{&PresentationRow::attempt, "attempt", "", "Attempt whose answer stands"},
    StoredColumn{&PresentationRow::presentation, "presentation", "",
                 "Within the attempt, from 1"},
    StoredColumn{&PresentationRow::sequence, "sequence"},
    StoredColumn{&PresentationRow::interval, "interval", "", "test, reference or free_space"},
    StoredColumn{&PresentationRow::intensity, "intensity", "unit of quantity",
                 "What was presented"},
    StoredColumn{&PresentationRow::first_tick, "first_tick", "tick",
                 "First sample in the recording"},
    StoredColumn{&PresentationRow::last_tick, "last_tick", "tick",
                 "Last sample in the recording"},
    StoredPart{&PresentationRow::measures}};

/// What is measured when a trial is answered.
struct AnswerMeasures {
  std::optional<double> response_time_s;
  std::optional<std::int64_t> chosen_interval{};
  std::string answered_by{};  ///< "participant" or "experimenter"; "" for a simulated person.
  /// The control that was used, such as "0c45:7403 FootSwitch/KEY_B"; "" for the window's own
  /// keys.
  std::string control{};
  std::optional<double> control_monotonic_s{};  ///< When the control was pressed.
};
template <>
inline constexpr auto kColumns<AnswerMeasures> = std::tuple{
    StoredColumn{&AnswerMeasures::chosen_interval, "chosen_interval", "",
                 "Of three intervals the one that was chosen, from 1"},
    StoredColumn{&AnswerMeasures::response_time_s, "response_time_s", "s",
                 "From the start of the last stimulus to the answer; where one is adjusted, "
                 "from the start of that",
                 EventKey::kAlways},
    StoredColumn{&AnswerMeasures::answered_by, "answered_by", "",
                 "Who gave it to the program: participant or experimenter; empty: a simulated "
                 "participant, or an older program"},
    StoredColumn{
        &AnswerMeasures::control, "control", "",
        "The pedal or button that it was given by, its device before the slash; empty: "
        "the window's keys and buttons"},
    StoredColumn{&AnswerMeasures::control_monotonic_s, "control_monotonic_s", "s",
                 "When that was pressed, as the kernel has it: by CLOCK_MONOTONIC, as "
                 "monotonic_s of samples. response_time_s then counts to it"}};

/// One answered trial.
struct TrialRow {
  std::int64_t session = 0;
  std::int64_t trial = 0;
  std::int64_t attempt = 0;
  std::int64_t sequence = 0;  ///< Sequence number of the answer's event.
  std::string block, procedure, medium, quantity;
  std::int64_t repetition = 0, position = 0;
  std::optional<double> intensity;
  std::optional<double> reference_intensity, starting_intensity, target_percent;
  std::optional<double> response;
  AnswerMeasures measures;
  std::int64_t num_presentations = 0, num_steps = 0;
  std::int64_t first_tick = 0, last_tick = 0;
  std::optional<std::int64_t> series, test_interval;
  bool is_catch = false;
  std::string intervals;
  std::optional<std::int64_t> right_interval;
};
template <>
inline constexpr auto kColumns<TrialRow> = std::tuple{
    StoredColumn{&TrialRow::session, "session"},
    StoredColumn{&TrialRow::trial, "trial", "", "Running number in the session, from 1"},
    StoredColumn{&TrialRow::attempt, "attempt", "", "1, or more if the trial was repeated"},
    StoredColumn{&TrialRow::sequence, "sequence"},
    StoredColumn{&TrialRow::block, "block", "", "Name of the block in the study file"},
    StoredColumn{&TrialRow::procedure, "procedure", "", "How the block asks"},
    StoredColumn{&TrialRow::medium, "medium", "", "What was rendered"},
    StoredColumn{&TrialRow::quantity, "quantity", "",
                 "What intensities mean: scale (ratio), viscosity_pa_s (Pa s) or "
                 "stiffness_n_per_m (N/m)"},
    StoredColumn{&TrialRow::repetition, "repetition", "",
                 "From 1; in each, every stimulus once"},
    StoredColumn{&TrialRow::position, "position", "", "Within the repetition, from 1"},
    StoredColumn{&TrialRow::series, "series", "",
                 "Staircase or series of the block, from 1; empty where there is one"},
    StoredColumn{
        &TrialRow::test_interval, "test_interval", "",
        "Where the order is drawn: interval of the test stimulus, 1 or 2. The interval "
        "that was chosen in a two-interval task is test_interval where response is 1, "
        "else 3 - test_interval"},
    StoredColumn{&TrialRow::intervals, "intervals", "",
                 "Of three intervals what each held, in order: r the reference, t the test; "
                 "empty otherwise"},
    StoredColumn{&TrialRow::right_interval, "right_interval", "",
                 "Of three intervals the one that is the right answer, from 1. Where the test "
                 "equals the reference none is, and it is the one that was drawn"},
    StoredColumn{
        &TrialRow::is_catch, "is_catch", "",
        "1: a catch trial, in which nothing is there or the test equals the reference"},
    StoredColumn{&TrialRow::intensity, "intensity", "unit of quantity",
                 "Test stimulus; of an adjustment the value set"},
    StoredColumn{&TrialRow::reference_intensity, "reference_intensity", "unit of quantity",
                 "Reference stimulus; of a block with a standard_medium in the unit of that "
                 "medium's quantity"},
    StoredColumn{&TrialRow::starting_intensity, "starting_intensity", "unit of quantity",
                 "Production and matching: where the adjustment began"},
    StoredColumn{&TrialRow::target_percent, "target_percent", "%",
                 "Production: what it should feel like, water being 100"},
    StoredColumn{
        &TrialRow::response, "response", "",
        "Percent, or a number in another modulus; a step of a scale; 1: yes, "
        "different, the interval "
        "of the test, or of three the right one, 0: otherwise; empty: \"cannot tell\"; of an "
        "adjustment the value set"},
    StoredPart{&TrialRow::measures},
    StoredColumn{&TrialRow::num_presentations, "num_presentations", "",
                 "Stimuli felt in this attempt"},
    StoredColumn{&TrialRow::num_steps, "num_steps", "",
                 "Production and matching: steps of adjustment"},
    StoredColumn{&TrialRow::first_tick, "first_tick", "tick",
                 "First sample of the trial in the recording"},
    StoredColumn{&TrialRow::last_tick, "last_tick", "tick",
                 "Last sample of the trial in the recording"}};

/// One answer outside of a trial.
struct AnswerRow {
  std::int64_t session = 0;
  std::int64_t sequence = 0;
  std::string stage;
  std::string item;
  std::string answer;
  /// Of its stage in the participant's list, for one stage can come several times; none before
  /// the first stage.
  std::optional<std::int64_t> stage_index{};
};
template <>
inline constexpr auto kColumns<AnswerRow> = std::tuple{
    StoredColumn{&AnswerRow::session, "session"},
    StoredColumn{&AnswerRow::sequence, "sequence"},
    StoredColumn{&AnswerRow::stage, "stage", "", "Name of the stage in the study file"},
    StoredColumn{&AnswerRow::item, "item", "", "Name of the question or point of a checklist"},
    StoredColumn{&AnswerRow::answer, "answer", "",
                 "As it was given; the last one if corrected"},
    StoredColumn{
        &AnswerRow::stage_index, "stage_index", "",
        "Place of the stage in the participant's list, from 0, by which the times of a "
        "stage that came several times are told apart; empty: before the first stage"}};

/// One answer to a question that follows the answer to a trial.
struct QuestionAnswerRow {
  std::int64_t session = 0;
  std::int64_t trial = 0;
  std::int64_t attempt = 0;
  std::int64_t sequence = 0;  ///< Sequence number of its event.
  std::string block;          ///< Name of the block's stage.
  std::string question;
  std::string answer;
};
template <>
inline constexpr auto kColumns<QuestionAnswerRow> = std::tuple{
    StoredColumn{&QuestionAnswerRow::session, "session"},
    StoredColumn{&QuestionAnswerRow::trial, "trial", "",
                 "Running number in the session, as in the table of trials"},
    StoredColumn{&QuestionAnswerRow::attempt, "attempt", "", "Attempt whose answer stands"},
    StoredColumn{&QuestionAnswerRow::sequence, "sequence"},
    StoredColumn{&QuestionAnswerRow::block, "block", "", "Name of the block in the study file"},
    StoredColumn{&QuestionAnswerRow::question, "question", "",
                 "Name of the question in the study file"},
    StoredColumn{&QuestionAnswerRow::answer, "answer", "",
                 "As it was given: a number, the step of a scale, an option, yes or no, words; "
                 "no_answer where it was left out"}};

struct SessionRow {
  std::int64_t session = 0;
  std::string participant;
  std::string protocol_sha256;
  std::uint64_t seed = 0;
  std::string cells;  ///< "priming=primed;method_order=estimation,production"
  bool pilot = false;
  bool simulated = false;
  std::string device;
  /// Hash of the device's measured profile; "" without one.
  std::string device_profile_sha256;
  std::string laboratory;  ///< Whole text of the laboratory file; "" with a person.
  std::string program_version;
  std::string realtime;  ///< "simulated", or scheduling policy and memory lock.
  double rate_hz = 0.0;
  bool recorded = true;  ///< Whether samples are kept; otherwise only summaries of strokes are.
  std::int64_t started_time_ns = 0;
};
template <>
inline constexpr auto kColumns<SessionRow> = std::tuple{
    StoredColumn{&SessionRow::session, "session", "", "Number of the session in the study"},
    StoredColumn{&SessionRow::participant, "participant", "", "Pseudonym"},
    StoredColumn{&SessionRow::simulated, "simulated", "",
                 "1: SIMULATED participant and apparatus"},
    StoredColumn{&SessionRow::cells, "cells", "",
                 "Counterbalancing: which arms in which order"},
    StoredColumn{&SessionRow::seed, "seed", "",
                 "Of everything drawn in the session; 64 bits, so read it as text"},
    StoredColumn{&SessionRow::pilot, "pilot", "", "1: a pilot, not for analysis"},
    StoredColumn{&SessionRow::device, "device", "", "Name of the device"},
    StoredColumn{&SessionRow::device_profile_sha256, "device_profile_sha256", "",
                 "Identifies what was measured of the device before, a file of "
                 "device_profiles; empty: nothing"},
    StoredColumn{&SessionRow::rate_hz, "rate_hz", "Hz",
                 "Rate of the haptic loop and of the recording"},
    StoredColumn{&SessionRow::realtime, "realtime", "",
                 "What the loop was given by the system"},
    StoredColumn{&SessionRow::recorded, "recorded", "", "1: samples are kept"},
    StoredColumn{&SessionRow::program_version, "program_version", "",
                 "Of the jnd that ran the session"},
    StoredColumn{&SessionRow::protocol_sha256, "protocol_sha256", "",
                 "Identifies the study file"},
    StoredColumn{&SessionRow::started_time_ns, "started_time_ns", "ns",
                 "Since 1970-01-01 UTC; a simulated session counts from 0"},
    StoredColumn{&SessionRow::laboratory, "laboratory", "",
                 "Who and what was simulated, as JSON; empty with a person"}};

}  // namespace jnd::core
