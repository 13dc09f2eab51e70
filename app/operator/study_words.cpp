#include "app/operator/study_words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "app/language/words.h"
#include "app/operator/session_words.h"
#include "experiments/order/block_turns.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/media.h"
#include "experiments/study/stage_walk.h"

namespace jnd::app {
namespace {

using namespace experiments;

const Stage* block_named(const Study& study, const std::string& name) {
  const Stage* found = nullptr;
  for_each_stage(study.stages, [&](const Stage& stage) {
    if (std::holds_alternative<Block>(stage.content) && stage.name == name) found = &stage;
  });
  return found;
}

}  // namespace

std::string name_words(std::string name, bool as_title) {
  if (name.starts_with("num_")) name = tr("number of {}", name.substr(4));
  std::replace(name.begin(), name.end(), '_', ' ');
  // "Pse" and "Jnd" would be wrong.
  for (const auto& [small, capitals] : {std::pair{"pse", "PSE"}, {"jnd", "JND"}}) {
    const std::string_view word = small;
    const bool is_first =
        name.starts_with(word) && (name.size() == word.size() || name[word.size()] == ' ');
    if (as_title && is_first) return capitals + name.substr(word.size());
  }
  if (as_title && name.size() > 1 && name[0] >= 'a' && name[0] <= 'z') {
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
  }
  return name;
}

const std::string& shown_language(const std::vector<std::string>& languages) {
  const std::string spoken = spoken_language();
  const auto found = std::ranges::find(languages, spoken);
  return spoken == "en" || found == languages.end() ? languages.front() : *found;
}

/// The title in this language, or else in another one; without a title, the name in words.
static std::string title_or_name(const Text& title, const std::string& name,
                                 const std::string& language) {
  const auto asked = title.find(language);
  const auto found = asked == title.end() ? title.begin() : asked;
  if (found != title.end() && !found->second.empty()) return found->second;
  return name_words(name, /*as_title=*/true);
}

std::string title_of(const Stage& stage, const std::string& language) {
  return title_or_name(stage.title, stage.name, language);
}

std::string title_of(const Interleaving& group, const std::string& language) {
  return title_or_name(group.title, group.name, language);
}

const std::string& in_language(const Text& text, const std::string& language) {
  static const std::string kNothing;
  const auto found = text.find(language);
  return found == text.end() ? kNothing : found->second;
}

std::vector<std::string> shown_titles(const std::vector<const Stage*>& stages,
                                      const std::string& language, bool hides_levels) {
  std::vector<std::string> titles;
  int num_blocks = 0;
  for (std::size_t i = 0; i < stages.size();) {
    const Stage& stage = *stages[i];
    const std::size_t num_together = num_run_together(stages, i);
    const std::string title = hides_levels && std::holds_alternative<Block>(stage.content)
                                  ? tr("Block {}", ++num_blocks)
                              : stage.interleaving ? title_of(*stage.interleaving, language)
                                                   : title_of(stage, language);
    titles.insert(titles.end(), num_together, title);
    i += num_together;
  }
  return titles;
}

std::string title_of(const Study& study) {
  const std::string& title = in_language(study.title, shown_language(study.languages));
  return title.empty() ? name_words(study.name, /*as_title=*/true) : title;
}

std::string short_title(const std::string& title) { return title.substr(0, title.find(": ")); }

std::string block_title(const Study& study, const std::string& block) {
  const Stage* stage = block_named(study, block);
  return stage == nullptr ? block : title_of(*stage, study.languages.front());
}

std::string medium_words(const std::string& medium) {
  const Medium* known = find_medium(medium);
  return known == nullptr ? name_words(medium, /*as_title=*/false) : tr(known->words);
}

std::string procedure_words(const std::string& procedure) {
  for (const Procedure* known : procedures()) {
    if (known->name() == procedure) return tr(known->title().c_str());
  }
  return name_words(procedure, /*as_title=*/true);
}

std::string words_of(const MediumSetting& setting) {
  std::string medium = medium_words(setting.medium);
  if (setting.quantity.empty()) return medium;
  return medium + ", " + level_words(setting.quantity, setting.intensity);
}

std::string duration_words(double duration_s) {
  if (!(duration_s >= 0.0) || duration_s > 1e9) return tr("unknown");
  if (duration_s < 59.5) return tr("{:.0f} s", duration_s);
  const auto minutes = std::llround(duration_s / 60.0);
  if (minutes < 60) return tr("{} min", minutes);
  return minutes % 60 == 0 ? tr("{} h", minutes / 60)
                           : tr("{} h {} min", minutes / 60, minutes % 60);
}

/// The titles of arms by counterbalance; an arm without one is called by its name.
using ArmTitles = std::map<std::string, std::map<std::string, std::string>>;

static std::string cell_words_by(const ArmTitles& titles, const Cell& cell) {
  std::string words;
  for (const Assignment& assignment : cell) {
    if (!words.empty()) words += "; ";
    const auto its = titles.find(assignment.counterbalance);
    for (std::size_t i = 0; i < assignment.arms.size(); ++i) {
      const std::string& name = assignment.arms[i];
      const std::string arm =
          its == titles.end() ? name_words(name, false) : its->second.at(name);
      words += i == 0 ? arm : tr(", then {}", arm);
    }
  }
  return words;
}

/// Empty if an arm does not have exactly one block, or if two arms would have the same title.
static std::map<std::string, std::string> titles_of_arms(const Counterbalance& counterbalance,
                                                         const std::string& language) {
  std::map<std::string, std::string> titles;
  std::set<std::string> known;
  for (const Counterbalance::Arm& arm : counterbalance.arms) {
    std::string title;
    int num_blocks = 0;
    for_each_stage(arm.stages, [&](const Stage& stage) {
      if (!std::holds_alternative<Block>(stage.content)) return;
      ++num_blocks;
      if (!stage.title.empty()) title = short_title(title_of(stage, language));
    });
    if (num_blocks != 1 || title.empty() || !known.insert(title).second) return {};
    titles[arm.name] = title;
  }
  return titles;
}

std::string cell_words(const Cell& cell) { return cell_words_by({}, cell); }

std::string cell_words(const Study& study, const Cell& cell) {
  ArmTitles titles;
  for_each_stage(study.stages, [&](const Stage& stage) {
    const auto* counterbalance = std::get_if<Counterbalance>(&stage.content);
    if (counterbalance == nullptr) return;
    auto its = titles_of_arms(*counterbalance, study.languages.front());
    if (!its.empty()) titles[stage.name] = std::move(its);
  });
  return cell_words_by(titles, cell);
}

}  // namespace jnd::app
