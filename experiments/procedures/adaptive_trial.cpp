#include "experiments/procedures/adaptive_trial.h"

#include <utility>

namespace jnd::experiments {

TrialForm adaptive_form(const Block& block) {
  return {.answer = AnswerKind::kYesNo, .has_reference = block.reference_intensity.has_value()};
}

PlannedTrial adaptive_trial(const Block& block, std::size_t num_answered, double level,
                            int series) {
  PlannedTrial trial{.position = static_cast<int>(num_answered) + 1,
                     .intensity = level,
                     .reference_intensity = block.reference_intensity};
  if (series > 0) trial.series = series;
  return trial;
}

std::vector<LevelAnswer> level_answers(const std::vector<AnsweredTrial>& answered, int series) {
  std::vector<LevelAnswer> answers;
  for (const AnsweredTrial& trial : answered) {
    if (trial.planned.is_catch || !trial.planned.intensity) continue;
    if (series > 0 && trial.planned.series != series) continue;
    answers.push_back({.level = *trial.planned.intensity, .yes = trial.response == 1.0});
  }
  return answers;
}

std::vector<BlockKey> adaptive_keys() {
  std::vector<BlockKey> keys = {task_key(), reference_key()};
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
