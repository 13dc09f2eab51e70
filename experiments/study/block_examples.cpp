#include "experiments/study/block_examples.h"

#include "experiments/study/stage_tables.h"

namespace jnd::experiments {

const std::vector<BlockExample>& block_examples() {
  static const std::vector<BlockExample> kExamples = {
      {"magnitude_estimation", R"json({"kind": "block", "name": "how_strong",
  "procedure": "magnitude_estimation", "medium": "water", "scale": [0, 0.5, 1, 2, 4], "repetitions": 3,
  "instruction": {"en": "Real water is 100 percent, free space is 0."},
  "question": {"en": "How strong, in percent of water?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"},
      {"magnitude_production", R"json({"kind": "block", "name": "make_it_half",
  "procedure": "magnitude_production", "medium": "water", "scale": [0, 4], "target_percent": [50, 100, 200],
  "coarse_step_scale": 0.5, "fine_step_scale": 0.1, "max_scale": 8,
  "instruction": {"en": "Say stronger or weaker until it feels like the percentage you are told."},
  "question": {"en": "Is this the percentage you were told?"},
  "free_space_between_s": 2, "expected_trial_s": 30})json"},
      {"constant_stimuli", block_table().example}};
  return kExamples;
}

}  // namespace jnd::experiments
