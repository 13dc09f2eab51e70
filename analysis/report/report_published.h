#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/charts/study_titles.h"
#include "analysis/report/html_text.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// "0.72 ± 0.2", "> 0"; a dash for what nobody published.
[[nodiscard]] std::string published_words(const Estimate& estimate);

/// What has to be known to compare these with what was published; nothing where that is plain.
[[nodiscard]] std::vector<std::string> published_notes(
    const std::vector<const Estimate*>& estimates);

/// "calibrated", "implied" or "held out"; a dash for what nobody published.
[[nodiscard]] std::string basis_words(const Estimate& estimate);

/// Not torn apart at the end of a line; "" of a pure number.
[[nodiscard]] std::string unit_words(const std::string& unit);

/// The estimates of all sections for which the condition holds.
template <typename Condition>
std::vector<const Estimate*> estimates_where(const StudyResults& results, Condition condition) {
  std::vector<const Estimate*> found;
  for (const ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (std::invoke(condition, estimate)) found.push_back(&estimate);
    }
  }
  return found;
}

/// Everything that has a published value, beside it, a line each.
[[nodiscard]] HtmlTable published_in_short(const StudyResults& results,
                                           const StudyTitles& titles);

/// Everything that has a published value, beside it, how it was published, and what simulated
/// studies come to where that is known; without rows where nothing was published.
[[nodiscard]] HtmlTable published_table(const StudyResults& results, const StudyTitles& titles);

}  // namespace jnd::analysis
