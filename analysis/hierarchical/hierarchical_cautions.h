#pragma once

#include <optional>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// A smaller spread between people counts as none.
inline constexpr double kNoSpread = 1e-6;

/// Adds a sentence to the fit's note.
void add_note(HierarchicalFit& fit, const std::string& sentence);

/// Notes spreads between people, and a correlation, that ended at their bounds.
void note_spreads_at_bounds(HierarchicalFit& fit, bool has_own_places);

/// Notes differences that have no interval because everybody's answers are alike.
void note_alike_people(HierarchicalFit& fit);

/// Removes the values and differences of conditions whose answers do not support them. This
/// concerns conditions in which only one person has answers, because one person does not show
/// how people differ. It also concerns conditions in which everybody's answers, apart from
/// lapses, are one step, because any steep enough curve fits a step. The status becomes
/// `degenerate` if no condition is left.
void leave_out_what_is_not_told(HierarchicalFit& fit);

/// Adds a caution to every value if the answers lie farther from people's curves than chance
/// explains. `p_value` is the result of `misfit_p_value`.
void caution_of_misfit(HierarchicalFit& fit, std::optional<double> p_value);

}  // namespace jnd::analysis
