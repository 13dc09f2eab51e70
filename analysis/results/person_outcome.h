#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// One participant summed up: everything that the statistics of a publication rest on, and
/// little enough to keep of very many simulated people.
struct PersonOutcome {
  std::string cells;  ///< Counterbalancing, as a session keeps it.
  /// Answers by block of comparisons and intensity, both orders of the intervals together.
  std::map<std::string, std::map<double, AnswerCount>> counts;
  /// Arithmetic means of magnitudes as ratios to water (estimation, at intensities) and of the
  /// intensities set (production, at targets in percent), by block.
  std::map<std::string, std::map<double, double>> means;
  /// By the names that results have: "stroke_width_m" and "stroke_width_m.BLOCK" of movement,
  /// "trial_correlation.t1_t2", and "BLOCK.reference" of comparisons.
  std::map<std::string, double> numbers;
};

/// Of everybody in the study, in its order. Excluded trials are left out. Not real time.
[[nodiscard]] std::vector<PersonOutcome> person_outcomes(const StudyData& data);

}  // namespace jnd::analysis
