#pragma once

#include <stdexcept>
#include <string>

#include "support/files.h"

namespace jnd::app {

/// A study of ten trials with estimation, production, comparison and most kinds of stages. It
/// runs in less than a second.
inline const std::string kTinyStudy = R"json({
  "format": 1,
  "name": "tiny",
  "languages": ["en"],
  "title": {"en": "Tiny"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "checklist", "name": "before", "items": [{"text": {"en": "Power on."}}]},
    {"kind": "consent", "name": "consent", "paragraphs": [{"en": "You may stop."}],
     "agreement": {"en": "I agree."}},
    {"kind": "explore", "name": "free", "instruction": {"en": "Move."},
     "media": [{"medium": "free_space", "duration_s": 0.5}]},
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "water", "scale": [0.5, 2], "repetitions": 2, "free_space_between_s": 0,
     "instruction": {"en": "Say."}, "question": {"en": "How strong?"}, "expected_trial_s": 5},
    {"kind": "block", "name": "production", "procedure": "magnitude_production",
     "medium": "water", "scale": [1, 2], "target_percent": [100],
     "coarse_step_scale": 0.5, "fine_step_scale": 0.25, "free_space_between_s": 0,
     "instruction": {"en": "Set."}, "question": {"en": "So?"}, "expected_trial_s": 5},
    {"kind": "break", "name": "rest", "instruction": {"en": "Rest."}, "duration_s": 60},
    {"kind": "block", "name": "comparison", "procedure": "constant_stimuli",
     "medium": "viscous", "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8,
     "repetitions": 2, "free_space_between_s": 0, "instruction": {"en": "Compare."},
     "question": {"en": "Thicker?"}, "expected_trial_s": 5},
    {"kind": "questionnaire", "name": "about_you", "instruction": {"en": "You."}, "items": [
      {"name": "body_height_m", "kind": "number", "unit": "m", "minimum": 1, "maximum": 2.5,
       "question": {"en": "Height?"}}]}
  ]
})json";
inline constexpr int kTinyTrials = 10;

using test_support::read_file;
using test_support::write_file;

/// Returns the text with the first `from` replaced by `to`. Throws if the text does not contain
/// `from`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the text: " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace jnd::app
