#pragma once

#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// A participant who answers the wrong way round. "More" or "felt" becomes rarer as the
/// intensity grows, numbers become smaller, or smaller intensities are set for larger targets.
/// The participant has confused the question or the keys. Single fits call such answers flat or
/// inverted. A model of everybody sees a very large Weber fraction and large differences
/// between people. A power law gets an exponent below 0, and mean magnitudes of the group
/// become flat.
struct InvertedAnswers {
  std::string participant, block;
  /// The p value, which is below `kFallingBelow`. It comes from `falling_p_value` or, if the
  /// answer is a magnitude or a set intensity, from `falling_ranks_p_value` over the trials.
  /// The latter assumes neither a law nor how answers scatter, unlike the interval of an own
  /// exponent. It uses every answer, including answers of 0 and at intensity 0.
  double p_value = 0.0;
  bool is_estimation = false, is_production = false;
};

/// The participants who answer the wrong way round in blocks of comparisons, of "is it felt?",
/// and of magnitude estimation and production.
[[nodiscard]] std::vector<InvertedAnswers> inverted_answers(const StudyData& data);

/// Sets the trials of these participants in these blocks aside, as if by hand, with the reason.
void leave_out_inverted(StudyData& data);

/// Names them in the section of the block, and in a caution at every group value that includes
/// them. Those that `leave_out_inverted` set aside are among the excluded participants already.
void caution_of_inverted(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
