#pragma once

#include <optional>

#include "analysis/report/figures.h"

namespace jnd::analysis {

/// A panel for every published value that simulated studies are known beside: ours a
/// distribution, theirs a point. Nothing where none are known.
[[nodiscard]] std::optional<Figure> predictive_figure(const StudyResults& results);

}  // namespace jnd::analysis
