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
      {"constant_stimuli", block_table().example},
      {"constant_stimuli", R"json({"kind": "block", "name": "which_is_thicker",
  "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval", "interval_order": "balanced",
  "viscosity_pa_s": [10, 12, 14, 18, 20, 24], "reference_viscosity_pa_s": 16, "repetitions": 10,
  "instruction": {"en": "Two fluids follow each other."},
  "question": {"en": "Which one was thicker?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"},
      {"constant_stimuli", R"json({"kind": "block", "name": "same_or_not",
  "procedure": "constant_stimuli", "medium": "viscous", "task": "same_different", "catch_trials": 4,
  "viscosity_pa_s": [9, 10, 12, 15], "reference_viscosity_pa_s": 8, "repetitions": 10,
  "instruction": {"en": "Two fluids follow each other, or one twice."},
  "question": {"en": "Were they different?"},
  "yes_label": {"en": "Different"}, "no_label": {"en": "The same"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"},
      {"constant_stimuli", R"json({"kind": "block", "name": "practice",
  "procedure": "constant_stimuli", "medium": "viscous", "feedback": true,
  "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 20,
  "practice": {"min_correct_ratio": 0.8, "num_trials_judged": 10, "max_trials": 40},
  "instruction": {"en": "Let us practise. First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"},
      {"limits", R"json({"kind": "block", "name": "least_viscosity",
  "procedure": "limits", "medium": "viscous", "task": "yes_no",
  "viscosity_pa_s": [0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2, 3], "num_series": 8, "catch_probability": 0.1,
  "instruction": {"en": "Tell whenever you feel anything in the way of your hand."},
  "question": {"en": "Is there anything?"},
  "free_space_between_s": 2, "expected_trial_s": 8})json"},
      {"staircase", R"json({"kind": "block", "name": "up_and_down",
  "procedure": "staircase", "medium": "viscous", "reference_viscosity_pa_s": 8,
  "start_viscosity_pa_s": [16, 4], "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 30,
  "step_ratio": [1.5, 1.25, 1.1], "num_down": 2, "max_reversals": 10,
  "instruction": {"en": "First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"},
      {"quest_plus", R"json({"kind": "block", "name": "most_telling",
  "procedure": "quest_plus", "medium": "viscous",
  "viscosity_pa_s": [3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 18, 24], "reference_viscosity_pa_s": 8,
  "pse_viscosity_pa_s": [4, 16], "weber_fraction": [0.05, 2], "max_trials": 40,
  "instruction": {"en": "First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"}};
  return kExamples;
}

}  // namespace jnd::experiments
