#pragma once

#include <string>

namespace jnd::analysis {

/// Words that a fit, a test or another lower layer composed of phrases and numbers, such as
/// "paired t" or "probit, pse free, adaptive Gauss-Hermite, 9 nodes a dimension". The catalogue
/// has the phrases, with `{}` for each number. A phrase ends at ", ", "; ", ": " or a bracket;
/// the longest one that the catalogue has is taken, and what it does not have stays as it is.
[[nodiscard]] std::string said_composed(const std::string& english);

}  // namespace jnd::analysis
