#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace jnd::experiments {

/// The parts of a profile that are signed: "origin", which is `device`, `measured_on`,
/// `program_version` and `simulated`, and then keys of the whole file.
[[nodiscard]] const std::vector<std::string>& signed_parts();

/// SHA-256 of a part of this profile, or "" where it has no such part. Comments do not count,
/// nor does how a number is written; the origin goes into the signature of every other part, so
/// that none can be taken over from another measurement. Not real time.
[[nodiscard]] std::string signature_of(const nlohmann::json& profile, const std::string& part);

/// The object for the key `signature`. Not real time.
[[nodiscard]] nlohmann::ordered_json signature_of_all(const nlohmann::json& profile);

}  // namespace jnd::experiments
