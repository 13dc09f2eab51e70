#pragma once

#include <set>
#include <string>
#include <vector>

namespace jnd::analysis {

/// The works that a report can cite, as they stand in its list: of these citations ("Holm
/// 1979"), by author. Throws `Error` for a citation of something unknown.
[[nodiscard]] std::vector<std::string> literature_of(const std::set<std::string>& citations);

}  // namespace jnd::analysis
