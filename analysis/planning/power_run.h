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

/// The quantity that a block estimates.
enum class PlannedQuantity {
  kWeberFraction,
  kEstimationExponent,
  kProductionExponent,
  kMatch,   ///< The geometric mean of the matches over all standards.
  kRating,  ///< The mean step over all stimuli.
};

struct PlannedBlock {
  std::string name;  ///< For example "group_d".
  PlannedQuantity quantity = PlannedQuantity::kWeberFraction;
  double reference = 0.0;  ///< The reference intensity of a discrimination, > 0.
  /// Whether either interval may hold the test. Its pse is then at the reference; see
  /// `primary_pse`.
  bool either_interval = false;
  std::optional<double> true_value;  ///< The true value in the simulated laboratory.
};

/// What is computed from simulated studies.
struct PlannedAnalysis {
  std::vector<PlannedBlock> blocks;
  /// The indices of two discriminations that are compared.
  std::optional<std::pair<std::size_t, std::size_t>> compared;
  bool paired = true;      ///< Whether some participants get both of these blocks.
  std::vector<int> sizes;  ///< Ascending numbers of participants, each >= 1.
  /// Whether the pse is free. If false it is at the reference, as in blocks of two intervals.
  bool free_pse = true;
  /// Whether to compute the hierarchical fit too, which is a thousand times slower.
  bool hierarchical = false;
  /// The contrasts of the study file, in its order.
  std::vector<PowerContrast> contrasts;
  std::optional<PlannedSequential> sequential;  ///< The looks for one of these contrasts.

  /// The number of people in a run.
  [[nodiscard]] int num_people() const {
    return std::max(sizes.back(), sequential ? sequential->boundaries.rule.looks.back() : 0);
  }
};

/// What the numbers of a `PlannedSize` are, in the same order.
struct PlannedName {
  std::string name;
  std::string meaning;
  std::size_t block = 0;  ///< For an estimate: the index in `blocks`.
  /// Whether it replaces the estimate of the hierarchical fit, without lapses.
  bool quick = false;
  double alpha = 0.05;       ///< The alpha of a test.
  bool of_contrast = false;  ///< Whether it tests a contrast that the study file plans.
  bool is_ratio = false;     ///< Whether its difference is the logarithm of a ratio.
};
[[nodiscard]] std::vector<PlannedName> estimate_names(const PlannedAnalysis& analysis);
/// The meaning of the test by which to plan. It is the hierarchical fit's, as in the results.
/// Without that fit it is the test that replaces it.
inline constexpr char kPrimaryTest[] = "primary";
inline constexpr char kStandsForPrimary[] = "quick, in place of the primary, hierarchical one";
/// The meaning of a test with the pse at the reference.
inline constexpr char kSecondary[] = "secondary in the results";
[[nodiscard]] std::vector<PlannedName> test_names(const PlannedAnalysis& analysis);

/// One participant's answers in one block. They are empty if the participant did not get the
/// block.
struct PlannedAnswers {
  std::vector<AnswerCount> counts;  ///< The answers of a discrimination.
  /// Ratios or steps at intensities, or intensities at targets or standards.
  MagnitudeAnswers magnitudes;
  /// Whether the posterior of QUEST+ reaches an end of one of its grids.
  bool at_grid_end = false;
};
/// One entry for each block, in the same order.
using PlannedPerson = std::vector<PlannedAnswers>;

struct PlannedEstimate {
  std::optional<double> value;
  Interval ci95;
};
struct PlannedTest {
  /// The first minus the second in ln ln(1 + w). For a contrast it is the effect; a ratio is
  /// given by its logarithm.
  std::optional<double> difference;
  /// Two-sided. For a contrast it has the planned tail and is adjusted. It is absent if the
  /// test is undefined.
  std::optional<double> p_value;
};

/// The outcome of a study with a certain number of participants.
struct PlannedSize {
  std::vector<PlannedEstimate> estimates;
  std::vector<PlannedTest> tests;
  /// For each block, the number of participants who got it.
  std::vector<int> num_with_answers;
  /// For each block, the number of these who have no fit of their own.
  std::vector<int> num_degenerate;
  /// For each block, the number of these with `PlannedAnswers::at_grid_end`.
  std::vector<int> num_at_grid_end;
};
/// One simulated study.
struct PlannedRun {
  std::vector<PlannedSize> sizes;  ///< The outcome at each size.
  /// The outcome under the looks, if some are planned.
  std::optional<SequentialRun> sequential;
};

/// Analyses a study at every size. A size of n uses the first n people. Each person is fitted
/// once, by maximum likelihood (for exponents, by lines through the logarithms).
///
/// The quick route to the median person's Weber fraction is the mean of the individual ln ln(1
/// + w) with Student's interval, transformed back. It uses participants with a fit of their
/// own. The quick test is Student's t on the same numbers, or Welch's if nobody gets both
/// blocks. `discrimination_comparison` reports the same test after that of the hierarchical
/// fit. A second quick test adds half an answer to everybody (`with_half_an_answer`), so nobody
/// is left out. It has more power, but if the levels lie differently about the two references,
/// half an answer moves the two fractions differently.
///
/// A contrast is Student's t of people's own contrasts, or Welch's if there are groups. It uses
/// the same numbers as the quick test; for Weber fractions without a fit, it adds half an
/// answer. `people` are as many as the analysis needs. `levels` holds each person's levels of
/// the factors in which people differ. Only contrasts use it. Not real time.
[[nodiscard]] PlannedRun analyse_run(const PlannedAnalysis& analysis,
                                     const std::vector<PlannedPerson>& people,
                                     const std::vector<experiments::Levels>& levels = {});

}  // namespace jnd::analysis
