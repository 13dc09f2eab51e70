#include "analysis/results/block_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/results/number_words.h"
#include "analysis/words/said.h"
#include "experiments/procedures/procedure_registry.h"

namespace jnd::analysis {
namespace {

using experiments::Block;
using experiments::Settings;

/// The fewest digits that represent the value.
std::string general(double value) { return with_decimal_sign(fmt::format("{:g}", value)); }

std::string staircase_words(const Settings& given) {
  const auto count = static_cast<int>(given.numbers("start").size());
  const double ratio = given.number("down_per_up_ratio");
  return said("{}, {} up {} down{}, {}to {} reversals or {} trials",
              counted_words(count, "staircase"), given.integer("num_up"),
              given.integer("num_down"),
              ratio == 1.0 ? "" : said(", steps down {} times those up", general(ratio)),
              count == 1 ? "" : said("each "), given.integer("max_reversals"),
              given.integer("max_trials"));
}

}  // namespace

std::string list_of(const std::vector<double>& values, const std::string& unit) {
  std::string list;
  for (const double value : values) {
    list += (list.empty() ? "" : between_numbers()) + general(value);
  }
  return list + (unit.empty() ? "" : " " + unit);
}

bool length_is_expected(const Block& block) {
  return experiments::procedure_named(block.procedure).adapts();
}

std::string trials_to_expect(const Block& block, int num_trials) {
  return (length_is_expected(block) ? said("about ") : "") + std::to_string(num_trials);
}

std::string stimulus_words(const experiments::PlannedTrial& trial) {
  if (trial.intensity) return general(*trial.intensity);
  const double start = trial.starting_intensity.value_or(0.0);
  return trial.reference_intensity
             ? said("{} (from {})", general(*trial.reference_intensity), general(start))
             : general(start);
}

std::string adaptive_words(const Block& block) {
  const auto num_levels = static_cast<int>(block.intensities.size());
  if (block.procedure == "staircase") return staircase_words(block.settings);
  if (block.procedure == "limits") {
    return said("{} series over {}", block.settings.integer("num_series"),
                counted_words(num_levels, "level"));
  }
  if (block.procedure == "quest_plus") {
    return said("QUEST+ over {}", counted_words(num_levels, "level"));
  }
  std::string words = said_of(experiments::procedure_named(block.procedure).words());
  if (num_levels == 0) return words;
  return said("{} over {}", words, counted_words(num_levels, "level"));
}

std::vector<std::string> adaptive_level_words(const Block& block, const std::string& unit) {
  const std::vector<double> possible =
      experiments::procedure_named(block.procedure).possible_intensities(block);
  const auto [lowest, highest] = std::ranges::minmax(possible);
  std::vector<std::string> lines = {said("from {} to {}{}", general(lowest), general(highest),
                                         unit.empty() ? "" : " " + unit)};
  if (block.procedure != "staircase") {
    if (!block.intensities.empty()) {
      lines.push_back(said("levels {}", list_of(block.intensities, unit)));
    }
    return lines;
  }
  lines.push_back(said("starting at {}", list_of(block.settings.numbers("start"), unit)));
  const bool is_ratio = block.settings.word("level_scale") == "logarithmic";
  lines.push_back(
      is_ratio
          ? said("steps by the factors {}", list_of(block.settings.numbers("step_ratio"), ""))
          : said("steps of {}", list_of(block.settings.numbers("step"), unit)));
  return lines;
}

std::string adaptive_design_words(const Block& block, const std::string& unit) {
  std::string words = adaptive_words(block);
  if (block.procedure == "staircase") {
    words += said(", the last {} reversals averaged",
                  block.settings.integer("num_reversals_averaged"));
  }
  for (const std::string& line : adaptive_level_words(block, unit)) words += "; " + line;
  return words;
}

}  // namespace jnd::analysis
