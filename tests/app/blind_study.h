#pragma once

#include <string>
#include <vector>

namespace jnd::app {

/// A double-blind study. Each name and number that could reveal a level is a word that nothing
/// else in the output contains.
inline const std::string kBlindStudy = R"json({
  "format": 1, "name": "window", "languages": ["en"], "title": {"en": "Window"},
  "authors": ["A. Author"], "blinding": "double", "comment": "treacly",
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1.0},
  "stages": [
    {"kind": "training", "name": "training", "instruction": {"en": "Feel."},
     "examples": [{"medium": "viscous", "viscosity_pa_s": 0.1371, "duration_s": 0.2}]},
    {"kind": "counterbalance", "name": "gluey_order", "title": {"en": "Gluey first or last"},
     "method": "order", "arms": [
      {"name": "honeyed", "stages": [
        {"kind": "block", "name": "syrupy", "title": {"en": "The tarry group"},
         "procedure": "constant_stimuli", "medium": "viscous",
         "viscosity_pa_s": [0.1372, 0.2719], "reference_viscosity_pa_s": 0.1913,
         "repetitions": 1, "free_space_between_s": 0, "instruction": {"en": "Compare."},
         "question": {"en": "More?"}, "expected_trial_s": 5}]},
      {"name": "watery", "stages": [
        {"kind": "block", "name": "brothy", "title": {"en": "The soupy group"},
         "procedure": "magnitude_production", "medium": "water", "scale": [0.8317],
         "target_percent": [100], "coarse_step_scale": 0.0537, "fine_step_scale": 0.0119,
         "free_space_between_s": 0, "instruction": {"en": "Set it."},
         "question": {"en": "So?"}, "expected_trial_s": 5}]}]}
  ]
})json";

/// A study that asks the same question twice, about other levels and in either order. What
/// leaves the program in a session of one order must equal what leaves it in a session of the
/// other.
inline const std::string kBlindOrderStudy = R"json({
  "format": 1, "name": "window", "languages": ["en"], "title": {"en": "Window"},
  "authors": ["A. Author"], "blinding": "double", "comment": "treacly",
  "markers": {"presentation": 10, "answer": 20},
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1.0},
  "stages": [
    {"kind": "counterbalance", "name": "gluey_order", "title": {"en": "Gluey first or last"},
     "method": "order", "arms": [
      {"name": "honeyed", "stages": [
        {"kind": "block", "name": "syrupy", "title": {"en": "The tarry group"},
         "procedure": "constant_stimuli", "medium": "viscous",
         "viscosity_pa_s": [0.1372, 0.2719], "reference_viscosity_pa_s": 0.1913,
         "repetitions": 1, "free_space_between_s": 0, "instruction": {"en": "Compare."},
         "question": {"en": "More?"}, "expected_trial_s": 5}]},
      {"name": "watery", "stages": [
        {"kind": "block", "name": "brothy", "title": {"en": "The soupy group"},
         "procedure": "constant_stimuli", "medium": "viscous",
         "viscosity_pa_s": [6.0537, 14.885], "reference_viscosity_pa_s": 8.317,
         "repetitions": 1, "free_space_between_s": 0, "instruction": {"en": "Compare."},
         "question": {"en": "More?"}, "expected_trial_s": 5}]}]}
  ]
})json";

/// Returns the revealing words and numbers of both studies, as the files write them and as the
/// program would show them.
inline std::vector<std::string> telltales() {
  return {"treacly", "gluey",  "Gluey",  "honeyed", "syrupy",  "tarry", "watery", "brothy",
          "soupy",   "0.137",  "0.1372", "0.272",   "0.2719",  "0.191", "0.1913", "0.832",
          "0.8317",  "0.885",  "0.0537", "0.0119",  "viscous", "Pa s",  "scale ", "6.0537",
          "6.05 ",   "14.885", "14.9 ",  "8.317",   "8.32 "};
}

/// Returns the telltale words that `text` contains, each with the line in which it stands.
inline std::vector<std::string> told_by(const std::string& text) {
  std::vector<std::string> told;
  for (const std::string& word : telltales()) {
    const std::size_t at = text.find(word);
    if (at == std::string::npos) continue;
    const std::size_t start = text.rfind('\n', at) + 1;
    told.push_back(word + " in: " + text.substr(start, text.find('\n', at) - start));
  }
  return told;
}

}  // namespace jnd::app
