#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace jnd::app {

/// Returns a study file in which every level of each block is repeated `repetitions` times.
inline std::string shortened_study(const std::filesystem::path& file, int repetitions) {
  std::ifstream stream(file);
  nlohmann::json study = nlohmann::json::parse(stream);
  const auto shorten = [repetitions](auto& self, nlohmann::json& part) -> void {
    if (part.is_object() && part.contains("repetitions")) part["repetitions"] = repetitions;
    if (!part.is_structured()) return;
    for (nlohmann::json& inner : part) self(self, inner);
  };
  shorten(shorten, study);
  return study.dump();
}

}  // namespace jnd::app
