#pragma once

#include <string>

#include "analysis/hierarchical/hierarchical_arrangement.h"

namespace jnd::analysis {

/// How easy a condition's comparisons are for its median person, of whom z is 1 at the Weber
/// fraction itself.
struct LevelEase {
  /// Share of all answers with |z| >= 1; of a forced choice with z >= 1.
  double easy_ratio = 0.0;
  /// Where z is -2.5 and 2.5, the likelier answer has 99.4 %: another one is a lapse. The lower
  /// one 0 with a forced choice, where it is a guess.
  double easy_low = 0.0, easy_high = 0.0;
};

/// `numbers`: a of each condition, then p and q, as in `HierarchicalStructure`; either order of
/// the intervals counts with its own place.
[[nodiscard]] LevelEase level_ease(const HierarchicalArrangement& all,
                                   const HierarchicalStructure& structure,
                                   const Eigen::VectorXd& numbers, int condition);

/// Fewer than a twentieth of the answers were to comparisons as easy as the Weber fraction. It
/// then lies beyond the levels, is told by the curve's form alone, and with it hangs on lapses:
/// where even the easiest comparisons are often got wrong, nothing tells a lapse.
[[nodiscard]] bool are_hard(const LevelEase& ease) noexcept;

/// The Weber fraction of a condition's largest stimulus, of whomever: beyond, nothing is told
/// from anything else, as of the own fractions of results.
[[nodiscard]] double largest_fraction(const HierarchicalArrangement& all,
                                      std::size_t condition);

/// Says so, and which levels would mend it. `weber_fraction`, and what it would be at the lapse
/// rate 0.03, where that is known.
[[nodiscard]] std::string hard_levels(const LevelEase& ease, double weber_fraction,
                                      std::optional<double> with_lapses);

}  // namespace jnd::analysis
