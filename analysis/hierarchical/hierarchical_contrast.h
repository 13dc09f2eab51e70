#pragma once

#include <map>
#include <optional>
#include <string>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/statistics/effect_test.h"

namespace jnd::analysis {

/// The number in which conditions of a hierarchical fit are contrasted.
enum class HierarchicalNumber {
  kLogWeberFraction,  ///< ln w of the median person.
  kLogPse,            ///< ln(pse / reference), for a free pse.
};

/// The weighted sum over conditions of the median person's numbers. Its error is that of the
/// sandwich estimator, as in `HierarchicalDifference`, with the delta method if the number is
/// not a parameter of the fit. `groups` maps each participant to a group of people who are
/// treated alike. Each group has its own mean. The degrees of freedom are those of Welch and
/// Satterthwaite over the groups; a single group has the number of people minus one.
/// `num_people` is the number of people in each group who have answers in all of its
/// conditions. The result is absent if a condition with a weight has no value, or if people's
/// answers leave no error. Throws `core::Error` for a link other than kLogSlope.
[[nodiscard]] std::optional<EffectEstimate> hierarchical_contrast(
    const HierarchicalFit& fit, HierarchicalLink link, HierarchicalNumber number,
    const std::map<std::string, double>& weights, const std::map<std::string, int>& groups,
    const std::map<int, int>& num_people);

}  // namespace jnd::analysis
