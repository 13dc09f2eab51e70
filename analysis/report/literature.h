#pragma once

#include <set>
#include <string>
#include <vector>

namespace jnd::analysis {

/// The works that a report can cite, in the form of its list of references. It returns those
/// with these citations ("Holm 1979"), by author. Throws `Error` for an unknown citation.
[[nodiscard]] std::vector<std::string> literature_of(const std::set<std::string>& citations);

}  // namespace jnd::analysis
