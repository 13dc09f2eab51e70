#pragma once

namespace jnd::app {

/// A study with two groups of blocks whose trials are mixed, and a separate block between them.
/// The first group mixes a block of fixed levels with a staircase that asks a question. The
/// blocks of the second group have fixed levels.
inline constexpr char kInterleavedStudy[] = R"json({
  "format": 1, "name": "mixed", "languages": ["en"], "title": {"en": "Mixed"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "interleaved", "name": "two_kinds", "title": {"en": "Two kinds"},
     "turns": "random", "blocks": [
      {"kind": "block", "name": "constant", "procedure": "constant_stimuli",
       "medium": "viscous", "viscosity_pa_s": [1, 4], "reference_viscosity_pa_s": 2,
       "repetitions": 1, "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
       "expected_trial_s": 5},
      {"kind": "block", "name": "adaptive", "procedure": "staircase", "medium": "viscous",
       "task": "reminder", "reference_viscosity_pa_s": 10, "start_viscosity_pa_s": [30],
       "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 40, "level_scale": "logarithmic",
       "step_ratio": [2], "num_up": 1, "num_down": 1, "max_reversals": 20, "max_trials": 3,
       "num_reversals_averaged": 2,
       "questions": [{"name": "sure", "kind": "yes_no", "question": {"en": "Sure?"}}],
       "instruction": {"en": "Compare, and say how sure you are."},
       "question": {"en": "Thicker?"}, "expected_trial_s": 5}]},
    {"kind": "block", "name": "alone", "procedure": "constant_stimuli", "medium": "viscous",
     "viscosity_pa_s": [1, 4], "reference_viscosity_pa_s": 2, "repetitions": 1,
     "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
     "expected_trial_s": 5},
    {"kind": "interleaved", "name": "two_more", "blocks": [
      {"kind": "block", "name": "thin", "procedure": "constant_stimuli", "medium": "viscous",
       "viscosity_pa_s": [1, 4], "reference_viscosity_pa_s": 2, "repetitions": 1,
       "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
       "expected_trial_s": 5},
      {"kind": "block", "name": "thick", "procedure": "constant_stimuli", "medium": "viscous",
       "viscosity_pa_s": [5, 20], "reference_viscosity_pa_s": 10, "repetitions": 1,
       "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
       "expected_trial_s": 5}]}]})json";

}  // namespace jnd::app
