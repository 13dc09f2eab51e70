#include "experiments/procedures/contrast_conditions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/order/cell.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/question_answer.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using Weights = std::map<std::string, double>;

/// Scales the weights so that those above 0 add up to 1 and those below 0 to -1.
Weights scaled(Weights weights) {
  double above = 0.0, below = 0.0;
  for (const auto& [level, weight] : weights) (weight > 0.0 ? above : below) += weight;
  for (auto& [level, weight] : weights) weight /= weight > 0.0 ? above : -below;
  return weights;
}

/// A block of the study with its levels. Its own name is its level of `block`.
struct LevelledBlock {
  std::string name;
  Levels levels;
  const Block* block = nullptr;
};

std::vector<LevelledBlock> blocks_of(const Study& study) {
  std::vector<LevelledBlock> found;
  for_each_stage(study.stages, [&](const Stage& stage) {
    const auto* block = std::get_if<Block>(&stage.content);
    if (block == nullptr) return;
    Levels levels = block->levels;
    levels[kBlockFactor] = stage.name;
    found.push_back({stage.name, std::move(levels), block});
  });
  return found;
}

bool measures_a(const Block& block, ContrastMeasure measure) {
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
    case ContrastMeasure::kRating:
      return measures == Measure::kRating;
    case ContrastMeasure::kQuestion:
      return std::ranges::any_of(block.questions, has_value);
    case ContrastMeasure::kResponseTime:
      return true;
  }
  return false;
}

/// Returns "`a`, `b` and `c`". Of very many it names the first and says how many more there
/// are.
std::string and_words(const std::vector<std::string>& words) {
  constexpr std::size_t kMost = 6;
  const std::size_t num_told = words.size() > kMost ? kMost - 1 : words.size();
  std::string all;
  for (std::size_t i = 0; i < num_told; ++i) {
    if (i > 0) all += i + 1 == words.size() ? " and " : ", ";
    all += '`' + words[i] + '`';
  }
  if (num_told < words.size()) {
    all += " and " + std::to_string(words.size() - num_told) + " more";
  }
  return all;
}

/// Returns "have the measure `x`" or "ask the question `y`", which the blocks of a contrast
/// must do.
std::string wanted_words(const PlannedContrast& contrast) {
  if (contrast.measure != ContrastMeasure::kQuestion) {
    return "have the measure `" + to_string(contrast.measure) + "`";
  }
  return "ask the question `" + contrast.question + "` (a `scale`, a `number` or `yes_no`)";
}

/// Returns the measures apart from `other` in which all of these blocks can be compared:
/// "`response_time` alone".
std::string measures_words(const std::vector<LevelledBlock>& blocks, ContrastMeasure other) {
  std::vector<std::string> names;
  for (const ContrastMeasure measure : contrast_measures()) {
    if (measure == other) continue;  // Blocks may ask another question.
    const bool all_have_it = std::ranges::all_of(
        blocks, [&](const LevelledBlock& one) { return measures_a(*one.block, measure); });
    if (all_have_it) names.push_back(to_string(measure));
  }
  return names.size() == 1 ? and_words(names) + " alone" : and_words(names);
}

/// Returns why existing blocks cannot be compared: "`one` and `two` have `response_time`
/// alone".
std::string lack_words(const std::vector<LevelledBlock>& blocks, ContrastMeasure measure) {
  std::vector<LevelledBlock> data;
  std::vector<std::string> names, practice;
  for (const LevelledBlock& one : blocks) {
    (one.block->practice ? practice : names).push_back(one.name);
    if (!one.block->practice) data.push_back(one);
  }
  if (data.empty()) {
    return and_words(practice) + (practice.size() == 1 ? " is" : " are") +
           " practice, which is no data";
  }
  return and_words(names) + (names.size() == 1 ? " has " : " have ") +
         measures_words(data, measure);
}

/// Returns the weight that a factor gives to something with these levels, which is 0 without a
/// level of the factor.
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

/// Returns every combination of levels of the factors of people.
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

/// Returns every combination of levels with a weight, of the factors within people.
std::vector<Levels> wanted_levels(const Study& study,
                                  const std::map<std::string, Weights>& by_factor) {
  std::vector<Levels> wanted = {{}};
  for (const auto& [factor, weights] : by_factor) {
    if (is_between_people(study, factor)) continue;
    std::vector<Levels> crossed;
    for (const Levels& levels : wanted) {
      for (const auto& [level, weight] : weights) {
        if (weight == 0.0) continue;
        crossed.push_back(levels);
        crossed.back()[factor] = level;
      }
    }
    wanted = std::move(crossed);
  }
  return wanted;
}

/// Returns "`fluid` `thin` and `vision` `on`".
std::string levels_words(const Levels& levels) {
  std::string words;
  for (const auto& [factor, level] : levels) {
    words += (words.empty() ? "`" : " and `") + factor + "` `" + level + '`';
  }
  return words;
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

bool has_measure(const Block& block, const PlannedContrast& contrast) {
  if (block.practice) return false;
  if (contrast.measure != ContrastMeasure::kQuestion) {
    return measures_a(block, contrast.measure);
  }
  return std::ranges::any_of(block.questions, [&](const QuestionnaireItem& item) {
    return item.name == contrast.question && has_value(item);
  });
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

  // Blocks with any weight are grouped by their levels.
  std::map<Levels, std::size_t> place_of;
  std::vector<Levels> levels_of;
  std::vector<double> condition_weights;
  // Blocks that lack the measure, by their levels.
  std::map<Levels, std::vector<LevelledBlock>> without;
  for (const LevelledBlock& block : blocks_of(study)) {
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
    if (!has_measure(*block.block, contrast)) {
      without[named].push_back(block);
      continue;
    }
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
    std::vector<LevelledBlock> all;
    for (const auto& [levels, blocks] : without) {
      all.insert(all.end(), blocks.begin(), blocks.end());
    }
    found.problem =
        "expected blocks with these levels that " + wanted_words(contrast) + ", found none: " +
        (all.empty() ? "no block has these levels; state them in the `levels` of blocks"
                     : lack_words(all, contrast.measure) +
                           "; compare in what they have, or compare other "
                           "blocks");
    return found;
  }
  // Factors that the contrast does not name are averaged: conditions with the same named levels
  // share their weight.
  std::map<Levels, int> num_alike;
  for (const Levels& named : levels_of) ++num_alike[named];
  for (std::size_t i = 0; i < condition_weights.size(); ++i) {
    condition_weights[i] /= num_alike[levels_of[i]];
  }
  // Every combination of the levels that have a weight must exist.
  std::vector<Levels> missing = wanted_levels(study, by_factor);
  const std::size_t num_wanted = missing.size();
  std::erase_if(missing, [&](const Levels& levels) { return num_alike.contains(levels); });
  if (!missing.empty()) {
    const auto blocks = without.find(missing.front());
    found.problem =
        "expected blocks that " + wanted_words(contrast) + " for each of the " +
        std::to_string(num_wanted) + " combinations of these levels, found none for " +
        levels_words(missing.front()) +
        (missing.size() > 1 ? " and " + std::to_string(missing.size() - 1) + " more" : "") +
        ": " +
        (blocks == without.end()
             ? "no block has these levels; add one, or leave them out of the contrast"
             : lack_words(blocks->second, contrast.measure) +
                   "; compare in what all have, or leave these levels "
                   "out of the contrast");
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
