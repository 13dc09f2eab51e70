#include "analysis/data/protocol_blocks.h"

#include "analysis/data/json_fields.h"

namespace jnd::analysis {
namespace {

using nlohmann::json;

ProtocolBlock block_of(const json& stage) {
  ProtocolBlock block;
  block.task = string_at(stage, "task", block.task);
  block.interval_order = string_at(stage, "interval_order", block.interval_order);
  block.is_practice = stage.contains("practice");
  const auto feedback = stage.find("feedback");
  block.feedback = feedback != stage.end() && feedback->is_boolean() && feedback->get<bool>();
  block.modulus = string_at(stage, "modulus", block.modulus);
  const auto number = stage.find("modulus_value");
  if (number != stage.end() && number->is_number() && number->get<double>() > 0.0) {
    block.modulus_value = number->get<double>();
  }
  const std::string medium = string_at(stage, "standard_medium", "none");
  if (medium == "none") return block;
  block.standard_medium = medium;
  const std::string start = "standard_";
  for (const auto& [key, value] : stage.items()) {
    // Its amount is the one list that begins so: "standard_scale".
    if (key.starts_with(start) && value.is_array()) {
      block.standard_quantity = key.substr(start.size());
    }
  }
  return block;
}

void add_blocks(const json& object, const char* key,
                std::map<std::string, ProtocolBlock>& blocks) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return;
  for (const json& stage : *found) {
    if (!stage.is_object()) continue;
    if (string_at(stage, "kind") == "block") {
      ProtocolBlock block = block_of(stage);
      block.place = static_cast<int>(blocks.size());
      blocks[string_at(stage, "name")] = std::move(block);
    }
    for (const char* nested : {"arms", "stages", "between"}) add_blocks(stage, nested, blocks);
  }
}

}  // namespace

std::map<std::string, ProtocolBlock> protocol_blocks(const json& protocol) {
  std::map<std::string, ProtocolBlock> blocks;
  add_blocks(protocol, "stages", blocks);
  return blocks;
}

}  // namespace jnd::analysis
