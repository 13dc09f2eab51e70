#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/participants/laboratory.h"
#include "experiments/session/plan.h"

namespace jnd::app {

/// What lapses would do to a block of comparisons, and whether its levels could tell them: as
/// simulated participants without spread would answer, who all have the median person's Weber
/// fraction.
struct PlannedLapses {
  std::string block, quantity;
  double weber_fraction = 0.0;  ///< By a curve that is even in ln, w of the median person.
  double easiest_ratio = 0.0;   ///< Right answers at the easiest level, [0.5, 1].
  /// The Weber fraction that a fit without lapses would find if 3 answers in 100 were lapses at
  /// the easiest levels (a lapse rate of 0.03), over the true one, less 1.
  double fraction_change = 0.0;
  /// By how much the log-likelihood of everybody's answers would then expect to rise with
  /// lapses; the prior of the hierarchical fit gives up 1.2 for them.
  double expected_rise = 0.0;
  double easy_low = 0.0, easy_high = 0.0;  ///< Levels that are right in 99.4 %.

  /// They would go unnoticed, and matter.
  [[nodiscard]] bool are_untold() const noexcept {
    return expected_rise < 1.2 && fraction_change >= 0.05;
  }
};

/// Of each block of constant stimuli that are compared with a reference, in the order of the
/// first participant who has it. None where the laboratory has nobody who could answer. Not
/// real time.
[[nodiscard]] std::vector<PlannedLapses> planned_lapses(
    const experiments::Study& study, const std::vector<experiments::ParticipantPlan>& plans,
    const experiments::Laboratory& laboratory);

/// Key `lapses`.
void add_to_json(const std::vector<PlannedLapses>& lapses, nlohmann::ordered_json& json);
/// A line for each block whose levels are too hard, with easier ones.
void print(const std::vector<PlannedLapses>& lapses);

}  // namespace jnd::app
