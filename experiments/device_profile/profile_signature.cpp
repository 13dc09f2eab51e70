#include "experiments/device_profile/profile_signature.h"

#include "core/storage/sha256.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

constexpr const char* kOrigin = "origin";

/// Returns the same form however an editor writes the value: no comments, keys in alphabetical
/// order, and every number as a double, with the fewest digits that identify it (17 at most).
json canonical(const json& value) {
  if (value.is_number()) return value.get<double>() + 0.0;  // Turns -0 into 0.
  if (value.is_array()) {
    json all = json::array();
    for (const json& one : value) all.push_back(canonical(one));
    return all;
  }
  if (!value.is_object()) return value;
  json all = json::object();
  for (const auto& [key, one] : value.items()) {
    if (key != "comment") all[key] = canonical(one);
  }
  return all;
}

std::string origin_text(const json& profile) {
  json origin = json::object();
  for (const char* key : {"device", "measured_on", "program_version", "simulated"}) {
    if (profile.contains(key)) origin[key] = canonical(profile.at(key));
  }
  return origin.dump();
}

}  // namespace

const std::vector<std::string>& signed_parts() {
  static const std::vector<std::string> kParts = {
      kOrigin,     "frame", "measured_limits", "force",     "tool",
      "mechanics", "noise", "delay_s",         "stability", "checks"};
  return kParts;
}

std::string signature_of(const json& profile, const std::string& part) {
  if (part == kOrigin) return core::sha256(origin_text(profile));
  const auto found = profile.find(part);
  if (found == profile.end()) return "";
  return core::sha256(origin_text(profile) + '\n' + part + '\n' + canonical(*found).dump());
}

nlohmann::ordered_json signature_of_all(const json& profile) {
  auto signature = nlohmann::ordered_json::object();
  for (const std::string& part : signed_parts()) {
    if (std::string hash = signature_of(profile, part); !hash.empty()) {
      signature[part] = std::move(hash);
    }
  }
  return signature;
}

}  // namespace jnd::experiments
