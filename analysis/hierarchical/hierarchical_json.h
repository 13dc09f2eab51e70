#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Every number is finite. Absent values and open ends of intervals are null.
[[nodiscard]] nlohmann::ordered_json to_json(const HierarchicalFit& fit);

}  // namespace jnd::analysis
