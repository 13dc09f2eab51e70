#pragma once

#include <string>

namespace jnd::app {

/// A study with a rating block and a comparison block. Both ask questions after every trial.
inline const std::string kAskedStudy = R"json({
  "format": 1,
  "name": "asked",
  "languages": ["en"],
  "title": {"en": "Asked"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "rated", "title": {"en": "How thick"}, "procedure": "rating",
     "medium": "viscous", "viscosity_pa_s": [2, 8], "repetitions": 1, "num_steps": 7,
     "low_label": {"en": "very thin"}, "high_label": {"en": "very thick"},
     "instruction": {"en": "Say how thick each fluid feels."},
     "question": {"en": "How thick, from 1 to 7?"},
     "questions": [
       {"name": "pleasantness", "kind": "scale", "num_steps": 5,
        "question": {"en": "How did it feel?"},
        "low_label": {"en": "unpleasant"}, "high_label": {"en": "pleasant"}},
       {"name": "remark", "kind": "text", "required": false,
        "question": {"en": "What was it like?"}}],
     "expected_trial_s": 8},
    {"kind": "block", "name": "compared", "title": {"en": "Which is thicker"},
     "procedure": "constant_stimuli", "medium": "viscous", "feedback": true,
     "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 1,
     "instruction": {"en": "First comes the reference, then the test."},
     "question": {"en": "Thicker?"},
     "questions": [
       {"name": "confidence", "kind": "scale", "num_steps": 6,
        "question": {"en": "How sure are you of that?"},
        "low_label": {"en": "I guessed"}, "high_label": {"en": "wholly sure"}}],
     "expected_trial_s": 8}
  ]
})json";

}  // namespace jnd::app
