#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// A summary of one participant with everything that the statistics of a publication need. It
/// is small, so very many simulated people can be kept.
struct PersonOutcome {
  std::string cells;  ///< The counterbalancing cells, as a session stores them.
  /// Answers by block of comparisons and by intensity, with both orders of the intervals
  /// pooled.
  std::map<std::string, std::map<double, AnswerCount>> counts;
  /// Arithmetic means by block: of magnitudes as ratios to water (estimation, by intensity),
  /// and of the intensities that were set (production, by target in percent).
  std::map<std::string, std::map<double, double>> means;
  /// Numbers by the names of the results: "stroke_width_m" and "stroke_width_m.BLOCK" for
  /// movement, "trial_correlation.t1_t2", and "BLOCK.reference" for comparisons.
  std::map<std::string, double> numbers;
};

/// The outcomes of everybody in the study, in its order. Excluded trials are left out.
/// Not real time.
[[nodiscard]] std::vector<PersonOutcome> person_outcomes(const StudyData& data);

}  // namespace jnd::analysis
