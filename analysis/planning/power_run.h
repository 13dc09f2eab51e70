#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/data/magnitude_means.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/planning/power_contrasts.h"
#include "analysis/planning/power_sequential.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// What a block is there to estimate.
enum class PlannedQuantity {
  kWeberFraction,
  kEstimationExponent,
  kProductionExponent,
  kMatch,   ///< Geometric mean of what was matched, over all standards.
  kRating,  ///< Mean step, over all stimuli.
};

struct PlannedBlock {
  std::string name;  ///< "group_d"
  PlannedQuantity quantity = PlannedQuantity::kWeberFraction;
  double reference = 0.0;  ///< Reference intensity of a discrimination, > 0.
  /// Either interval holds the test: its pse is at the reference then, see `primary_pse`.
  bool either_interval = false;
  std::optional<double> true_value;  ///< In the simulated laboratory.
};

/// What simulated studies are analysed for.
struct PlannedAnalysis {
  std::vector<PlannedBlock> blocks;
  std::optional<std::pair<std::size_t, std::size_t>> compared;  ///< Places of discriminations.
  bool paired = true;         ///< Some participants get both of these blocks.
  std::vector<int> sizes;     ///< Numbers of participants, ascending, each >= 1.
  bool free_pse = true;       ///< False: at the reference, as in blocks of two intervals.
  bool hierarchical = false;  ///< Also the hierarchical fit, which is a thousand times slower.
  std::vector<PowerContrast> contrasts;         ///< Of the study file, in its order.
  std::optional<PlannedSequential> sequential;  ///< Of one of these contrasts.

  /// How many people a run has.
  [[nodiscard]] int num_people() const {
    return std::max(sizes.back(), sequential ? sequential->boundaries.rule.looks.back() : 0);
  }
};

/// What the numbers of a `PlannedSize` are, in its order.
struct PlannedName {
  std::string name;
  std::string meaning;
  std::size_t block = 0;     ///< Of an estimate: its place in `blocks`.
  bool quick = false;        ///< It stands for the hierarchical fit's, lapses left out.
  double alpha = 0.05;       ///< Of a test.
  bool of_contrast = false;  ///< It tests a contrast that the study file plans.
  bool is_ratio = false;     ///< Its difference is the logarithm of a ratio.
};
[[nodiscard]] std::vector<PlannedName> estimate_names(const PlannedAnalysis& analysis);
/// The meaning of the test to plan by: that of the hierarchical fit, as in the results, or,
/// without it, what stands for it.
inline constexpr char kPrimaryTest[] = "primary";
inline constexpr char kStandsForPrimary[] = "quick, in place of the primary, hierarchical one";
/// With the pse at the reference.
inline constexpr char kSecondary[] = "secondary in the results";
[[nodiscard]] std::vector<PlannedName> test_names(const PlannedAnalysis& analysis);

/// One participant's answers in one block, without any if the block was not for them.
struct PlannedAnswers {
  std::vector<AnswerCount> counts;  ///< Discrimination.
  /// Ratios or steps at intensities, or intensities at targets or standards.
  MagnitudeAnswers magnitudes;
  /// The posterior of QUEST+ reaches an end of one of its grids.
  bool at_grid_end = false;
};
/// In the order of the blocks.
using PlannedPerson = std::vector<PlannedAnswers>;

struct PlannedEstimate {
  std::optional<double> value;
  Interval ci95;
};
struct PlannedTest {
  /// In ln ln(1 + w), first minus second; of a contrast the effect, a ratio as its logarithm.
  std::optional<double> difference;
  /// Two-sided, of a contrast as planned and adjusted; none where the test is undefined.
  std::optional<double> p_value;
};

/// How a study with that many participants came out.
struct PlannedSize {
  std::vector<PlannedEstimate> estimates;
  std::vector<PlannedTest> tests;
  std::vector<int> num_with_answers;  ///< By block: participants who got it.
  std::vector<int> num_degenerate;    ///< By block: of these, without a fit of their own.
  std::vector<int> num_at_grid_end;   ///< By block: of these, `PlannedAnswers::at_grid_end`.
};
/// One simulated study.
struct PlannedRun {
  std::vector<PlannedSize> sizes;           ///< At each of its sizes.
  std::optional<SequentialRun> sequential;  ///< By its looks, where some are planned.
};

/// Analyses a study at every size: of the same people always the first so many. Each is fitted
/// once, by maximum likelihood (lines through the logarithms for exponents).
///
/// The fast route to the median person's Weber fraction: the mean of the individual
/// ln ln(1 + w) with Student's interval, transformed back, of participants with a fit of their
/// own. The quick test is Student's t on the same numbers (Welch's where nobody gets both
/// blocks), as in `discrimination_comparison`, where it comes after the hierarchical fit's; the
/// second one adds half an answer to everybody
/// (`with_half_an_answer`), so that nobody is left out: more power, but where levels lie
/// differently about two references that half moves their fractions differently.
/// `people` are as many as the analysis asks for. `levels`: what each of them is in the factors
/// that people differ in; only contrasts look at it. A contrast is Student's t of people's own
/// contrasts, Welch's where there are groups, in the same numbers as the quick test, of Weber
/// fractions those with half an answer added where there is no fit. Not real time.
[[nodiscard]] PlannedRun analyse_run(const PlannedAnalysis& analysis,
                                     const std::vector<PlannedPerson>& people,
                                     const std::vector<experiments::Levels>& levels = {});

}  // namespace jnd::analysis
