#pragma once

#include <string>

namespace jnd::app {

/// A study of two blocks. The first block has a deadline, stimuli with times, and the answer
/// "cannot tell". In the second block there is no way back, and the answers decide what comes
/// next.
inline const std::string kAnsweringStudy = R"json({
  "format": 1,
  "name": "answering",
  "languages": ["en"],
  "title": {"en": "Answering"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "open", "procedure": "constant_stimuli", "medium": "viscous",
     "viscosity_pa_s": [7, 9, 10], "reference_viscosity_pa_s": 8, "repetitions": 2,
     "cannot_tell": true, "answer_deadline_s": 3, "min_stimulus_s": 1, "max_stimulus_s": 2,
     "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
     "expected_trial_s": 5},
    {"kind": "block", "name": "stairs", "procedure": "staircase", "task": "two_interval",
     "medium": "viscous", "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16],
     "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.5, 1.2],
     "max_reversals": 2, "num_reversals_averaged": 2, "max_trials": 4, "max_returns": 0,
     "instruction": {"en": "Compare."}, "question": {"en": "Which was thicker?"},
     "expected_trial_s": 5}
  ]
})json";

}  // namespace jnd::app
