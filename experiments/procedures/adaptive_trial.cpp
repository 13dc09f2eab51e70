#include "experiments/procedures/adaptive_trial.h"

#include <cmath>
#include <utility>

namespace jnd::experiments {

PlannedTrial adaptive_trial(const Block& block, const std::vector<AnsweredTrial>& answered,
                            double level, int series, core::RandomStream& stream) {
  PlannedTrial trial{.position = static_cast<int>(answered.size()) + 1,
                     .intensity = level,
                     .reference_intensity = block.reference_intensity};
  if (series > 0) trial.series = series;
  const double catch_probability = block.settings.number("catch_probability", 0.0);
  if (catch_probability > 0.0 && stream.with_probability(catch_probability)) {
    make_catch_trial(trial, task_of(block));
  }
  draw_intervals(trial, block, answered, stream);
  return trial;
}

int with_catch_trials(const Block& block, int num_trials) noexcept {
  const double share = 1.0 - block.settings.number("catch_probability", 0.0);
  return static_cast<int>(std::lround(num_trials / share));
}

std::vector<LevelAnswer> level_answers(const std::vector<AnsweredTrial>& answered, int series) {
  std::vector<LevelAnswer> answers;
  for (const AnsweredTrial& trial : answered) {
    if (trial.planned.is_catch || !trial.planned.intensity || !trial.response) continue;
    if (series > 0 && trial.planned.series != series) continue;
    answers.push_back({.level = *trial.planned.intensity, .yes = trial.response == 1.0});
  }
  return answers;
}

std::vector<BlockKey> adaptive_keys() {
  std::vector<BlockKey> keys = {task_key(), reference_key(), interval_order_key(),
                                catch_probability_key()};
  for (BlockKey& key : right_answer_keys()) keys.push_back(std::move(key));
  keys.push_back(max_returns_key());
  for (BlockKey& label : answer_label_keys()) keys.push_back(std::move(label));
  return keys;
}

BlockKey scale_key() {
  return {.parameter = {.key = "level_scale",
                        .kind = ValueKind::kString,
                        .meaning = "In which scale steps and means are taken: equal ratios, or "
                                   "equal differences.",
                        .required = false,
                        .default_json = R"("logarithmic")",
                        .allowed = {"logarithmic", "linear"}}};
}

}  // namespace jnd::experiments
