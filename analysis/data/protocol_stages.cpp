#include "analysis/data/protocol_stages.h"

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace jnd::analysis {
namespace {

using nlohmann::json;

/// Arms by their counterbalance.
using Arms = std::map<std::string, std::set<std::string>>;

Arms arms_of(const std::string& cells) {
  Arms arms;
  std::istringstream assignments(cells);
  for (std::string one; std::getline(assignments, one, ';');) {
    const std::size_t divider = one.find('=');
    if (divider == one.npos) continue;
    std::set<std::string>& own = arms[one.substr(0, divider)];
    std::istringstream names(one.substr(divider + 1));
    for (std::string name; std::getline(names, name, ',');) own.insert(name);
  }
  return arms;
}

std::string name_of(const json& object) {
  const auto found = object.find("name");
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Whether an arm of this name is in the session, as far as its cells tell.
bool may_have(const Arms& arms, const std::string& counterbalance, const std::string& arm) {
  const auto given = arms.find(counterbalance);
  return given == arms.end() || given->second.contains(arm);
}

bool is_for(const Arms& arms, const json& stage) {
  const auto only_for = stage.find("only_for");
  if (only_for == stage.end() || !only_for->is_object()) return true;
  for (const auto& [counterbalance, arm] : only_for->items()) {
    if (arm.is_string() && !may_have(arms, counterbalance, arm.get<std::string>())) {
      return false;
    }
  }
  return true;
}

void add_stages(const json& object, const char* key, const Arms& arms,
                std::set<std::string>& names) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return;
  for (const json& stage : *found) {
    if (!stage.is_object() || !is_for(arms, stage)) continue;
    names.insert(name_of(stage));
    add_stages(stage, "between", arms, names);
    const auto its_arms = stage.find("arms");
    if (its_arms == stage.end() || !its_arms->is_array()) continue;
    for (const json& arm : *its_arms) {
      if (arm.is_object() && may_have(arms, name_of(stage), name_of(arm))) {
        add_stages(arm, "stages", arms, names);
      }
    }
  }
}

}  // namespace

std::set<std::string> stage_names(const json& protocol) { return stage_names_of(protocol, ""); }

std::set<std::string> stage_names_of(const json& protocol, const std::string& cells) {
  std::set<std::string> names;
  if (protocol.is_object()) add_stages(protocol, "stages", arms_of(cells), names);
  return names;
}

}  // namespace jnd::analysis
