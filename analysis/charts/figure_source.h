#pragma once

#include <string>
#include <vector>

#include "analysis/charts/study_titles.h"
#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// What charts and figures are drawn from.
struct FigureSource {
  const StudyData& data;
  const StudyResults& results;
  const StudyTitles& titles;

  /// Nullptr if there is none of this name.
  [[nodiscard]] const ResultsSection* section(const std::string& name) const;
  [[nodiscard]] const ParticipantEstimate* own(const std::string& section,
                                               const std::string& participant,
                                               const std::string& estimate) const;
  [[nodiscard]] std::vector<std::string> participants() const;
};

/// Whether the study is one of the thesis', by its published values: figures answer some of
/// Schmidt (2018), and words of that author have a meaning.
[[nodiscard]] bool is_of_thesis(const StudyResults& results);

}  // namespace jnd::analysis
