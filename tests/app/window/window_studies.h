#pragma once

#include <string>

namespace jnd::app {

/// Returns a study of these stages, which are JSON objects, separated by commas. A trial counts
/// however many ticks it missed, because the same processor also computes the display.
inline std::string study_of(const std::string& stages, const std::string& blinding = "none") {
  return R"json({
  "format": 1, "name": "window", "languages": ["en"], "title": {"en": "Window"},
  "authors": ["A. Author"], "blinding": ")json" +
         blinding + R"json(",
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1.0},
  "stages": [)json" +
         stages + "]}";
}

/// A block of four trials with the answers yes and no.
inline const std::string kComparison = R"json({
    "kind": "block", "name": "comparison", "title": {"en": "Compare"},
    "procedure": "constant_stimuli", "medium": "viscous", "viscosity_pa_s": [4, 16],
    "reference_viscosity_pa_s": 8, "repetitions": 2, "free_space_between_s": 0,
    "instruction": {"en": "Compare."}, "question": {"en": "Does it feel thicker?"},
    "yes_label": {"en": "Thicker"}, "no_label": {"en": "Thinner"}, "expected_trial_s": 5})json";

/// A block of two trials in which the level is set by hand.
inline const std::string kProduction = R"json({
    "kind": "block", "name": "production", "title": {"en": "Produce"},
    "procedure": "magnitude_production", "medium": "water", "scale": [1, 2],
    "target_percent": [100], "coarse_step_scale": 0.5, "fine_step_scale": 0.25,
    "free_space_between_s": 0, "instruction": {"en": "Set it."},
    "question": {"en": "So?"}, "expected_trial_s": 5})json";

/// A block of two trials with answers in percent.
inline const std::string kEstimation = R"json({
    "kind": "block", "name": "estimation", "title": {"en": "Estimate"},
    "procedure": "magnitude_estimation", "medium": "water", "scale": [0.5, 2],
    "repetitions": 1, "free_space_between_s": 0, "instruction": {"en": "Say."},
    "question": {"en": "How strong?"}, "expected_trial_s": 5})json";

}  // namespace jnd::app
