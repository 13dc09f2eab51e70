#pragma once

#include <optional>
#include <vector>

#include "analysis/hierarchical/hierarchical_arrangement.h"
#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/hierarchical/hierarchical_nested.h"

namespace jnd::analysis {

/// Whether nobody answered any level twice: then nothing tells how answers to one scatter.
[[nodiscard]] bool are_all_single(const HierarchicalArrangement& all);

/// The correlation of two answers of one person to one level, its test against 0, and, where it
/// is asked for, its interval: where the log-likelihood and log prior, at their largest over
/// all else, have fallen by half the 95 % quantile of chi-squared. `found`: the optimum of
/// `structure`; `start`: where it was sought from. Not real time.
[[nodiscard]] HierarchicalScatter scatter_of(NestedOptima& nested,
                                             const HierarchicalLikelihood& likelihood,
                                             const HierarchicalStructure& structure,
                                             const Eigen::VectorXd& start,
                                             const HierarchicalOptimum& found,
                                             bool has_interval);

/// How far people's own lapse rates are apart, and the same model with one for everybody.
[[nodiscard]] HierarchicalOwnLapses own_lapses_of(NestedOptima& nested,
                                                  const HierarchicalStructure& structure,
                                                  const HierarchicalOptimum& found);

/// The fit with the lapse rate's prior level, of half and of twice its weight, each sought from
/// `found`. Not real time.
[[nodiscard]] std::vector<HierarchicalPriorEffect> prior_effects(
    const HierarchicalArrangement& all, const HierarchicalStructure& structure,
    const HierarchicalOptimum& found, int num_nodes);

}  // namespace jnd::analysis
