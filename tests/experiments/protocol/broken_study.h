#pragma once

#include <stdexcept>
#include <string>

#include "experiments/protocol/study_reader.h"

namespace jnd::experiments {

/// A small sound study with one stage of most kinds, which tests break in one place at a time.
inline const std::string kSoundStudy = R"json({
  "format": 1,
  "name": "sound",
  "languages": ["en", "de"],
  "title": {"en": "Sound", "de": "Heil"},
  "authors": ["A. Author"],
  "blinding": "none",
  "stages": [
    {"kind": "counterbalance", "name": "priming", "method": "one_of", "arms": [
      {"name": "primed", "stages": [
        {"kind": "break", "name": "bucket", "instruction": {"en": "Stir.", "de": "Rühren."}, "duration_s": 60}]},
      {"name": "unprimed", "stages": []}]},
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "water", "scale": [0, 1, 2], "repetitions": 3,
     "instruction": {"en": "Say.", "de": "Sag."}, "question": {"en": "How?", "de": "Wie?"},
     "expected_trial_s": 20},
    {"kind": "counterbalance", "name": "group_order", "method": "order", "arms": [
      {"name": "low", "stages": [
        {"kind": "block", "name": "production", "procedure": "magnitude_production",
         "medium": "water", "scale": [0, 4], "target_percent": [100, 50],
         "coarse_step_scale": 0.5, "fine_step_scale": 0.1, "max_scale": 8,
         "instruction": {"en": "Set.", "de": "Stell."}, "question": {"en": "So?", "de": "So?"},
         "expected_trial_s": 30}]},
      {"name": "high", "stages": [
        {"kind": "block", "name": "comparison", "procedure": "constant_stimuli",
         "medium": "viscous", "viscosity_pa_s": [10.5, 20], "reference_viscosity_pa_s": 16,
         "repetitions": 5, "instruction": {"en": "Compare.", "de": "Vergleich."},
         "question": {"en": "Thicker?", "de": "Dicker?"}, "expected_trial_s": 15}]}],
     "between": [
       {"kind": "break", "name": "rest", "only_for": {"priming": "primed"},
        "instruction": {"en": "Rest.", "de": "Pause."}, "duration_s": 180}]},
    {"kind": "questionnaire", "name": "about_you",
     "instruction": {"en": "You.", "de": "Du."}, "items": [
       {"name": "body_height_m", "kind": "number", "unit": "m", "minimum": 1, "maximum": 2.5,
        "question": {"en": "Height?", "de": "Größe?"}},
       {"name": "handedness", "kind": "choice", "question": {"en": "Hand?", "de": "Hand?"},
        "options": [{"value": "right", "label": {"en": "right", "de": "rechts"}},
                    {"value": "left", "label": {"en": "left", "de": "links"}}]},
       {"name": "freedom", "kind": "scale", "question": {"en": "Free?", "de": "Frei?"},
        "low_label": {"en": "no", "de": "nein"}, "high_label": {"en": "yes", "de": "ja"},
        "high_is_good": true}]}
  ]
})json";

/// Returns the correct study with the first `from` replaced by `to`. Throws if the study does
/// not contain `from`.
inline std::string broken(const std::string& from, const std::string& to,
                          std::string text = kSoundStudy) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the study: " + from);
  return text.replace(at, from.size(), to);
}

/// Returns every problem of a text, one in each line, or "" for a correct text.
inline std::string problems_of(const std::string& text) {
  std::string lines;
  for (const StudyProblem& problem : study_text_problems(text, "x.json")) {
    lines += (lines.empty() ? "" : "\n") + to_string(problem);
  }
  return lines;
}

}  // namespace jnd::experiments
