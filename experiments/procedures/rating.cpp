#include "experiments/procedures/rating.h"

#include "experiments/procedures/repetitions.h"

namespace jnd::experiments {
namespace {

BlockKey end_label_key(const char* key, const char* meaning) {
  return {.parameter = {.key = key, .kind = ValueKind::kText, .meaning = meaning}};
}

}  // namespace

std::string Rating::meaning() const {
  return "The participant puts each stimulus on a step of a scale.";
}

std::vector<BlockKey> Rating::keys() const {
  return {stimuli_key(),
          repetitions_key(),
          order_key(),
          max_returns_key(),
          {.parameter = {.key = "num_steps",
                         .kind = ValueKind::kInteger,
                         .meaning = "Steps of the scale, counted from 1. An even number has no "
                                    "middle.",
                         .required = false,
                         .default_json = "10",
                         .range = {2, 100}}},
          end_label_key("low_label", "What stands at step 1: \"very thin\"."),
          end_label_key("high_label", "What stands at the last step: \"very thick\".")};
}

std::vector<std::string> Rating::examples() const {
  return {R"json({"kind": "block", "name": "how_thick",
  "procedure": "rating", "medium": "viscous", "viscosity_pa_s": [1, 2, 4, 8, 16], "repetitions": 4,
  "num_steps": 7, "low_label": {"en": "very thin"}, "high_label": {"en": "very thick"},
  "questions": [
    {"name": "confidence", "kind": "scale", "num_steps": 5, "question": {"en": "How sure are you?"},
     "low_label": {"en": "I guessed"}, "high_label": {"en": "wholly sure"}}],
  "instruction": {"en": "Say how thick every fluid feels."},
  "question": {"en": "How thick, from 1 to 7?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"};
}

std::vector<PlannedTrial> Rating::draw_next(const Block& block,
                                            const std::vector<AnsweredTrial>& answered,
                                            core::RandomStream& stream) const {
  if (!answered.empty()) return {};
  return ordered_repetitions(block, block.repetitions, stream, [](int, double intensity) {
    return PlannedTrial{.intensity = intensity};
  });
}

int Rating::expected_trials(const Block& block) const {
  return block.repetitions * static_cast<int>(block.intensities.size());
}

int num_steps_of(const Block& block) {
  return block.settings.has("num_steps") ? block.settings.integer("num_steps") : 10;
}

}  // namespace jnd::experiments
