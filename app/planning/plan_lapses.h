#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/participants/laboratory.h"
#include "experiments/session/plan.h"

namespace jnd::app {

/// What lapses would do to a block of comparisons, and whether its levels could reveal them. It
/// assumes simulated participants without spread, who all have the median person's Weber
/// fraction.
struct PlannedLapses {
  std::string block, quantity;
  /// The median person's w, by a curve that is even in ln.
  double weber_fraction = 0.0;
  /// The share of right answers at the easiest level, in [0.5, 1].
  double easiest_ratio = 0.0;
  /// The relative error of the Weber fraction that a fit without lapses would find, if 3
  /// answers in 100 were lapses at the easiest levels (a lapse rate of 0.03): the fitted
  /// fraction over the true one, minus 1.
  double fraction_change = 0.0;
  /// By how much lapses in the model would be expected to raise the log-likelihood of
  /// everybody's answers; the prior of the hierarchical fit costs 1.2 for them.
  double expected_rise = 0.0;
  /// Levels at which 99.4 % of the answers are right.
  double easy_low = 0.0, easy_high = 0.0;

  /// True if lapses would go unnoticed and would matter.
  [[nodiscard]] bool are_untold() const noexcept {
    return expected_rise < 1.2 && fraction_change >= 0.05;
  }
};

/// One for each block of constant stimuli that are compared with a reference, in the order of
/// the first participant who gets it. None if the laboratory has nobody who could answer. Not
/// real time.
[[nodiscard]] std::vector<PlannedLapses> planned_lapses(
    const experiments::Study& study, const std::vector<experiments::ParticipantPlan>& plans,
    const experiments::Laboratory& laboratory);

/// Adds the key `lapses`.
void add_to_json(const std::vector<PlannedLapses>& lapses, nlohmann::ordered_json& json);
/// Prints a line for each block whose levels are too hard, with easier levels.
void print(const std::vector<PlannedLapses>& lapses);

}  // namespace jnd::app
