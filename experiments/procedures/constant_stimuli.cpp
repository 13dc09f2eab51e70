#include "experiments/procedures/constant_stimuli.h"

#include <algorithm>
#include <map>

#include "experiments/procedures/repetitions.h"
#include "experiments/procedures/task.h"

namespace jnd::experiments {
namespace {

PlannedTrial test_trial(const Block& block, double intensity) {
  return {.intensity = intensity, .reference_intensity = block.reference_intensity};
}

PlannedTrial catch_trial(const Block& block) {
  PlannedTrial trial{.reference_intensity = block.reference_intensity};
  make_catch_trial(trial, task_of(block));
  return trial;
}

/// Inserts the catch trials of every repetition at random places of it.
std::vector<PlannedTrial> with_catch_trials(const Block& block, std::vector<PlannedTrial> tests,
                                            core::RandomStream& stream) {
  const int num_catch = num_catch_trials(block);
  if (num_catch == 0) return tests;
  std::vector<PlannedTrial> trials;
  for (auto begin = tests.begin(); begin != tests.end();) {
    const int repetition = begin->repetition;
    const auto end = std::find_if(begin, tests.end(), [&](const PlannedTrial& trial) {
      return trial.repetition != repetition;
    });
    std::vector<PlannedTrial> one(begin, end);
    for (int i = 0; i < num_catch; ++i) {
      const auto place = static_cast<std::ptrdiff_t>(stream.below(one.size() + 1));
      one.insert(one.begin() + place, catch_trial(block));
    }
    for (std::size_t i = 0; i < one.size(); ++i) {
      one[i].repetition = repetition;
      one[i].position = static_cast<int>(i) + 1;
    }
    trials.insert(trials.end(), one.begin(), one.end());
    begin = end;
  }
  return trials;
}

/// Draws orders so that every stimulus, and the catch trials, have each order of three
/// intervals equally often, or once more.
void draw_interval_orders(Task task, std::vector<PlannedTrial>& trials,
                          core::RandomStream& stream) {
  std::map<std::pair<bool, double>, std::vector<PlannedTrial*>> by_stimulus;
  for (PlannedTrial& trial : trials) {
    by_stimulus[{trial.is_catch, trial.intensity.value_or(0.0)}].push_back(&trial);
  }
  for (auto& [stimulus, same] : by_stimulus) {
    stream.shuffle(same);
    std::vector<std::string> orders = interval_orders(task);
    stream.shuffle(orders);
    for (std::size_t i = 0; i < same.size(); ++i) {
      same[i]->intervals = orders[i % orders.size()];
      same[i]->right_interval = right_interval(task, same[i]->intervals);
    }
  }
}

/// With a balanced order, every stimulus, and the catch trials, have the test first as often as
/// second.
void draw_test_intervals(const Block& block, std::vector<PlannedTrial>& trials,
                         core::RandomStream& stream) {
  const Task task = task_of(block);
  if (!form_of(task).order_is_drawn) return;
  if (num_choices_to_guess(task) > 0) return draw_interval_orders(task, trials, stream);
  if (block.settings.word("interval_order") != "balanced") {
    for (PlannedTrial& trial : trials)
      trial.test_interval = stream.with_probability(0.5) ? 1 : 2;
    return;
  }
  std::map<std::pair<bool, double>, std::vector<PlannedTrial*>> by_stimulus;
  for (PlannedTrial& trial : trials) {
    by_stimulus[{trial.is_catch, trial.intensity.value_or(0.0)}].push_back(&trial);
  }
  for (auto& [stimulus, same] : by_stimulus) {
    stream.shuffle(same);
    int interval = stream.with_probability(0.5) ? 1 : 2;
    for (PlannedTrial* trial : same) {
      trial->test_interval = interval;
      interval = 3 - interval;
    }
  }
}

/// Draws one trial of those that the repetition under way still needs, because it is unknown
/// which trial of a practice will be the last.
std::vector<PlannedTrial> practice_trial(const Block& block,
                                         const std::vector<AnsweredTrial>& answered,
                                         core::RandomStream& stream) {
  std::vector<PlannedTrial> left;
  for (const double intensity : block.intensities) left.push_back(test_trial(block, intensity));
  left.insert(left.end(), static_cast<std::size_t>(num_catch_trials(block)),
              catch_trial(block));
  const std::size_t num_done = answered.size() % left.size();
  const auto repetition = static_cast<int>(answered.size() / left.size()) + 1;
  if (repetition > block.repetitions) return {};
  for (auto done = answered.end() - static_cast<std::ptrdiff_t>(num_done);
       done != answered.end(); ++done) {
    const auto same = std::ranges::find_if(left, [&](const PlannedTrial& trial) {
      return trial.is_catch == done->planned.is_catch &&
             trial.intensity == done->planned.intensity;
    });
    if (same != left.end()) left.erase(same);
  }
  PlannedTrial next = left[stream.below(left.size())];
  next.repetition = repetition;
  next.position = static_cast<int>(num_done) + 1;
  draw_intervals(next, block, answered, stream);
  return {next};
}

}  // namespace

std::string ConstantStimuli::meaning() const {
  return "A fixed set of test stimuli in random order, each with a question that has two "
         "answers.";
}

std::vector<BlockKey> ConstantStimuli::keys() const {
  std::vector<BlockKey> keys = {stimuli_key(),        task_key(),         reference_key(),
                                interval_order_key(), catch_trials_key(), repetitions_key(),
                                order_key()};
  for (BlockKey& key : right_answer_keys()) keys.push_back(std::move(key));
  keys.push_back(cannot_tell_key());
  keys.push_back(max_returns_key());
  for (BlockKey& label : answer_label_keys()) keys.push_back(std::move(label));
  return keys;
}

std::vector<std::string> ConstantStimuli::examples() const {
  return {R"json({"kind": "block", "name": "thick_fluids",
  "procedure": "constant_stimuli", "medium": "viscous",
  "viscosity_pa_s": [10, 12, 14, 18, 20, 24], "reference_viscosity_pa_s": 16, "repetitions": 5,
  "instruction": {"en": "First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json",
          R"json({"kind": "block", "name": "which_is_thicker",
  "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval", "interval_order": "balanced",
  "viscosity_pa_s": [10, 12, 14, 18, 20, 24], "reference_viscosity_pa_s": 16, "repetitions": 10,
  "instruction": {"en": "Two fluids follow each other."},
  "question": {"en": "Which one was thicker?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json",
          R"json({"kind": "block", "name": "in_good_time",
  "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval",
  "viscosity_pa_s": [10, 12, 14, 18, 20, 24], "reference_viscosity_pa_s": 16, "repetitions": 10,
  "cannot_tell": true, "max_returns": 0,
  "min_stimulus_s": 4, "max_stimulus_s": 4, "answer_deadline_s": 7,
  "instruction": {"en": "Two fluids follow each other, each once. Answer soon, or say that you cannot tell."},
  "question": {"en": "Which one was thicker?"},
  "free_space_between_s": 2, "expected_trial_s": 12})json",
          R"json({"kind": "block", "name": "same_or_not",
  "procedure": "constant_stimuli", "medium": "viscous", "task": "same_different", "catch_trials": 4,
  "viscosity_pa_s": [9, 10, 12, 15], "reference_viscosity_pa_s": 8, "repetitions": 10,
  "instruction": {"en": "Two fluids follow each other, or one twice."},
  "question": {"en": "Were they different?"},
  "yes_label": {"en": "Different"}, "no_label": {"en": "The same"},
  "free_space_between_s": 2, "expected_trial_s": 15})json",
          R"json({"kind": "block", "name": "practice",
  "procedure": "constant_stimuli", "medium": "viscous", "feedback": true,
  "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 20,
  "practice": {"min_correct_ratio": 0.8, "num_trials_judged": 10, "max_trials": 40},
  "instruction": {"en": "Let us practise. First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"};
}

TrialForm ConstantStimuli::form(const Block& block) const { return form_of(task_of(block)); }

Measure ConstantStimuli::measures(const Block& block) const {
  return measure_of(task_of(block));
}

std::optional<double> ConstantStimuli::right_response(const Block& block,
                                                      const PlannedTrial& trial) const {
  return experiments::right_response(task_of(block), trial);
}

std::optional<double> ConstantStimuli::feedback_response(const Block& block,
                                                         const PlannedTrial& trial) const {
  return experiments::feedback_response(task_of(block), trial);
}

std::vector<PlannedTrial> ConstantStimuli::draw_next(const Block& block,
                                                     const std::vector<AnsweredTrial>& answered,
                                                     core::RandomStream& stream) const {
  if (block.practice) return practice_trial(block, answered, stream);
  if (!answered.empty()) return {};
  std::vector<PlannedTrial> trials = with_catch_trials(
      block,
      ordered_repetitions(block, block.repetitions, stream,
                          [&](int, double intensity) { return test_trial(block, intensity); }),
      stream);
  draw_test_intervals(block, trials, stream);
  return trials;
}

int ConstantStimuli::expected_trials(const Block& block) const {
  return block.repetitions *
         (static_cast<int>(block.intensities.size()) + num_catch_trials(block));
}

}  // namespace jnd::experiments
