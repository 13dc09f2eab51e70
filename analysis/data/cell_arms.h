#pragma once

#include <map>
#include <string>

namespace jnd::analysis {

/// Splits a participant's cells, such as "priming=primed;method_order=estimation,production",
/// into the arm of each counterbalance and field: "primed" for "priming".
[[nodiscard]] std::map<std::string, std::string> arms_of(const std::string& cells);

}  // namespace jnd::analysis
