#pragma once

#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Families of tests: each answers one question, over the whole study.
inline constexpr char kEffectsFamily[] = "exploratory, effects within and between people";
inline constexpr char kTrialTrendsFamily[] = "exploratory, changes over the trials";
/// Pairs of blocks that nobody chose, and those that somebody chose when the results were
/// computed. No study file plans a comparison yet, so neither is called planned.
inline constexpr char kPairsFamily[] = "exploratory, every two blocks";
inline constexpr char kAskedFamily[] = "asked for with --compare, not planned in the study";
/// What that means for their p values, a sentence each, for who reads the numbers.
inline constexpr char kPairsNote[] =
    "Nobody planned a comparison of blocks before the study: all of one quantity are compared, "
    "and their p values are exploratory.";
inline constexpr char kAskedNote[] =
    "The comparisons of blocks were chosen with --compare when the results were computed; the "
    "study file plans none, so their p values are those of planned tests only if the choice "
    "was "
    "made before anybody saw the data.";
inline constexpr char kMovementFamily[] = "exploratory, movement";
/// What ratings and answers to questions go with.
inline constexpr char kQuestionsFamily[] = "exploratory, ratings and questions";

/// Puts the paired tests of how people moved into one family; the unpaired ones, of the same
/// hypotheses, are named sensitivity.
void mark_movement_family(std::vector<ResultsSection>& sections);

/// The primary tests between blocks are one family, `kAskedFamily` if they were asked for, else
/// `kPairsFamily`.
void mark_pairs_family(std::vector<ResultsSection>& sections, bool were_asked_for);

/// `kPairsNote` or `kAskedNote`, whichever belongs to the comparison; "" for all others.
[[nodiscard]] std::string family_note(const NamedComparison& named);

/// Adjusts the tests of each family by Holm (1979), whichever sections they stand in. One test
/// a hypothesis belongs to a family, the parametric one: a rank test beside it shows how much
/// the result rests on the normal distribution, and gives no second chance.
void adjust_by_family(std::vector<ResultsSection>& sections);

}  // namespace jnd::analysis
