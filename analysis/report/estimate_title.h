#pragma once

#include <string>

#include "analysis/charts/study_titles.h"

namespace jnd::analysis {

/// What readers call an estimate: "Group D: Weber fraction, median person" of
/// "group_d.weber_fraction_median_person". `unit` is left out of it, for tables have a column
/// of units.
[[nodiscard]] std::string estimate_title(const StudyTitles& titles, const std::string& name,
                                         const std::string& unit);

}  // namespace jnd::analysis
