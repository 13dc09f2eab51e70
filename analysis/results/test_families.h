#pragma once

#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Families of tests: each answers one question, over the whole study.
inline constexpr char kEffectsFamily[] = "exploratory, effects within and between people";
inline constexpr char kTrialTrendsFamily[] = "exploratory, changes over the trials";
/// Pairs of blocks that nobody chose, and those that somebody chose when the results were
/// computed. What is planned stands in the study file as a contrast, so neither is.
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
/// Pairs of blocks of a study that plans contrasts, and not these.
inline constexpr char kBesidePlanFamily[] = "exploratory, beside the planned contrasts";
inline constexpr char kBesidePlanNote[] =
    "The study file plans contrasts, which stand first; comparisons of every two blocks beside "
    "them are exploratory.";
inline constexpr char kMovementFamily[] = "exploratory, movement";
/// What ratings and answers to questions go with.
inline constexpr char kQuestionsFamily[] = "exploratory, ratings and questions";

/// Puts the paired tests of how people moved into one family; the unpaired ones, of the same
/// hypotheses, are named sensitivity.
void mark_movement_family(std::vector<ResultsSection>& sections);

/// The primary tests between blocks are one family, `kAskedFamily` if they were asked for, else
/// `kPairsFamily`.
void mark_pairs_family(std::vector<ResultsSection>& sections, bool were_asked_for);

/// The same tests of a study that plans contrasts: none of them is primary, and they are a
/// family of their own.
void mark_pairs_beside_plan(std::vector<ResultsSection>& sections);

/// `kPairsNote`, `kAskedNote` or `kBesidePlanNote`, whichever belongs to the comparison; "" for
/// all others.
[[nodiscard]] std::string family_note(const NamedComparison& named);

/// Adjusts the tests of each family by Holm (1979), whichever sections they stand in. One test
/// a hypothesis belongs to a family, the parametric one: a rank test beside it shows how much
/// the result rests on the normal distribution, and gives no second chance.
void adjust_by_family(std::vector<ResultsSection>& sections);

}  // namespace jnd::analysis
