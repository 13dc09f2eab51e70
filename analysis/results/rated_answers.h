#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// One answer that has an order: the step of a rating, the step or number of a question.
struct RatedAnswer {
  double value = 0.0;
  std::optional<double> level;        ///< Test stimulus; none of a catch trial.
  std::optional<double> distance_ln;  ///< |ln(test / reference)|, where both are above 0.
  std::optional<bool> was_right;      ///< The answer to the trial, where one can be right.
};

/// By participant.
using RatedAnswers = std::map<std::string, std::vector<RatedAnswer>>;

/// How an estimate of such answers is named and told.
struct RatedName {
  std::string prefix;  ///< "group_d.question.confidence"
  std::string
      words;  ///< "step from 1, \"I guessed\", to 5, \"wholly sure\": How sure are you?"
  std::string unit = "1";
  bool has_fixed_levels = false;  ///< So that there is a mean at each.
};

/// Spearman's rank correlation, ties sharing the mean of their ranks; none of fewer than three
/// pairs, or where all of one side are equal.
[[nodiscard]] std::optional<double> rank_correlation(const std::vector<double>& a,
                                                     const std::vector<double>& b);

/// The area under the type 2 ROC (Fleming and Lau 2014): the probability that a right answer,
/// drawn at random, was given with more confidence than a wrong one, ties counting half. None
/// without a right or without a wrong one.
[[nodiscard]] std::optional<double> type_2_auroc(const std::vector<RatedAnswer>& answers);

/// Adds the mean over participants of their means with Student's interval, PREFIX; the standard
/// deviation between participants (.sd); the median of their medians (.median); how the answers
/// go with the stimulus, as the mean of the participants' own rank correlations
/// (.rank_correlation), in blocks with a reference also with how far the two are apart
/// (.rank_correlation_with_difference); where levels are fixed, mean and median at each
/// (.mean_at_X, .median_at_X); where an answer can be right, means of right and of wrong ones
/// (.when_right, .when_wrong), their difference, and the area under the type 2 ROC
/// (.type_2_auroc). Those of relations have a t test each, family `kQuestionsFamily`.
void add_rated(ResultsSection& section, const RatedName& name, const RatedAnswers& answers);

/// The relation of the answers with the stimulus in steps, too: the mean over participants of
/// the slope of the answer over log2 of the stimulus, PREFIX.per_doubling. Stimuli of 0 have no
/// logarithm and are left out.
void add_trend_per_doubling(ResultsSection& section, const RatedName& name,
                            const RatedAnswers& answers);

}  // namespace jnd::analysis
