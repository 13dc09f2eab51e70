#pragma once

#include <optional>
#include <vector>

#include "analysis/hierarchical/hierarchical_arrangement.h"
#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/hierarchical/hierarchical_nested.h"

namespace jnd::analysis {

/// Whether nobody answered any level twice. Then nothing shows how answers to one level
/// scatter.
[[nodiscard]] bool are_all_single(const HierarchicalArrangement& all);

/// The correlation of two answers of one person to one level, its test against 0 and, if asked
/// for, its interval. The interval's ends lie where log-likelihood plus log prior, maximised
/// over everything else, has fallen by half the 95 % quantile of chi-squared. `found` is the
/// optimum of `structure`, and `start` is where its search started. Not real time.
[[nodiscard]] HierarchicalScatter scatter_of(NestedOptima& nested,
                                             const HierarchicalLikelihood& likelihood,
                                             const HierarchicalStructure& structure,
                                             const Eigen::VectorXd& start,
                                             const HierarchicalOptimum& found,
                                             bool has_interval);

/// How far people's own lapse rates differ, and the same model with one rate for everybody.
[[nodiscard]] HierarchicalOwnLapses own_lapses_of(NestedOptima& nested,
                                                  const HierarchicalStructure& structure,
                                                  const HierarchicalOptimum& found);

/// The fits without the lapse rate's prior, and with half and twice its weight. Each search
/// starts from `found`. Not real time.
[[nodiscard]] std::vector<HierarchicalPriorEffect> prior_effects(
    const HierarchicalArrangement& all, const HierarchicalStructure& structure,
    const HierarchicalOptimum& found, int num_nodes);

}  // namespace jnd::analysis
