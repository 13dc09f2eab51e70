#pragma once

#include <string>
#include <vector>

#include "analysis/results/study_results.h"
#include "analysis/words/said.h"

namespace jnd::analysis {

/// Families of tests. Each family answers one question about the whole study.
inline constexpr const char* kEffectsFamily =
    said_later("exploratory, effects within and between people");
inline constexpr const char* kTrialTrendsFamily =
    said_later("exploratory, changes over the trials");
/// The first is for pairs of blocks that nobody chose, and the second for pairs chosen when the
/// results were computed. Planned tests stand in the study file as contrasts, so neither family
/// is planned.
inline constexpr const char* kPairsFamily = said_later("exploratory, every two blocks");
inline constexpr const char* kAskedFamily =
    said_later("asked for with --compare, not planned in the study");
/// Sentences for readers on what this means for the p values.
inline constexpr const char* kPairsNote = said_later(
    "Nobody planned a comparison of blocks before the study: all of one quantity are compared, "
    "and their p values are exploratory.");
inline constexpr const char* kAskedNote = said_later(
    "The comparisons of blocks were chosen with --compare when the results were computed; the "
    "study file plans none, so their p values are those of planned tests only if the choice "
    "was "
    "made before anybody saw the data.");
/// Pairs of blocks in a study that plans contrasts, but not these pairs.
inline constexpr const char* kBesidePlanFamily =
    said_later("exploratory, beside the planned contrasts");
inline constexpr const char* kBesidePlanNote = said_later(
    "The study file plans contrasts, which stand first; comparisons of every two blocks beside "
    "them are exploratory.");
inline constexpr const char* kMovementFamily = said_later("exploratory, movement");
/// What ratings and answers to questions are related to.
inline constexpr const char* kQuestionsFamily =
    said_later("exploratory, ratings and questions");

/// Puts the paired tests of movement into one family. The unpaired tests have the same
/// hypotheses, and are marked as sensitivity analyses.
void mark_movement_family(std::vector<ResultsSection>& sections);

/// Puts the primary tests between blocks into one family: `kAskedFamily` if they were asked
/// for, and `kPairsFamily` otherwise.
void mark_pairs_family(std::vector<ResultsSection>& sections, bool were_asked_for);

/// Puts the same tests of a study that plans contrasts into a family of their own. None of them
/// is primary.
void mark_pairs_beside_plan(std::vector<ResultsSection>& sections);

/// `kPairsNote`, `kAskedNote` or `kBesidePlanNote`, whichever applies to the comparison; "" for
/// all others.
[[nodiscard]] std::string family_note(const NamedComparison& named);

/// Adjusts the tests of each family by Holm (1979), over all sections. For each hypothesis only
/// the parametric test belongs to a family. A rank test beside it shows how much the result
/// depends on the normal distribution; it is no second chance.
void adjust_by_family(std::vector<ResultsSection>& sections);

}  // namespace jnd::analysis
