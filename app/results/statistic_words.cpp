#include "app/results/statistic_words.h"

#include <fmt/format.h>

namespace jnd::app {

std::string statistic_words(const analysis::Comparison& comparison) {
  using Kind = analysis::Comparison::Kind;
  if (!comparison.statistic) return "";
  if (comparison.kind == Kind::kDispersion) {
    return fmt::format("{} = {:.2f} on {:.0f}", comparison.statistic_name,
                       *comparison.statistic, comparison.degrees_of_freedom.value_or(0.0));
  }
  std::string words;
  for (const auto& [name, value] : comparison.all_statistics()) {
    if (!words.empty()) words += ", ";
    if (name == "t" && comparison.degrees_of_freedom) {
      words += fmt::format("t({:.4g}) = {:.2f}", *comparison.degrees_of_freedom, value);
    } else {
      words += fmt::format("{} = {:.6g}", name, value);
    }
  }
  return words;
}

std::string statistic_title(const std::string& name) {
  if (name == "V") return "V, sum of ranks with a > b";
  if (name == "T") return "T, smaller sum of ranks";
  if (name == "U") return "U of a (R: W)";
  return name == "S" ? "S, (n^3 - n)(1 - r) / 6" : name;
}

}  // namespace jnd::app
