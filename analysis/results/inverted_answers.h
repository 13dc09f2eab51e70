#pragma once

#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Who answers the wrong way round: "more", or "felt", the rarer the more there is; or a
/// smaller number, or a smaller intensity for a larger target. Somebody took the question or
/// the keys for each other; every fit calls such answers flat or inverted, and a model of
/// everybody takes them for a very large Weber fraction, and people for far apart. A power law
/// takes them for an exponent below 0, and a group's mean magnitudes for flat.
struct InvertedAnswers {
  std::string participant, block;
  /// Below `kFallingBelow`. Of `falling_p_value`, or, where the answer is a magnitude or an
  /// intensity set, of `falling_ranks_p_value` over the trials: that asks nothing of how
  /// answers scatter or of a law, which the interval of an own exponent does, and has every
  /// answer in it, those of 0 and at intensity 0 as well.
  double p_value = 0.0;
  bool is_estimation = false, is_production = false;
};

/// In blocks of comparisons, of "is it felt?", of magnitude estimation and production.
[[nodiscard]] std::vector<InvertedAnswers> inverted_answers(const StudyData& data);

/// Sets the trials of such blocks of these participants aside, as if by hand, with the reason.
void leave_out_inverted(StudyData& data);

/// Names them in the section of the block, and at every number of the group that has them in
/// it. Those that `leave_out_inverted` set aside are named among the excluded anyway.
void caution_of_inverted(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
