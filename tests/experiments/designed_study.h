#pragma once

#include <string>

namespace jnd::experiments {

/// A study of two fluids, one of them in two blocks, with half of the people primed and these
/// contrasts, which are a JSON list without its brackets.
inline std::string designed_study(const std::string& contrasts = "") {
  const auto block = [](const std::string& name, const std::string& fluid, double reference) {
    const std::string levels = fluid.empty() ? "" : R"("levels": {"fluid": ")" + fluid + "\"},";
    const auto times = [reference](double factor) {
      return std::to_string(factor * reference);
    };
    return R"({"kind": "block", "name": ")" + name +
           R"(", "procedure": "constant_stimuli", "medium": "viscous", )" + levels +
           R"("viscosity_pa_s": [)" + times(0.25) + ", " + times(0.5) + ", " + times(0.75) +
           ", " + times(1.5) + ", " + times(2.0) + ", " + times(4.0) +
           R"(], "reference_viscosity_pa_s": )" + std::to_string(reference) +
           R"(, "repetitions": 4, "instruction": {"en": "Compare."},
            "question": {"en": "Thicker?"}, "expected_trial_s": 10})";
  };
  return R"({
  "format": 1, "name": "designed", "languages": ["en"], "title": {"en": "Designed"},
  "authors": ["A. Author"],
  "factors": [{"name": "fluid", "levels": ["thin", "thick"]},
              {"name": "priming", "levels": ["primed", "control"]}],
  "contrasts": [)" +
         contrasts + R"(],
  "stages": [
    {"kind": "counterbalance", "name": "priming", "method": "one_of", "arms": [
      {"name": "primed", "stages": [{"kind": "break", "name": "bucket",
        "instruction": {"en": "Stir."}, "duration_s": 60}]},
      {"name": "control", "stages": []}]},
    )" + block("thin_a", "thin", 4.0) +
         ",\n    " + block("thick_b", "thick", 16.0) + ",\n    " +
         block("thin_c", "thin", 4.0) + "\n  ]\n}\n";
}

/// Returns a contrast of the two fluids. `more` is added to it, for example R"(, "alpha":
/// 0.01)".
inline std::string fluid_contrast(
    const std::string& more = "", const std::string& name = "fluids",
    const std::string& of = R"({"fluid": {"thin": 1, "thick": -1}})",
    const std::string& measure = "weber_fraction") {
  return R"({"name": ")" + name + R"(", "measure": ")" + measure +
         R"(", "role": "primary", "of": )" + of + more + "}";
}

}  // namespace jnd::experiments
