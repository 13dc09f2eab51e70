#pragma once

#include <string>

#include "analysis/hierarchical/hierarchical_arrangement.h"

namespace jnd::analysis {

/// How easy a condition's comparisons are for its median person. At the Weber fraction itself z
/// is 1.
struct LevelEase {
  /// The share of all answers with |z| >= 1. In a forced choice, with z >= 1.
  double easy_ratio = 0.0;
  /// The intensities where z is -2.5 and 2.5. Beyond them the likelier answer has 99.4 %, so
  /// any other answer is a lapse. In a forced choice the lower one is 0, because there the
  /// other answer is a guess.
  double easy_low = 0.0, easy_high = 0.0;
};

/// `numbers` holds a of each condition, then p and q, as in `HierarchicalStructure`. Each order
/// of the intervals counts with its own place.
[[nodiscard]] LevelEase level_ease(const HierarchicalArrangement& all,
                                   const HierarchicalStructure& structure,
                                   const Eigen::VectorXd& numbers, int condition);

/// Whether fewer than a twentieth of the answers were to comparisons as easy as the Weber
/// fraction. The Weber fraction then lies beyond the levels. It follows from the curve's form
/// alone and depends on lapses: if even the easiest comparisons are often answered wrongly,
/// nothing shows a lapse.
[[nodiscard]] bool are_hard(const LevelEase& ease) noexcept;

/// The Weber fraction of a condition's largest stimulus over all people. The data tell nothing
/// about Weber fractions beyond it.
[[nodiscard]] double largest_fraction(const HierarchicalArrangement& all,
                                      std::size_t condition);

/// A sentence that says so, and which levels would help. It names `weber_fraction` and, if
/// known, the fraction at a lapse rate of 0.03.
[[nodiscard]] std::string hard_levels(const LevelEase& ease, double weber_fraction,
                                      std::optional<double> with_lapses);

}  // namespace jnd::analysis
