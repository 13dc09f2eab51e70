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

const std::vector<std::string> kAmounts = {
    "weber_fraction_factor", "weber_fraction_sd_ln", "pse_factor",       "pse_sd_ln",
    "exponent_difference",   "exponent_sd",          "magnitude_factor", "magnitude_sd_ln"};

[[noreturn]] void refuse(const std::string& written, const std::string& found) {
  throw core::Error(
      "effect: expected levels and amounts such as "
      "`fluid=thin:weber_fraction_factor=2,weber_fraction_sd_ln=0.2`, found `" +
      written + "`, " + found);
}

/// "a=b,c=d" as pairs.
std::vector<std::pair<std::string, std::string>> pairs_of(const std::string& text,
                                                          const std::string& written) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string pair = text.substr(begin, end - begin);
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == pair.size()) {
      refuse(written, "of which `" + pair + "` is no NAME=VALUE");
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
  }
  return person;
}

std::string with_effects(const std::string& laboratory_text,
                         const std::vector<std::string>& effects) {
  if (effects.empty()) return laboratory_text;
  auto file = nlohmann::ordered_json::parse(laboratory_text, nullptr, false);
  if (!file.is_object()) return laboratory_text;  // Whoever reads it says so.
  for (const std::string& written : effects) {
    const std::size_t colon = written.find(':');
    if (colon == std::string::npos) refuse(written, "which has no colon");
    nlohmann::ordered_json effect = {{"levels", nlohmann::ordered_json::object()}};
    for (const auto& [factor, level] : pairs_of(written.substr(0, colon), written)) {
      effect["levels"][factor] = level;
    }
    for (const auto& [amount, value] : pairs_of(written.substr(colon + 1), written)) {
      if (std::ranges::find(kAmounts, amount) == kAmounts.end()) {
        refuse(written, "of which `" + amount + "` is no amount" +
                            did_you_mean(amount, kAmounts) + "; amounts are " +
                            one_of_words(kAmounts));
      }
      effect[amount] = number_of(value, written);
    }
    file["effects"].push_back(std::move(effect));
  }
  return file.dump(2) + "\n";
}

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
  }
}

}  // namespace jnd::experiments
