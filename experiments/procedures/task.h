#pragma once

#include <optional>
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
};

/// As the block names it; without a name a reminder, or yes-no where there is no reference.
[[nodiscard]] Task task_of(const Block& block);
[[nodiscard]] TrialForm form_of(Task task) noexcept;
/// What the answers to such a question are about.
[[nodiscard]] Measure measure_of(Task task) noexcept;

/// The response that is right, as stored: the test is more, is there, is different from the
/// reference. None where two stimuli are compared that are equal.
[[nodiscard]] std::optional<double> right_response(Task task, const PlannedTrial& trial);

/// The response that feedback calls right. Where two equal stimuli are compared there has to be
/// one, too, for a trial without feedback would be told from the others: "not more", which is
/// true, in a reminder task; of two intervals the one that was drawn for the test, so that
/// either answer is called right as often as wrong. No result judges an answer by it.
[[nodiscard]] std::optional<double> feedback_response(Task task, const PlannedTrial& trial);

/// What is stored for an answer as it was given, and back: an interval, 1 or 2, becomes 1 where
/// it holds the test and else 0. Other answers are stored as they are.
[[nodiscard]] double response_of(AnswerKind kind, const PlannedTrial& trial, double answer);
[[nodiscard]] double answer_of(AnswerKind kind, const PlannedTrial& trial, double response);

/// The trial turned into a catch trial: in a yes-no task nothing is there, otherwise the test
/// equals the reference. It is of no series.
void make_catch_trial(PlannedTrial& trial, Task task);

/// In a repetition; by default none, or half of its trials where the same is told from the
/// different.
[[nodiscard]] int num_catch_trials(const Block& block);

/// The interval of the test in the trial after `answered`; none where the order is fixed, which
/// draws nothing. A balanced order has, of every two trials, the test first in one.
[[nodiscard]] std::optional<int> next_test_interval(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream);

}  // namespace jnd::experiments
