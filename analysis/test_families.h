#pragma once

#include <vector>

#include "analysis/study_results.h"

namespace jnd::analysis {

/// Families of tests: each answers one question, over the whole study.
inline constexpr char kEffectsFamily[] = "exploratory, effects within and between people";
inline constexpr char kTrialTrendsFamily[] = "exploratory, changes over the trials";
inline constexpr char kPlannedFamily[] = "planned comparisons";
inline constexpr char kMovementFamily[] = "exploratory, movement";

/// Puts the paired tests of how people moved into one family; the unpaired ones, of the same
/// hypotheses, are named sensitivity.
void mark_movement_family(std::vector<ResultsSection>& sections);

/// Where several comparisons are planned, their primary tests are one family.
void mark_planned_family(std::vector<ResultsSection>& sections);

/// Adjusts the tests of each family by Holm (1979), whichever sections they stand in. One test
/// a hypothesis belongs to a family, the parametric one: a rank test beside it shows how much
/// the result rests on the normal distribution, and gives no second chance.
void adjust_by_family(std::vector<ResultsSection>& sections);

}  // namespace jnd::analysis
