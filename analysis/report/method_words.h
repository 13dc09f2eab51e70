#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/report/report.h"

namespace jnd::analysis {

/// How the numbers of a report came about: only what this study has. Formulas are plain text.
struct MethodWords {
  std::vector<std::pair<std::string, std::string>> topics;  ///< A topic and its paragraph.
  std::vector<std::string> references;  ///< Of what the paragraphs cite, by author.
};

[[nodiscard]] MethodWords method_words(const ReportSource& source);

}  // namespace jnd::analysis
