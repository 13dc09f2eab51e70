#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/effect_test.h"
#include "experiments/study/design.h"

namespace jnd::analysis {

/// A contrast of the study file as simulated studies are analysed for it. Whoever only sums up
/// runs needs no more than names and alpha.
struct PowerContrast {
  std::string name;
  std::string meaning;  ///< What is tested and how, in one phrase.
  double alpha = 0.05;
  std::optional<double> margin;  ///< On the scale of the test; then equivalence is tested, too.
  bool is_ratio = true;          ///< The scale is the logarithm of a ratio.

  experiments::ContrastMeasure measure = experiments::ContrastMeasure::kWeberFraction;
  Tail tail = Tail::kTwoSided;
  std::string family;
  experiments::Correction correction = experiments::Correction::kHolm;
  std::vector<std::vector<std::size_t>> conditions;  ///< Places of the blocks of each.
  std::vector<experiments::Levels> groups;           ///< What people of each group are.
  std::vector<std::vector<double>> weights;          ///< By group, then by condition.
};

}  // namespace jnd::analysis
