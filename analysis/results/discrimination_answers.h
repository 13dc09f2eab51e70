#pragma once

#include <map>
#include <utility>
#include <vector>

#include "analysis/fits/psychometric_effects.h"
#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// The answers of one participant in one block of comparisons.
struct DiscriminationAnswers {
  std::string participant;
  double reference = 0.0;
  std::map<double, AnswerCount>
      levels;  ///< By intensity, with both orders of the intervals pooled.
  std::map<std::pair<double, double>, AnswerCount> cells;  ///< By intensity and order.
  std::vector<OrderedAnswers> in_order;                    ///< One entry for each trial.

  /// One row for each level or, if either interval may hold the test, for each level and order.
  [[nodiscard]] std::vector<AnswerCount> rows() const;
};

/// Everybody's answers in a block. Participants without answers are added to `excluded`.
/// `with_excluded` includes answers in trials that were set aside.
[[nodiscard]] std::vector<DiscriminationAnswers> discrimination_answers(
    const StudyData& data, const BlockDesign& block, bool with_excluded,
    std::vector<ExcludedParticipant>& excluded);

/// Adds half a "yes" and half a "no" in total to the answers, in equal shares of 1 / (2 levels)
/// at every level (after the log-linear correction of Hautus 1995). All counts are multiplied
/// so that they stay whole, which does not change the estimate. There is one row for each
/// level.
[[nodiscard]] std::vector<AnswerCount> with_half_an_answer(std::vector<AnswerCount> rows);

/// How one participant is fitted. Each order of the intervals has a pse of its own; least
/// squares pools both orders. `corrected` applies `with_half_an_answer`, so that answers that
/// separate the stimuli perfectly have a Weber fraction too. It changes every fraction, so it
/// is meant only for participants who have none.
struct OwnFitOptions {
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  bool corrected = false;
  bool free_pse = false;
  bool intervals = false;
  int num_calibration = 0;  ///< See `PsychometricOptions`.
  /// The number of redraws for the p value of the goodness of fit; 0 for none.
  int num_goodness = 0;
  std::uint64_t seed = 1;  ///< The seed of these redraws.
};
[[nodiscard]] PsychometricFit own_fit(const DiscriminationAnswers& answers,
                                      const OwnFitOptions& options);

/// Why a fit with a Weber fraction has no pse and no order effect; "" if it has them. With a
/// free pse, all answers in one order of the intervals may be alike.
[[nodiscard]] std::string why_no_pse(const PsychometricFit& fit);

/// Everybody's answers in the form that the hierarchical fit needs.
[[nodiscard]] std::vector<ParticipantAnswers> participant_answers(
    const std::vector<DiscriminationAnswers>& all, const std::string& condition);

}  // namespace jnd::analysis
