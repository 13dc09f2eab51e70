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

/// How a trial asks about its test stimulus (Macmillan and Creelman 2005). A key of blocks.
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

/// As the block names it; without a name a reminder, or yes-no where there is no reference.
[[nodiscard]] Task task_of(const Block& block);
[[nodiscard]] TrialForm form_of(Task task) noexcept;
/// What the answers to such a question are about.
[[nodiscard]] Measure measure_of(Task task) noexcept;

/// Among how many intervals an answer chooses, so that the share of right answers is one in so
/// many where nothing is felt; 0 where no interval is chosen, or more is chosen and not right.
[[nodiscard]] int num_choices_to_guess(Task task) noexcept;

/// What the intervals of a trial may hold, a letter each: 'r' the reference, 't' the test; all
/// orders of tasks with three intervals, none of others.
[[nodiscard]] std::vector<std::string> interval_orders(Task task);
/// The interval, from 1, that is the right answer to these.
[[nodiscard]] int right_interval(Task task, std::string_view intervals);

/// The interval that an observer chooses who felt them so, as readings of one scale in their
/// order: three intervals, the largest; oddity, the one that is not of the two which lie
/// closest together; ABX and match to sample, the one that lies closer to the third or to the
/// first (differencing rules, Macmillan and Creelman 2005, chapter 9). Also by how much another
/// choice would have been farther off.
struct IntervalChoice {
  int interval = 1;
  double margin = 0.0;  ///< >= 0, in the scale of the readings.
};
[[nodiscard]] IntervalChoice chosen_interval(Task task, std::span<const double> readings);

/// The response that is right, as stored: the test is more, is there, is different from the
/// reference, the right interval was chosen. None where two stimuli are compared that are
/// equal.
[[nodiscard]] std::optional<double> right_response(Task task, const PlannedTrial& trial);

/// The response that feedback calls right. Where equal stimuli are compared there has to be
/// one, too, for a trial without feedback would be told from the others: "not more", which is
/// true, in a reminder task; of intervals the one that was drawn for the answer, so that
/// each is called right equally often. No result judges an answer by it.
[[nodiscard]] std::optional<double> feedback_response(Task task, const PlannedTrial& trial);

/// What is stored for an answer as it was given: an interval becomes 1 where it is the right
/// one, or of two the one that holds the test, and else 0. Other answers are stored as they
/// are.
[[nodiscard]] double response_of(AnswerKind kind, const PlannedTrial& trial, double answer);
/// The same; none, "cannot tell", stays none.
[[nodiscard]] std::optional<double> response_of(AnswerKind kind, const PlannedTrial& trial,
                                                const std::optional<double>& answer);
/// And back. `chosen`: the interval, where it was stored.
[[nodiscard]] double answer_of(AnswerKind kind, const PlannedTrial& trial, double response,
                               std::optional<std::int64_t> chosen = std::nullopt);

/// The trial turned into a catch trial: in a yes-no task nothing is there, otherwise the test
/// equals the reference. It is of no series.
void make_catch_trial(PlannedTrial& trial, Task task);

/// In a repetition; by default none, or half of its trials where the same is told from the
/// different.
[[nodiscard]] int num_catch_trials(const Block& block);

/// Puts the stimuli of the trial after `answered` into intervals, where their order is drawn.
/// Of two, a balanced order has, of every two trials, the test first in one. Of three every
/// order comes twice in as many trials as that makes, so that nobody can know the next.
void draw_intervals(PlannedTrial& trial, const Block& block,
                    const std::vector<AnsweredTrial>& answered, core::RandomStream& stream);

}  // namespace jnd::experiments
