#include "experiments/procedures/contrast_conditions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/order/cell.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using Weights = std::map<std::string, double>;

/// Above 0 they add up to 1, below 0 to -1.
Weights scaled(Weights weights) {
  double above = 0.0, below = 0.0;
  for (const auto& [level, weight] : weights) (weight > 0.0 ? above : below) += weight;
  for (auto& [level, weight] : weights) weight /= weight > 0.0 ? above : -below;
  return weights;
}

/// A block with the measure, and its levels, its own name as that of `block`.
struct LevelledBlock {
  std::string name;
  Levels levels;
};

std::vector<LevelledBlock> blocks_with(const Study& study, ContrastMeasure measure) {
  std::vector<LevelledBlock> found;
  for_each_stage(study.stages, [&](const Stage& stage) {
    const auto* block = std::get_if<Block>(&stage.content);
    if (block == nullptr || !has_measure(*block, measure)) return;
    Levels levels = block->levels;
    levels[kBlockFactor] = stage.name;
    found.push_back({stage.name, std::move(levels)});
  });
  return found;
}

/// The weight that a factor gives what has these levels: 0 for what has none of its levels.
double weight_of(const std::string& factor, const Weights& weights, const Levels& levels) {
  const auto level = levels.find(factor);
  if (level == levels.end()) return 0.0;
  const auto weight = weights.find(level->second);
  return weight == weights.end() ? 0.0 : weight->second;
}

std::string name_of(const Levels& levels, const std::string& blocks) {
  std::string name;
  for (const auto& [factor, level] : levels) name += (name.empty() ? "" : ", ") + level;
  return name.empty() ? blocks : name;
}

/// Everything that the factors of people can be together.
std::vector<ContrastGroup> groups_of(const std::vector<const DesignFactor*>& factors) {
  std::vector<ContrastGroup> groups = {{}};
  for (const DesignFactor* factor : factors) {
    std::vector<ContrastGroup> crossed;
    for (const ContrastGroup& group : groups) {
      for (const std::string& level : factor->levels) {
        crossed.push_back(group);
        crossed.back().levels[factor->name] = level;
        crossed.back().name += (group.name.empty() ? "" : ", ") + level;
      }
    }
    groups = std::move(crossed);
  }
  return groups;
}

}  // namespace

bool is_between_people(const Study& study, const std::string& factor) {
  return std::ranges::any_of(factors_of(study), [&](const Factor& one) {
    const bool is_square = std::ranges::any_of(one.alternatives, [](const auto& arms) {
      return arms.size() != 1 || arms.front().starts_with("row_");
    });
    return one.name == factor && !is_square;
  });
}

bool has_measure(const Block& block, ContrastMeasure measure) {
  if (block.practice) return false;
  const Procedure& procedure = procedure_named(block.procedure);
  const Measure measures = procedure.measures(block);
  switch (measure) {
    case ContrastMeasure::kWeberFraction:
      return measures == Measure::kComparison;
    case ContrastMeasure::kPse:
      return measures == Measure::kComparison && !procedure.form(block).order_is_drawn;
    case ContrastMeasure::kExponent:
      return measures == Measure::kMagnitude || measures == Measure::kProducedMagnitude;
    case ContrastMeasure::kMagnitude:
      return measures == Measure::kMagnitude;
    case ContrastMeasure::kMatch:
      return measures == Measure::kMatch;
    case ContrastMeasure::kResponseTime:
      return true;
  }
  return false;
}

ContrastConditions contrast_conditions(const Study& study, const PlannedContrast& contrast) {
  ContrastConditions found;
  std::map<std::string, Weights> by_factor;
  bool compares = false;
  for (const auto& [factor, weights] : contrast.weights) {
    by_factor[factor] = scaled(weights);
    compares |= std::ranges::any_of(weights, [](const auto& one) { return one.second < 0.0; });
  }
  if (!compares) {
    found.problem = "expected a factor with weights above and below 0, found none";
    return found;
  }
  std::vector<const DesignFactor*> between;
  std::vector<std::string> within;
  for (const DesignFactor& factor : study.factors) {
    if (is_between_people(study, factor.name)) {
      between.push_back(&factor);
    } else {
      within.push_back(factor.name);
    }
  }
  const bool by_block = contrast.weights.contains(kBlockFactor);

  // Blocks that have any weight, taken together by their levels.
  std::map<Levels, std::size_t> place_of;
  std::vector<Levels> levels_of;
  std::vector<double> condition_weights;
  for (const LevelledBlock& block : blocks_with(study, contrast.measure)) {
    double weight = 1.0;
    Levels own, named;
    for (const std::string& factor : within) {
      const auto level = block.levels.find(factor);
      if (level != block.levels.end()) own[factor] = level->second;
    }
    if (by_block) own[kBlockFactor] = block.name;
    for (const auto& [factor, weights] : by_factor) {
      if (is_between_people(study, factor)) continue;
      weight *= weight_of(factor, weights, block.levels);
      const auto level = block.levels.find(factor);
      if (level != block.levels.end()) named[factor] = level->second;
    }
    if (weight == 0.0) continue;
    const auto [place, is_new] = place_of.emplace(own, found.conditions.size());
    if (is_new) {
      found.conditions.push_back(
          {.name = by_block ? block.name : name_of(own, block.name), .blocks = {}});
      levels_of.push_back(named);
      condition_weights.push_back(weight);
    }
    found.conditions[place->second].blocks.push_back(block.name);
  }
  if (found.conditions.empty()) {
    found.problem = "expected blocks with these levels that have the measure `" +
                    to_string(contrast.measure) + "`, found none";
    return found;
  }
  // What is not named is averaged: conditions that the named levels do not tell apart share
  // their weight.
  std::map<Levels, int> num_alike;
  for (const Levels& named : levels_of) ++num_alike[named];
  for (std::size_t i = 0; i < condition_weights.size(); ++i) {
    condition_weights[i] /= num_alike[levels_of[i]];
  }
  // Every combination of the levels that have a weight has to be there.
  std::size_t num_wanted = 1;
  for (const auto& [factor, weights] : by_factor) {
    if (is_between_people(study, factor)) continue;
    num_wanted *= static_cast<std::size_t>(
        std::ranges::count_if(weights, [](const auto& one) { return one.second != 0.0; }));
  }
  if (num_alike.size() != num_wanted) {
    found.problem = "expected a block that has the measure `" + to_string(contrast.measure) +
                    "` for each of the " + std::to_string(num_wanted) +
                    " combinations of these levels, found blocks for " +
                    std::to_string(num_alike.size());
    return found;
  }

  for (ContrastGroup& group : groups_of(between)) {
    double weight = 1.0;
    for (const DesignFactor* factor : between) {
      const auto weights = by_factor.find(factor->name);
      weight *= weights == by_factor.end()
                    ? 1.0 / static_cast<double>(factor->levels.size())
                    : weight_of(factor->name, weights->second, group.levels);
    }
    if (weight == 0.0) continue;
    std::vector<double>& row = found.weights.emplace_back();
    for (const double of_condition : condition_weights) row.push_back(weight * of_condition);
    found.groups.push_back(std::move(group));
  }
  return found;
}

}  // namespace jnd::experiments
