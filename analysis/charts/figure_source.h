#pragma once

#include <string>
#include <vector>

#include "analysis/charts/study_titles.h"
#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// The data from which charts and figures are drawn.
struct FigureSource {
  const StudyData& data;
  const StudyResults& results;
  const StudyTitles& titles;

  /// The section of this name; nullptr if there is none.
  [[nodiscard]] const ResultsSection* section(const std::string& name) const;
  [[nodiscard]] const ParticipantEstimate* own(const std::string& section,
                                               const std::string& participant,
                                               const std::string& estimate) const;
  [[nodiscard]] std::vector<std::string> participants() const;
};

/// Whether the study is one of the thesis, judged by its published values. Its figures then
/// correspond to some of Schmidt (2018), whose terms apply.
[[nodiscard]] bool is_of_thesis(const StudyResults& results);

}  // namespace jnd::analysis
