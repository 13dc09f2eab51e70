#pragma once

#include <map>
#include <optional>
#include <string>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/statistics/effect_test.h"

namespace jnd::analysis {

/// In what conditions of a hierarchical fit are contrasted.
enum class HierarchicalNumber {
  kLogWeberFraction,  ///< ln w of the median person.
  kLogPse,            ///< ln(pse / reference), of a pse that is free.
};

/// The weighted sum over conditions of the median person's numbers, with the error that people
/// give it: the sandwich's, as of `HierarchicalDifference`, by the delta method where the
/// number is not the fit's own. `groups`: participant to the group of those who do not differ
/// on purpose; each has a mean of its own, and degrees of freedom are those of Welch and
/// Satterthwaite over the groups, of one group people less one. `num_people`: of each group,
/// those who have answers in all of its conditions. Absent where a condition with a weight has
/// no value, or its people's answers leave no error.
/// With a link other than kLogSlope it throws `core::Error`.
[[nodiscard]] std::optional<EffectEstimate> hierarchical_contrast(
    const HierarchicalFit& fit, HierarchicalLink link, HierarchicalNumber number,
    const std::map<std::string, double>& weights, const std::map<std::string, int>& groups,
    const std::map<int, int>& num_people);

}  // namespace jnd::analysis
