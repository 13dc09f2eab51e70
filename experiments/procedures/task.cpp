#include "experiments/procedures/task.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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
  if (name == "three_interval") return Task::kThreeInterval;
  if (name == "oddity") return Task::kOddity;
  if (name == "abx") return Task::kAbx;
  if (name == "match_to_sample") return Task::kMatchToSample;
  throw core::Error(
      "task: expected reminder, yes_no, two_interval, same_different, three_interval, oddity, "
      "abx or match_to_sample, found " +
      name);
}

TrialForm form_of(Task task) noexcept {
  const bool has_three = num_choices_to_guess(task) > 0;
  TrialForm form{
      .answer =
          has_three || task == Task::kTwoInterval ? AnswerKind::kInterval : AnswerKind::kYesNo,
      .has_reference = task != Task::kYesNo,
      .order_is_drawn = has_three || task == Task::kTwoInterval || task == Task::kSameDifferent,
  };
  if (!has_three) return form;
  form.num_intervals = 3;
  form.first_choice = task == Task::kMatchToSample ? 2 : 1;
  form.num_choices = num_choices_to_guess(task);
  return form;
}

int num_choices_to_guess(Task task) noexcept {
  if (task == Task::kThreeInterval || task == Task::kOddity) return 3;
  return task == Task::kAbx || task == Task::kMatchToSample ? 2 : 0;
}

std::vector<std::string> interval_orders(Task task) {
  switch (task) {
    case Task::kThreeInterval:
      return {"trr", "rtr", "rrt"};
    case Task::kOddity:
      return {"trr", "rtr", "rrt", "rtt", "trt", "ttr"};
    case Task::kAbx:
      return {"rtr", "rtt", "trr", "trt"};
    case Task::kMatchToSample:
      return {"rrt", "rtr", "trt", "ttr"};
    case Task::kReminder:
    case Task::kYesNo:
    case Task::kTwoInterval:
    case Task::kSameDifferent:
      break;
  }
  return {};
}

int right_interval(Task task, std::string_view intervals) {
  if (intervals.size() != 3) {
    throw core::Error("intervals: expected three letters, found " + std::string(intervals));
  }
  if (task == Task::kAbx) return intervals[0] == intervals[2] ? 1 : 2;
  if (task == Task::kMatchToSample) return intervals[1] == intervals[0] ? 2 : 3;
  if (intervals[0] != intervals[1]) return intervals[1] == intervals[2] ? 1 : 2;
  return 3;
}

IntervalChoice chosen_interval(Task task, std::span<const double> readings) {
  const auto distance = [&](std::size_t a, std::size_t b) {
    return std::abs(readings[a] - readings[b]);
  };
  if (task == Task::kThreeInterval) {
    std::vector<double> ascending(readings.begin(), readings.end());
    std::ranges::sort(ascending);
    const auto largest = std::ranges::max_element(readings);
    return {static_cast<int>(largest - readings.begin()) + 1, ascending[2] - ascending[1]};
  }
  if (task == Task::kOddity) {
    // For each interval, the distance between the other two.
    const double others[] = {distance(1, 2), distance(0, 2), distance(0, 1)};
    const auto* const odd = std::ranges::min_element(others);
    double next = std::numeric_limits<double>::infinity();
    for (const double& one : others) {
      if (&one != odd) next = std::min(next, one);
    }
    return {static_cast<int>(odd - std::begin(others)) + 1, next - *odd};
  }
  const bool samples_first = task == Task::kMatchToSample;
  const double to_left = samples_first ? distance(0, 1) : distance(0, 2);
  const double to_right = samples_first ? distance(0, 2) : distance(1, 2);
  const int left = samples_first ? 2 : 1;
  return {to_left <= to_right ? left : left + 1, std::abs(to_left - to_right)};
}

Measure measure_of(Task task) noexcept {
  if (num_choices_to_guess(task) > 0) return Measure::kIdentification;
  if (task == Task::kYesNo) return Measure::kDetection;
  return task == Task::kSameDifferent ? Measure::kDifference : Measure::kComparison;
}

std::optional<double> right_response(Task task, const PlannedTrial& trial) {
  if (task == Task::kYesNo) return trial.is_catch ? 0.0 : 1.0;
  if (!trial.intensity || !trial.reference_intensity) return std::nullopt;
  const double excess = *trial.intensity - *trial.reference_intensity;
  if (task == Task::kSameDifferent) return excess == 0.0 ? 0.0 : 1.0;
  if (excess == 0.0) return std::nullopt;
  if (num_choices_to_guess(task) > 0) return 1.0;
  return excess > 0.0 ? 1.0 : 0.0;
}

std::optional<double> feedback_response(Task task, const PlannedTrial& trial) {
  const std::optional<double> right = right_response(task, trial);
  if (right || !trial.intensity || !trial.reference_intensity) return right;
  return task == Task::kTwoInterval || num_choices_to_guess(task) > 0 ? 1.0 : 0.0;
}

double response_of(AnswerKind kind, const PlannedTrial& trial, double answer) {
  if (kind != AnswerKind::kInterval) return answer;
  const int right = trial.right_interval.value_or(trial.test_interval.value_or(2));
  return answer == right ? 1.0 : 0.0;
}

std::optional<double> response_of(AnswerKind kind, const PlannedTrial& trial,
                                  const std::optional<double>& answer) {
  return answer ? std::optional(response_of(kind, trial, *answer)) : std::nullopt;
}

double answer_of(AnswerKind kind, const PlannedTrial& trial, double response,
                 std::optional<std::int64_t> chosen) {
  if (kind != AnswerKind::kInterval) return response;
  if (chosen) return static_cast<double>(*chosen);
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

void draw_intervals(PlannedTrial& trial, const Block& block,
                    const std::vector<AnsweredTrial>& answered, core::RandomStream& stream) {
  const Task task = task_of(block);
  if (!form_of(task).order_is_drawn) return;
  std::vector<std::string> left = interval_orders(task);
  if (left.empty()) {
    const bool completes_pair =
        block.settings.word("interval_order") == "balanced" && answered.size() % 2 == 1;
    trial.test_interval = completes_pair ? 3 - answered.back().planned.test_interval.value_or(1)
                                         : (stream.with_probability(0.5) ? 1 : 2);
    return;
  }
  const std::vector<std::string> once = left;
  left.insert(left.end(), once.begin(), once.end());
  const std::size_t num_done = answered.size() % left.size();
  for (std::size_t i = answered.size() - num_done; i < answered.size(); ++i) {
    const auto same = std::ranges::find(left, answered[i].planned.intervals);
    if (same != left.end()) left.erase(same);
  }
  trial.intervals = left[stream.below(left.size())];
  trial.right_interval = right_interval(task, trial.intervals);
}

}  // namespace jnd::experiments
