#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// One answer that has an order: the step of a rating, or the step or number of a question.
struct RatedAnswer {
  double value = 0.0;
  std::optional<double> level;        ///< The test stimulus; absent for a catch trial.
  std::optional<double> distance_ln;  ///<     ln(test / reference)|, if both are above 0.
  /// Whether the answer to the trial was right; absent if no answer can be right.
  std::optional<bool> was_right;
};

/// The answers by participant.
using RatedAnswers = std::map<std::string, std::vector<RatedAnswer>>;

/// The name and meaning of an estimate from such answers.
struct RatedName {
  std::string prefix;  ///< For example "group_d.question.confidence".
  std::string
      /// For example "step from 1, \"I guessed\", to 5, \"wholly sure\": How sure are you?".
      words;
  std::string unit = "1";
  /// Whether the levels are fixed, so that there is a mean at each.
  bool has_fixed_levels = false;
};

/// Spearman's rank correlation with midranks. It is absent for fewer than three pairs, or if
/// all values on one side are equal.
[[nodiscard]] std::optional<double> rank_correlation(const std::vector<double>& a,
                                                     const std::vector<double>& b);

/// The area under the type 2 ROC (Fleming and Lau 2014): the probability that a randomly drawn
/// right answer was given with more confidence than a wrong one, where ties count half. It is
/// absent without right or without wrong answers.
[[nodiscard]] std::optional<double> type_2_auroc(const std::vector<RatedAnswer>& answers);

/// Adds these estimates:
///
/// - PREFIX: the mean over participants of their means, with Student's interval;
/// - .sd: the standard deviation between participants;
/// - .median: the median of their medians;
/// - .rank_correlation: the relation of the answers with the stimulus, as the mean of the
///   participants' own rank correlations;
/// - .rank_correlation_with_difference: in blocks with a reference, the relation with the
///   distance between test and reference;
/// - .mean_at_X and .median_at_X: mean and median at each level, if levels are fixed;
/// - .when_right and .when_wrong: if an answer can be right, the means of right and of wrong
///   answers, with their difference;
/// - .type_2_auroc: the area under the type 2 ROC.
///
/// Each relation has a t test in the family `kQuestionsFamily`.
void add_rated(ResultsSection& section, const RatedName& name, const RatedAnswers& answers);

/// Also adds PREFIX.per_doubling, the relation with the stimulus in steps: the mean over
/// participants of the slope of the answer over log2 of the stimulus. Stimuli of 0 have no
/// logarithm and are left out.
void add_trend_per_doubling(ResultsSection& section, const RatedName& name,
                            const RatedAnswers& answers);

}  // namespace jnd::analysis
