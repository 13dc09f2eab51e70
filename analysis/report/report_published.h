#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/charts/study_titles.h"
#include "analysis/report/html_text.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// For example "0.72 ± 0.2" or "> 0"; a dash if nothing was published.
[[nodiscard]] std::string published_words(const Estimate& estimate);

/// Notes that are needed to compare these with what was published; empty if none are needed.
[[nodiscard]] std::vector<std::string> published_notes(
    const std::vector<const Estimate*>& estimates);

/// "calibrated", "implied" or "held out"; a dash if nothing was published.
[[nodiscard]] std::string basis_words(const Estimate& estimate);

/// The unit with no-break spaces; "" for a pure number.
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

/// Every estimate with a published value beside it, one line each.
[[nodiscard]] HtmlTable published_in_short(const StudyResults& results,
                                           const StudyTitles& titles);

/// Every estimate with a published value beside it, how it was published and, if available, the
/// values of simulated studies. It has no rows if nothing was published.
[[nodiscard]] HtmlTable published_table(const StudyResults& results, const StudyTitles& titles);

}  // namespace jnd::analysis
