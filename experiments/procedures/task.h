#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/random_stream.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// How a trial asks about its test stimulus (Macmillan and Creelman 2005). It is a key of
/// blocks.
enum class Task {
  kReminder,       ///< The reference, then the test: is the test more?
  kYesNo,          ///< The test alone: is anything there?
  kTwoInterval,    ///< Reference and test in drawn order: which interval has more?
  kSameDifferent,  ///< Reference and test in drawn order, or the reference twice: different?
  kThreeInterval,  ///< The test and the reference twice in drawn order: which has more?
  kOddity,         ///< One of the two once and the other twice: which is the odd one?
  kAbx,            ///< Both in drawn order, then one of them again: which of the two was it?
  kMatchToSample,  ///< One of them, then both in drawn order: which of the two was it?
};

/// Returns the task that the block names. Without a name it is a reminder, or yes-no if there
/// is no reference.
[[nodiscard]] Task task_of(const Block& block);
[[nodiscard]] TrialForm form_of(Task task) noexcept;
/// Returns what the answers to such a question are about.
[[nodiscard]] Measure measure_of(Task task) noexcept;

/// Returns among how many intervals an answer chooses, so that one in this many answers is
/// right by guessing. Returns 0 if no interval is chosen, or if the interval with more is
/// chosen and not the right one.
[[nodiscard]] int num_choices_to_guess(Task task) noexcept;

/// Returns all orders of intervals for a task with three intervals, one letter for each
/// interval: 'r' the reference, 't' the test. Returns none for other tasks.
[[nodiscard]] std::vector<std::string> interval_orders(Task task);
/// Returns the interval, from 1, that is the right answer to these.
[[nodiscard]] int right_interval(Task task, std::string_view intervals);

/// Returns the interval that an observer chooses by these readings, which are in order and on
/// one scale. Three intervals: the largest. Oddity: the one that is not among the two closest
/// to each other. ABX and match to sample: the one closer to the third or to the first
/// (differencing rules, Macmillan and Creelman 2005, chapter 9). The margin is by how much
/// another choice would have been farther off.
struct IntervalChoice {
  int interval = 1;
  double margin = 0.0;  ///< >= 0, in the scale of the readings.
};
[[nodiscard]] IntervalChoice chosen_interval(Task task, std::span<const double> readings);

/// Returns the right response, as stored: the test is more, is there or is different from the
/// reference, or the right interval was chosen. None if two equal stimuli are compared.
[[nodiscard]] std::optional<double> right_response(Task task, const PlannedTrial& trial);

/// Returns the response that feedback calls right. There is one for equal stimuli, too, because
/// a trial without feedback would stand out. In a reminder task it is "not more", which is
/// true. Of intervals it is the one that was drawn, so that each is called right equally often.
/// Results never use it to judge an answer.
[[nodiscard]] std::optional<double> feedback_response(Task task, const PlannedTrial& trial);

/// Returns what is stored for an answer as given. An interval becomes 1 if it is the right one,
/// or of two the one with the test, and otherwise 0. Other answers are stored as they are.
[[nodiscard]] double response_of(AnswerKind kind, const PlannedTrial& trial, double answer);
/// The same; none, "cannot tell", stays none.
[[nodiscard]] std::optional<double> response_of(AnswerKind kind, const PlannedTrial& trial,
                                                const std::optional<double>& answer);
/// The inverse of `response_of`. `chosen` is the interval, if it was stored.
[[nodiscard]] double answer_of(AnswerKind kind, const PlannedTrial& trial, double response,
                               std::optional<std::int64_t> chosen = std::nullopt);

/// Turns the trial into a catch trial: in a yes-no task nothing is there, otherwise the test
/// equals the reference. The trial then belongs to no series.
void make_catch_trial(PlannedTrial& trial, Task task);

/// Returns the number of catch trials in a repetition. The default is none, or half of the
/// trials if the task is to tell same from different.
[[nodiscard]] int num_catch_trials(const Block& block);

/// Assigns the stimuli of the trial after `answered` to intervals, if their order is drawn.
/// With two intervals, a balanced order has the test first in one of every two trials. With
/// three intervals, every order comes twice in a cycle of trials, so that nobody can know the
/// next.
void draw_intervals(PlannedTrial& trial, const Block& block,
                    const std::vector<AnsweredTrial>& answered, core::RandomStream& stream);

}  // namespace jnd::experiments
