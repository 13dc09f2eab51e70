#pragma once

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>

namespace jnd::analysis {

/// Names of the blocks and other stages of a study file, those of every arm among them. What
/// does not look like a stage is passed over: the reader of study files has checked it.
[[nodiscard]] std::set<std::string> stage_names(const nlohmann::json& protocol);

/// Those of a session in these cells ("sex=female;priming=primed"). A counterbalance that the
/// cells do not name hides nothing.
[[nodiscard]] std::set<std::string> stage_names_of(const nlohmann::json& protocol,
                                                   const std::string& cells);

}  // namespace jnd::analysis
