#include "analysis/results/published.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "analysis/data/stored_studies.h"
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

/// The entry of a table that the word names.
template <typename Value, std::size_t kSize>
Value named(const nlohmann::json& object, const char* key,
            const std::pair<const char*, Value> (&table)[kSize]) {
  const auto word = object.at(key).get<std::string>();
  for (const auto& [name, value] : table) {
    if (word == name) return value;
  }
  throw core::Error(std::string(key) + " `" + word + "`, which nobody knows");
}

PublishedStatistic statistic_of(const nlohmann::json& entry) {
  using Kind = PublishedStatistic::Kind;
  using Summary = PublishedStatistic::Summary;
  constexpr std::pair<const char*, Kind> kKinds[] = {
      {"pooled_weber_fraction", Kind::kPooledWeberFraction},
      {"own_weber_fractions", Kind::kOwnWeberFractions},
      {"num_own_above_pooled", Kind::kNumOwnAbovePooled},
      {"estimation_power_law", Kind::kEstimationPowerLaw},
      {"production_power_law", Kind::kProductionPowerLaw},
      {"combined_power_law", Kind::kCombinedPowerLaw},
      {"production_ratio", Kind::kProductionRatio},
      {"numbers", Kind::kNumbers},
      {"difference_of_means", Kind::kDifferenceOfMeans}};
  constexpr std::pair<const char*, Summary> kSummaries[] = {{"mean", Summary::kMean},
                                                            {"sd", Summary::kStandardDeviation},
                                                            {"median", Summary::kMedian}};
  constexpr std::pair<const char*, bool> kParameters[] = {{"k", false}, {"a", true}};
  PublishedStatistic statistic{.kind = named(entry, "kind", kKinds)};
  const auto text = [&](const char* key) { return entry.at(key).get<std::string>(); };
  switch (statistic.kind) {
    case Kind::kNumOwnAbovePooled:
      statistic.other_block = text("pooled");
      [[fallthrough]];
    case Kind::kPooledWeberFraction:
      statistic.block = text("block");
      break;
    case Kind::kOwnWeberFractions:
      statistic.block = text("block");
      statistic.summary = named(entry, "summary", kSummaries);
      break;
    case Kind::kCombinedPowerLaw:
      statistic.block = text("estimation");
      statistic.other_block = text("production");
      statistic.is_exponent = named(entry, "parameter", kParameters);
      break;
    case Kind::kEstimationPowerLaw:
    case Kind::kProductionPowerLaw:
      statistic.block = text("block");
      statistic.is_exponent = named(entry, "parameter", kParameters);
      break;
    case Kind::kProductionRatio:
      statistic.block = text("block");
      statistic.high_target = entry.at("high").get<double>();
      statistic.low_target = entry.at("low").get<double>();
      statistic.summary = named(entry, "summary", kSummaries);
      break;
    case Kind::kNumbers:
      statistic.names = entry.at("names").get<std::vector<std::string>>();
      statistic.summary = named(entry, "summary", kSummaries);
      break;
    case Kind::kDifferenceOfMeans:
      statistic.names = entry.at("names").get<std::vector<std::string>>();
      if (statistic.names.size() != 2) throw core::Error("a difference of other than two");
      break;
  }
  return statistic;
}

/// Words of an entry: a text, or one for each language.
std::string published_words(const nlohmann::json& entry, const char* key) {
  if (!entry.contains(key)) return "";
  const nlohmann::json& words = entry.at(key);
  return words.is_string() ? words.get<std::string>()
                           : in_spoken_language(words.get<experiments::Text>());
}

PublishedValue value_of(const nlohmann::json& entry) {
  PublishedValue value{.positive = entry.value("positive", false),
                       .place = entry.value("place", ""),
                       .unit = entry.value("unit", "1"),
                       .statistic = published_words(entry, "statistic"),
                       .follows_from_others = entry.value("follows_from_others", false)};
  if (!value.positive) value.value = entry.at("value").get<double>();
  if (entry.contains("sd")) value.standard_deviation = entry.at("sd").get<double>();
  if (entry.contains("decimals")) value.num_decimals = entry.at("decimals").get<int>();
  if (entry.contains("n")) value.n = entry.at("n").get<int>();
  if (entry.contains("compute")) value.compute = statistic_of(entry.at("compute"));
  return value;
}

}  // namespace

Published published_for(const std::string& study, const fs::path& folder) {
  for (const fs::path& file : files_in(folder)) {
    try {
      std::ifstream stream(file);
      const nlohmann::json content = nlohmann::json::parse(stream);
      const nlohmann::json& studies = content.at("studies");
      if (!studies.contains(study)) continue;
      Published published{.citation = content.at("citation").get<std::string>(),
                          .num_participants = content.value("participants", 0)};
      for (const auto& [name, entry] : studies.at(study).items()) {
        published.values[name] = value_of(entry);
      }
      return published;
    } catch (const std::exception& error) {
      throw core::Error(file.string() + ": expected published values, found: " + error.what());
    }
  }
  return {};
}

}  // namespace jnd::analysis
