#pragma once

#include <string>

#include "analysis/hand_made_study.h"

namespace jnd::analysis {

inline constexpr char kFeltProtocol[] = R"json({"name": "by_hand", "stages": [
  {"kind": "block", "name": "felt", "procedure": "staircase", "medium": "viscous", "start_viscosity_pa_s": [0.4],
   "lowest_viscosity_pa_s": 0.05, "highest_viscosity_pa_s": 1, "step_ratio": [2], "task": "yes_no"}]})json";

/// Adds two people of the protocol above. P01 felt 2, 5 and 8 of ten at 0.1, 0.2 and 0.4 Pa s.
/// P02 felt all at 0.4 Pa s and none of the others, so that no threshold can be fitted.
inline void add_felt_answers(HandMadeStudy& study) {
  const int felt[2][3] = {{2, 5, 8}, {0, 0, 10}};
  for (int person = 0; person < 2; ++person) {
    study.add("P0" + std::to_string(person + 1));
    for (int level = 0; level < 3; ++level) {
      for (int i = 0; i < 10; ++i) {
        (void)study.answer({.block = "felt",
                            .procedure = "staircase",
                            .quantity = "viscosity_pa_s",
                            .repetition = 1,
                            .intensity = 0.1 * (1 << level),
                            .response = i < felt[person][level] ? 1.0 : 0.0});
      }
    }
  }
}

}  // namespace jnd::analysis
