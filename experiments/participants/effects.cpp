#include "experiments/participants/effects.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/order/cell.h"
#include "experiments/procedures/contrast_conditions.h"
#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {
namespace {

bool applies(const Laboratory::Effect& effect, const Levels& levels) {
  return std::ranges::all_of(effect.levels, [&](const auto& wanted) {
    const auto found = levels.find(wanted.first);
    return found != levels.end() && found->second == wanted.second;
  });
}

/// An amount of an effect, its spread between people, and the value of an effect that does not
/// have it.
struct Amount {
  const char *key, *spread_key;
  double Laboratory::Effect::*value;
  double Laboratory::Effect::*spread;
  double nothing;
};

constexpr Amount kAmounts[] = {
    {"weber_fraction_factor", "weber_fraction_sd_ln",
     &Laboratory::Effect::weber_fraction_factor, &Laboratory::Effect::weber_fraction_sd_ln,
     1.0},
    {"pse_factor", "pse_sd_ln", &Laboratory::Effect::pse_factor, &Laboratory::Effect::pse_sd_ln,
     1.0},
    {"exponent_difference", "exponent_sd", &Laboratory::Effect::exponent_difference,
     &Laboratory::Effect::exponent_sd, 0.0},
    {"magnitude_factor", "magnitude_sd_ln", &Laboratory::Effect::magnitude_factor,
     &Laboratory::Effect::magnitude_sd_ln, 1.0},
    {"rating_difference", "rating_sd", &Laboratory::Effect::rating_difference,
     &Laboratory::Effect::rating_sd, 0.0}};

std::vector<std::string> amount_names() {
  std::vector<std::string> names;
  for (const Amount& amount : kAmounts) {
    names.emplace_back(amount.key);
    names.emplace_back(amount.spread_key);
  }
  return names;
}

/// Returns the amounts of an effect that change anything.
std::vector<std::string> told_amounts(const Laboratory::Effect& effect) {
  std::vector<std::string> names;
  for (const Amount& amount : kAmounts) {
    if (effect.*amount.value != amount.nothing) names.emplace_back(amount.key);
    if (effect.*amount.spread != 0.0) names.emplace_back(amount.spread_key);
  }
  return names;
}

/// Whether the answers depend on an amount, which is given by its key.
bool acts_on(const std::string& key, const Block& block) {
  const Measure measures = procedure_named(block.procedure).measures(block);
  if (key == "weber_fraction_factor") return true;
  if (key == "pse_factor") {
    return measures == Measure::kComparison || measures == Measure::kMatch;
  }
  if (key == "rating_difference") return measures == Measure::kRating;
  const bool says_numbers =
      measures == Measure::kMagnitude || measures == Measure::kProducedMagnitude;
  if (key == "exponent_difference") return says_numbers;
  // Numbers in units of a standard do not change, because the standard changes in the same
  // ratio.
  return says_numbers && modulus_of(block) != Modulus::kStandard;
}

[[noreturn]] void refuse(const std::string& written, const std::string& found) {
  throw core::Error(
      "effect: expected levels and amounts such as "
      "`fluid=thin:weber_fraction_factor=2,weber_fraction_sd_ln=0.2`, found `" +
      written + "`, " + found);
}

/// Splits "a=b,c=d" into pairs.
std::vector<std::pair<std::string, std::string>> pairs_of(const std::string& text,
                                                          const std::string& written) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string pair = text.substr(begin, end - begin);
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == pair.size()) {
      const bool is_word = !pair.empty() && equals == std::string::npos;
      refuse(written, "of which `" + pair + "` is no NAME=VALUE" +
                          (is_word ? "; a block is written `block=" + pair + "`" : ""));
    }
    pairs.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
    begin = end + 1;
  }
  return pairs;
}

double number_of(const std::string& text, const std::string& written) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    refuse(written, "of which `" + text + "` is no number");
  }
  return value;
}

}  // namespace

Laboratory::Effect effects_on(const Laboratory& laboratory, const Levels& levels) {
  Laboratory::Effect all;
  for (const Laboratory::Effect& effect : laboratory.effects) {
    if (!applies(effect, levels)) continue;
    all.weber_fraction_factor *= effect.weber_fraction_factor;
    all.pse_factor *= effect.pse_factor;
    all.exponent_difference += effect.exponent_difference;
    all.magnitude_factor *= effect.magnitude_factor;
    all.rating_difference += effect.rating_difference;
  }
  return all;
}

Person affected(const Laboratory& laboratory, Person person, std::uint64_t session_seed,
                const Levels& levels) {
  for (std::size_t i = 0; i < laboratory.effects.size(); ++i) {
    const Laboratory::Effect& effect = laboratory.effects[i];
    if (!applies(effect, levels)) continue;
    const auto z = [&](const char* trait) {
      return core::RandomStream(session_seed, std::string("effect/") + trait,
                                {static_cast<std::int64_t>(i)})
          .normal();
    };
    const double fraction = effect.weber_fraction_factor *
                            std::exp(effect.weber_fraction_sd_ln * z("weber_fraction"));
    person.weber_fraction *= fraction;
    person.stiffness_weber_fraction *= fraction;
    person.criterion_ln += std::log(effect.pse_factor) + effect.pse_sd_ln * z("pse");
    person.exponent = std::max(0.05, person.exponent + effect.exponent_difference +
                                         effect.exponent_sd * z("exponent"));
    person.unit *= effect.magnitude_factor * std::exp(effect.magnitude_sd_ln * z("magnitude"));
    person.rating_steps += effect.rating_difference + effect.rating_sd * z("rating");
  }
  return person;
}

std::string with_effects(const std::string& laboratory_text,
                         const std::vector<std::string>& effects) {
  if (effects.empty()) return laboratory_text;
  auto file = nlohmann::ordered_json::parse(laboratory_text, nullptr, false);
  // The function that reads the text reports the problem.
  if (!file.is_object()) return laboratory_text;
  for (const std::string& written : effects) {
    const std::size_t colon = written.find(':');
    if (colon == std::string::npos) refuse(written, "which has no colon");
    nlohmann::ordered_json effect = {{"levels", nlohmann::ordered_json::object()}};
    for (const auto& [factor, level] : pairs_of(written.substr(0, colon), written)) {
      effect["levels"][factor] = level;
    }
    for (const auto& [amount, value] : pairs_of(written.substr(colon + 1), written)) {
      const std::vector<std::string> known = amount_names();
      if (std::ranges::find(known, amount) == known.end()) {
        refuse(written, "of which `" + amount + "` is no amount" + did_you_mean(amount, known) +
                            "; amounts are " + one_of_words(known));
      }
      effect[amount] = number_of(value, written);
    }
    file["effects"].push_back(std::move(effect));
  }
  return file.dump(2) + "\n";
}

std::vector<std::string> amounts_that_act_on(const Block& block) {
  std::vector<std::string> names;
  for (const Amount& amount : kAmounts) {
    if (!acts_on(amount.key, block)) continue;
    names.emplace_back(amount.key);
    names.emplace_back(amount.spread_key);
  }
  return names;
}

namespace {

/// Returns "`fluid=thin,priming=primed`".
std::string effect_words(const Levels& levels) {
  std::string words;
  for (const auto& [factor, level] : levels) {
    words += (words.empty() ? "" : ",") + factor + "=" + level;
  }
  return '`' + shown_text(words) + '`';
}

/// Throws `Error` if the effect changes no block.
void require_that_it_acts(const Laboratory::Effect& effect, const Laboratory& laboratory,
                          const Study& study) {
  std::vector<std::string> blocks;
  std::vector<std::string> acting;
  for_each_stage(study.stages, [&](const Stage& stage) {
    const auto* block = std::get_if<Block>(&stage.content);
    if (block == nullptr) return;
    Levels levels = block->levels;
    levels[kBlockFactor] = stage.name;
    const bool has_them = std::ranges::all_of(effect.levels, [&](const auto& wanted) {
      if (is_between_people(study, wanted.first)) return true;
      const auto found = levels.find(wanted.first);
      return found != levels.end() && found->second == wanted.second;
    });
    if (!has_them) return;
    blocks.push_back(stage.name);
    for (const std::string& name : amounts_that_act_on(*block)) {
      if (std::ranges::find(acting, name) == acting.end()) acting.push_back(name);
    }
  });
  const std::string place =
      "laboratory " + laboratory.name + ": effect on " + effect_words(effect.levels) + ": ";
  if (blocks.empty()) {
    throw core::Error(place +
                      "expected levels that some block has together, found none that does; "
                      "give the effect fewer levels");
  }
  for (const std::string& name : told_amounts(effect)) {
    if (std::ranges::find(acting, name) != acting.end()) continue;
    throw core::Error(place + "expected an amount that changes the answers in " +
                      names_words(blocks) + ": " + one_of_words(acting) + ", found `" + name +
                      "`, which changes nothing there");
  }
}

}  // namespace

void require_known_effects(const Laboratory& laboratory, const Study& study) {
  std::map<std::string, std::set<std::string>> known;
  for (const Factor& factor : factors_of(study)) {
    if (!is_between_people(study, factor.name)) continue;
    for (const auto& arms : factor.alternatives) known[factor.name].insert(arms.front());
  }
  for (const DesignFactor& factor : study.factors) {
    known[factor.name].insert(factor.levels.begin(), factor.levels.end());
  }
  for_each_stage(study.stages, [&](const Stage& stage) {
    if (std::holds_alternative<Block>(stage.content)) known[kBlockFactor].insert(stage.name);
  });
  for (const Laboratory::Effect& effect : laboratory.effects) {
    for (const auto& [factor, level] : effect.levels) {
      const auto found = known.find(factor);
      if (found != known.end() && found->second.contains(level)) continue;
      std::vector<std::string> names;
      if (found == known.end()) {
        for (const auto& [name, levels] : known) names.push_back(name);
      } else {
        names.assign(found->second.begin(), found->second.end());
      }
      const std::string& wrong = found == known.end() ? factor : level;
      throw core::Error("laboratory " + laboratory.name + ": expected effects of " +
                        (found == known.end()
                             ? "the study's factors, its counterbalances or `block`"
                             : "levels of `" + factor + "`") +
                        " (" + names_words(names) + "), found `" + shown_text(wrong) + "`" +
                        did_you_mean(wrong, names));
    }
    require_that_it_acts(effect, laboratory, study);
  }
}

}  // namespace jnd::experiments
