#pragma once

#include <optional>

#include "analysis/report/figures.h"

namespace jnd::analysis {

/// A panel for each published value for which simulated studies are available. Ours is a
/// distribution, and the published value a point. Absent if there are none.
[[nodiscard]] std::optional<Figure> predictive_figure(const StudyResults& results);

}  // namespace jnd::analysis
