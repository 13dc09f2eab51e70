#pragma once

#include <map>
#include <string>

namespace jnd::analysis {

/// What a participant's cells, "priming=primed;method_order=estimation,production", say of each
/// counterbalance and field: "primed" of "priming".
[[nodiscard]] std::map<std::string, std::string> arms_of(const std::string& cells);

}  // namespace jnd::analysis
