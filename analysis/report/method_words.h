#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/report/report.h"

namespace jnd::analysis {

/// How the numbers of a report were computed, only as far as this study has them. Formulas are
/// plain text.
struct MethodWords {
  std::vector<std::pair<std::string, std::string>> topics;  ///< Each topic with its paragraph.
  std::vector<std::string> references;  ///< The works that the paragraphs cite, by author.
};

[[nodiscard]] MethodWords method_words(const ReportSource& source);

}  // namespace jnd::analysis
