#pragma once

#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// The model and the integral in a phrase, for `HierarchicalFit::method`. `has_orders_in` says
/// for each condition whether either interval held the test.
[[nodiscard]] std::string method_words(const HierarchicalOptions& options,
                                       const std::vector<bool>& has_orders_in, int num_nodes);

}  // namespace jnd::analysis
