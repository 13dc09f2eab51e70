#include "analysis/results/primary_results.h"

#include <algorithm>
#include <string>
#include <vector>

namespace jnd::analysis {
namespace {

/// The endings of names, after the block's name.
std::vector<std::string> primary_names(const BlockDesign& block) {
  if (block.estimates()) {
    // With everybody's own numbers, their size has no meaning.
    if (block.counts_in_own_numbers()) return {".a"};
    return {".k", ".a"};
  }
  if (block.produces()) return {".k", ".a"};
  if (block.matches()) {
    return block.standard_is_of_its_quantity() ? std::vector<std::string>{".ratio_to_standard"}
                                               : std::vector<std::string>{".k", ".a"};
  }
  if (block.identifies()) return {".weber_fraction"};
  if (block.rates()) return {".rating.per_doubling"};
  if (block.rule == AdaptiveRule::kLimits && block.compares()) {
    return {".limits_threshold", ".weber_fraction_median_person"};
  }
  // Of any procedure the same, as the tests between blocks have it.
  if (block.compares()) return {".weber_fraction_median_person"};
  if (block.is_adaptive()) return {"." + block.procedure + "_threshold"};
  if (block.detects()) return {".threshold"};
  if (block.tells_apart()) return {".weber_fraction"};
  return {};
}

bool is_primary(const std::string& name, const StudyData& data) {
  if (name == "combined.k" || name == "combined.a") return true;
  return std::ranges::any_of(data.blocks, [&](const BlockDesign& block) {
    return std::ranges::any_of(primary_names(block), [&](const std::string& end) {
      return name == block.block + end;
    });
  });
}

/// The endings of names of the participants' own values that correspond to the primary ones,
/// after the block's name.
std::vector<std::string> own_primary_names(const BlockDesign& block, bool free_pse) {
  std::vector<std::string> names = primary_names(block);
  std::ranges::replace(names, std::string(".weber_fraction_median_person"),
                       std::string(free_pse ? ".weber_fraction_free_pse" : ".weber_fraction"));
  return names;
}

void mark_own(ResultsSection& section, const StudyData& data) {
  for (const BlockDesign& block : data.blocks) {
    for (const std::string& end : own_primary_names(block, section.own_fractions_free_pse)) {
      for (ParticipantEstimate& own : section.participants) {
        own.primary = own.primary || own.name == block.block + end;
      }
    }
  }
}

}  // namespace

void mark_primary(StudyResults& results, const StudyData& data) {
  for (ResultsSection& section : results.sections) {
    for (Estimate& estimate : section.estimates) {
      estimate.primary = is_primary(estimate.name, data);
    }
    mark_own(section, data);
  }
}

}  // namespace jnd::analysis
