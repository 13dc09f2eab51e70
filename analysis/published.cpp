#include "analysis/published.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code no_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, no_folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Published published_for(const std::string& study, const fs::path& folder) {
  for (const fs::path& file : files_in(folder)) {
    try {
      std::ifstream stream(file);
      const nlohmann::json content = nlohmann::json::parse(stream);
      const nlohmann::json& studies = content.at("studies");
      if (!studies.contains(study)) continue;
      Published published{.citation = content.at("citation").get<std::string>()};
      for (const auto& [name, entry] : studies.at(study).items()) {
        PublishedValue& value = published.values[name];
        value.positive = entry.value("positive", false);
        if (!value.positive) value.value = entry.at("value").get<double>();
        if (entry.contains("sd")) value.standard_deviation = entry.at("sd").get<double>();
        value.place = entry.value("place", "");
      }
      return published;
    } catch (const nlohmann::json::exception& error) {
      throw core::Error(file.string() + ": expected published values, found: " + error.what());
    }
  }
  return {};
}

}  // namespace jnd::analysis
