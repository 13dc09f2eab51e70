#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Every number is finite; what does not exist is null, an open end of an interval too.
[[nodiscard]] nlohmann::ordered_json to_json(const HierarchicalFit& fit);

}  // namespace jnd::analysis
