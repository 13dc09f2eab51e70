#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace jnd::experiments {

/// Returns the names of the signed parts of a profile. The first is "origin", which stands for
/// `device`, `measured_on`, `program_version` and `simulated`. The others are keys of the whole
/// file.
[[nodiscard]] const std::vector<std::string>& signed_parts();

/// Returns the SHA-256 of a part of this profile, or "" if it lacks the part. Comments and the
/// notation of numbers do not matter. The origin enters the signature of every other part, so
/// that none can be copied from another measurement. Not real time.
[[nodiscard]] std::string signature_of(const nlohmann::json& profile, const std::string& part);

/// Returns the object for the key `signature`. Not real time.
[[nodiscard]] nlohmann::ordered_json signature_of_all(const nlohmann::json& profile);

}  // namespace jnd::experiments
