#include "experiments/procedures/magnitude_production.h"

#include "experiments/procedures/repetitions.h"

namespace jnd::experiments {

std::string MagnitudeProduction::meaning() const {
  return "The participant adjusts a stimulus until it feels like a target in percent.";
}

std::vector<BlockKey> MagnitudeProduction::keys() const {
  std::vector<BlockKey> keys = {stimuli_key()};
  for (BlockKey& step : step_keys()) keys.push_back(std::move(step));
  keys.push_back({.parameter = {.key = "target_percent",
                                .kind = ValueKind::kNumbers,
                                .meaning = "What the stimulus should feel like, one "
                                           "repetition for each.",
                                .unit = "%",
                                .range = {0.0, 10000.0, true},
                                .max_items = 100}});
  keys.push_back(order_key());
  return keys;
}

std::vector<std::string> MagnitudeProduction::examples() const {
  return {R"json({"kind": "block", "name": "make_it_half",
  "procedure": "magnitude_production", "medium": "water", "scale": [0, 4], "target_percent": [50, 100, 200],
  "coarse_step_scale": 0.5, "fine_step_scale": 0.1, "max_scale": 8,
  "instruction": {"en": "Say stronger or weaker until it feels like the percentage you are told."},
  "question": {"en": "Is this the percentage you were told?"},
  "free_space_between_s": 2, "expected_trial_s": 30})json"};
}

TrialForm MagnitudeProduction::form(const Block&) const {
  return {.answer = AnswerKind::kMatch, .adjustable = true};
}

std::vector<PlannedTrial> MagnitudeProduction::draw_next(
    const Block& block, const std::vector<AnsweredTrial>& answered,
    core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  const int num_targets = static_cast<int>(block.target_percent.size());
  return ordered_repetitions(
      block, num_targets * block.repetitions, stream, [&](int repetition, double start) {
        return PlannedTrial{
            .starting_intensity = start,
            .target_percent = block.target_percent[(repetition - 1) % num_targets]};
      });
}

int MagnitudeProduction::expected_trials(const Block& block) const {
  return block.repetitions *
         static_cast<int>(block.target_percent.size() * block.intensities.size());
}

}  // namespace jnd::experiments
