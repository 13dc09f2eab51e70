#pragma once

#include <optional>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// A spread between people that is less is none.
inline constexpr double kNoSpread = 1e-6;

/// Adds a sentence to the fit's note.
void add_note(HierarchicalFit& fit, const std::string& sentence);

/// Notes spreads between people, and a correlation, that ended at their bounds.
void note_spreads_at_bounds(HierarchicalFit& fit, bool has_own_places);

/// Notes differences without an interval, as everybody's answers are alike.
void note_alike_people(HierarchicalFit& fit);

/// Takes back what the answers of a condition do not bear, values and differences with it:
/// where one person alone has answers, who says nothing of how people differ; and where
/// everybody's answers are one step but for lapses, which any curve steep enough suits. The fit
/// is `degenerate` where no condition is left.
void leave_out_what_is_not_told(HierarchicalFit& fit);

/// Cautions at every value where the answers lie farther from everybody's curves than chance
/// has them. `p_value`: as `misfit_p_value`.
void caution_of_misfit(HierarchicalFit& fit, std::optional<double> p_value);

}  // namespace jnd::analysis
