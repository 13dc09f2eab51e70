#pragma once

#include <map>
#include <utility>
#include <vector>

#include "analysis/fits/psychometric_effects.h"
#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Answers of one participant in one block of comparisons.
struct DiscriminationAnswers {
  std::string participant;
  double reference = 0.0;
  std::map<double, AnswerCount>
      levels;  ///< By intensity, with both orders of the intervals together.
  std::map<std::pair<double, double>, AnswerCount> cells;  ///< By intensity and order.
  std::vector<OrderedAnswers> in_order;                    ///< One a trial.

  /// One for each level and, where either interval may hold the test, order.
  [[nodiscard]] std::vector<AnswerCount> rows() const;
};

/// Everybody's answers in a block; who has none is named. `with_excluded`: those in trials that
/// were set aside as well.
[[nodiscard]] std::vector<DiscriminationAnswers> discrimination_answers(
    const StudyData& data, const BlockDesign& block, bool with_excluded,
    std::vector<ExcludedParticipant>& excluded);

/// The answers with half a "yes" and half a "no" in all added, in equal shares of 1 / (2
/// levels) at every level (after the log-linear correction of Hautus 1995), and multiplied to
/// stay whole, which leaves the estimate as it is. One row a level.
[[nodiscard]] std::vector<AnswerCount> with_half_an_answer(std::vector<AnswerCount> rows);

/// One participant's fit, each order of the intervals with a pse of its own. `corrected`:
/// `with_half_an_answer`, so that answers that separate the stimuli perfectly have a fraction
/// too. It moves every fraction, so it is for those alone who have none. Least squares take
/// both orders of the intervals for one.
struct OwnFitOptions {
  PsychometricMethod method = PsychometricMethod::kMaximumLikelihood;
  bool corrected = false;
  bool free_pse = false;
  bool intervals = false;
  int num_calibration = 0;  ///< As in `PsychometricOptions`.
  int num_goodness = 0;     ///< Redraws for the goodness of fit's p value; 0 leaves it out.
  std::uint64_t seed = 1;   ///< Seed of these redraws.
};
[[nodiscard]] PsychometricFit own_fit(const DiscriminationAnswers& answers,
                                      const OwnFitOptions& options);

/// Why a fit with a Weber fraction has no pse and no order effect, "" where it has: with a free
/// pse answers of one order of the intervals may be all alike.
[[nodiscard]] std::string why_no_pse(const PsychometricFit& fit);

/// Everybody's answers in the form in which the hierarchical fit takes them.
[[nodiscard]] std::vector<ParticipantAnswers> participant_answers(
    const std::vector<DiscriminationAnswers>& all, const std::string& condition);

}  // namespace jnd::analysis
