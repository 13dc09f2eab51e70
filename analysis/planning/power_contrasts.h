#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/effect_test.h"
#include "experiments/study/design.h"

namespace jnd::analysis {

/// A contrast of the study file in the form in which simulated studies are analysed. To
/// summarise runs, only the names and alpha are needed.
struct PowerContrast {
  std::string name;
  std::string meaning;  ///< What is tested and how, in one phrase.
  double alpha = 0.05;
  /// The margin on the scale of the test. If it is present, equivalence is tested too.
  std::optional<double> margin;
  bool is_ratio = true;  ///< Whether the scale is the logarithm of a ratio.

  experiments::ContrastMeasure measure = experiments::ContrastMeasure::kWeberFraction;
  Tail tail = Tail::kTwoSided;
  std::string family;
  experiments::Correction correction = experiments::Correction::kHolm;
  /// The indices of the blocks of each condition.
  std::vector<std::vector<std::size_t>> conditions;
  /// The levels of the factors that define each group of people.
  std::vector<experiments::Levels> groups;
  std::vector<std::vector<double>> weights;  ///< Indexed by group, then by condition.
};

}  // namespace jnd::analysis
