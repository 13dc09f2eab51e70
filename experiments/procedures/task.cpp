#include "experiments/procedures/task.h"

#include <string>

#include "core/error.h"

namespace jnd::experiments {

Task task_of(const Block& block) {
  if (!block.settings.has("task")) {
    return block.reference_intensity ? Task::kReminder : Task::kYesNo;
  }
  const std::string& name = block.settings.word("task");
  if (name == "reminder") return Task::kReminder;
  if (name == "yes_no") return Task::kYesNo;
  if (name == "two_interval") return Task::kTwoInterval;
  if (name == "same_different") return Task::kSameDifferent;
  throw core::Error("task: expected reminder, yes_no, two_interval or same_different, found " +
                    name);
}

TrialForm form_of(Task task) noexcept {
  return {
      .answer = task == Task::kTwoInterval ? AnswerKind::kInterval : AnswerKind::kYesNo,
      .has_reference = task != Task::kYesNo,
      .order_is_drawn = task == Task::kTwoInterval || task == Task::kSameDifferent,
  };
}

Measure measure_of(Task task) noexcept {
  if (task == Task::kYesNo) return Measure::kDetection;
  return task == Task::kSameDifferent ? Measure::kDifference : Measure::kComparison;
}

std::optional<double> right_response(Task task, const PlannedTrial& trial) {
  if (task == Task::kYesNo) return trial.is_catch ? 0.0 : 1.0;
  if (!trial.intensity || !trial.reference_intensity) return std::nullopt;
  const double excess = *trial.intensity - *trial.reference_intensity;
  if (task == Task::kSameDifferent) return excess == 0.0 ? 0.0 : 1.0;
  if (excess == 0.0) return std::nullopt;
  return excess > 0.0 ? 1.0 : 0.0;
}

std::optional<double> feedback_response(Task task, const PlannedTrial& trial) {
  const std::optional<double> right = right_response(task, trial);
  if (right || !trial.intensity || !trial.reference_intensity) return right;
  return task == Task::kTwoInterval ? 1.0 : 0.0;
}

double response_of(AnswerKind kind, const PlannedTrial& trial, double answer) {
  if (kind != AnswerKind::kInterval) return answer;
  return answer == trial.test_interval.value_or(2) ? 1.0 : 0.0;
}

double answer_of(AnswerKind kind, const PlannedTrial& trial, double response) {
  if (kind != AnswerKind::kInterval) return response;
  const int test = trial.test_interval.value_or(2);
  return response == 1.0 ? test : 3 - test;
}

void make_catch_trial(PlannedTrial& trial, Task task) {
  trial.is_catch = true;
  trial.intensity = task == Task::kYesNo ? 0.0 : trial.reference_intensity;
  trial.series.reset();
}

int num_catch_trials(const Block& block) {
  const bool half = task_of(block) == Task::kSameDifferent;
  const double otherwise = half ? static_cast<double>(block.intensities.size()) : 0.0;
  return static_cast<int>(block.settings.number("catch_trials", otherwise));
}

std::optional<int> next_test_interval(const Block& block,
                                      const std::vector<AnsweredTrial>& answered,
                                      core::RandomStream& stream) {
  if (!form_of(task_of(block)).order_is_drawn) return std::nullopt;
  const bool completes_pair =
      block.settings.word("interval_order") == "balanced" && answered.size() % 2 == 1;
  if (completes_pair) return 3 - answered.back().planned.test_interval.value_or(1);
  return stream.with_probability(0.5) ? 1 : 2;
}

}  // namespace jnd::experiments
