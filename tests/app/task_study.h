#pragma once

#include <string>

namespace jnd::app {

/// A study with blocks of several tasks, some with catch trials, and a practice block with
/// feedback.
inline const std::string kTaskStudy = R"json({
  "format": 1,
  "name": "tasks",
  "languages": ["en", "de"],
  "title": {"en": "Tasks", "de": "Aufgaben"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "practice", "procedure": "constant_stimuli",
     "medium": "viscous", "viscosity_pa_s": [2, 24], "reference_viscosity_pa_s": 8,
     "repetitions": 10, "feedback": true,
     "practice": {"min_correct_ratio": 0.75, "num_trials_judged": 4, "max_trials": 12},
     "instruction": {"en": "Practise.", "de": "Übe."},
     "question": {"en": "Thicker?", "de": "Dicker?"}, "expected_trial_s": 5},
    {"kind": "block", "name": "which", "procedure": "constant_stimuli", "task": "two_interval",
     "interval_order": "balanced", "medium": "viscous", "viscosity_pa_s": [4, 16],
     "reference_viscosity_pa_s": 8, "repetitions": 2, "catch_trials": 1,
     "first_label": {"en": "First", "de": "Erste"},
     "second_label": {"en": "Second", "de": "Zweite"},
     "instruction": {"en": "Compare.", "de": "Vergleiche."},
     "question": {"en": "Which was thicker?", "de": "Welche war dicker?"},
     "expected_trial_s": 5},
    {"kind": "block", "name": "same", "procedure": "constant_stimuli",
     "task": "same_different", "medium": "viscous", "viscosity_pa_s": [12, 16],
     "reference_viscosity_pa_s": 8, "repetitions": 2,
     "instruction": {"en": "Compare.", "de": "Vergleiche."},
     "question": {"en": "Different?", "de": "Verschieden?"}, "expected_trial_s": 5},
    {"kind": "block", "name": "there", "procedure": "constant_stimuli", "task": "yes_no",
     "medium": "viscous", "viscosity_pa_s": [0.5, 2], "repetitions": 2, "catch_trials": 1,
     "instruction": {"en": "Feel.", "de": "Fühle."},
     "question": {"en": "Anything?", "de": "Etwas?"}, "expected_trial_s": 5},
    {"kind": "block", "name": "stairs", "procedure": "staircase", "task": "two_interval",
     "medium": "viscous", "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16],
     "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.5, 1.2],
     "max_reversals": 2, "num_reversals_averaged": 2, "max_trials": 8,
     "catch_probability": 0.2,
     "instruction": {"en": "Compare.", "de": "Vergleiche."},
     "question": {"en": "Which was thicker?", "de": "Welche war dicker?"},
     "expected_trial_s": 5}
  ]
})json";

}  // namespace jnd::app
