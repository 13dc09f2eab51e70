#include "experiments/procedures/matching.h"

namespace jnd::experiments {

std::string Matching::meaning() const {
  return "The participant adjusts a stimulus until it feels like a standard, which may be of "
         "another medium.";
}

std::vector<BlockKey> Matching::keys() const {
  std::vector<BlockKey> keys = {stimuli_key()};
  for (BlockKey& standard : standard_keys()) keys.push_back(std::move(standard));
  for (BlockKey& step : step_keys()) keys.push_back(std::move(step));
  keys.push_back(repetitions_key());
  return keys;
}

std::vector<std::string> Matching::examples() const {
  return {R"json({"kind": "block", "name": "as_thick_as_water",
  "procedure": "matching", "medium": "viscous", "viscosity_pa_s": [0.2, 5],
  "standard_medium": "water", "standard_scale": [1, 2, 4], "repetitions": 3,
  "coarse_step_viscosity_pa_s": 0.5, "fine_step_viscosity_pa_s": 0.1, "max_viscosity_pa_s": 20,
  "instruction": {"en": "Say thicker or thinner until it feels like the reference. You may go back and forth."},
  "question": {"en": "Does it feel like the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 45})json"};
}

TrialForm Matching::form(const Block&) const {
  return {.answer = AnswerKind::kMatch, .has_reference = true, .adjustable = true};
}

std::vector<PlannedTrial> Matching::draw_next(const Block& block,
                                              const std::vector<AnsweredTrial>& answered,
                                              core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  std::vector<PlannedTrial> trials;
  for (int repetition = 1; repetition <= block.repetitions; ++repetition) {
    std::vector<PlannedTrial> pairs;
    for (const double standard : block.standards) {
      for (const double start : block.intensities) {
        pairs.push_back({.repetition = repetition,
                         .reference_intensity = standard,
                         .starting_intensity = start});
      }
    }
    stream.shuffle(pairs);
    int position = 0;
    for (PlannedTrial& pair : pairs) pair.position = ++position;
    trials.insert(trials.end(), pairs.begin(), pairs.end());
  }
  return trials;
}

int Matching::expected_trials(const Block& block) const {
  return block.repetitions *
         static_cast<int>(block.standards.size() * block.intensities.size());
}

}  // namespace jnd::experiments
