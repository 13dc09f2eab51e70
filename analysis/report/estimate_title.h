#pragma once

#include <string>

#include "analysis/charts/study_titles.h"

namespace jnd::analysis {

/// The title of an estimate for readers, such as "Group D: Weber fraction, median person" for
/// "group_d.weber_fraction_median_person". The title does not contain `unit`, because tables
/// have a column of units.
[[nodiscard]] std::string estimate_title(const StudyTitles& titles, const std::string& name,
                                         const std::string& unit);

}  // namespace jnd::analysis
