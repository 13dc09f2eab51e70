#include "app/operator/study_words.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "app/language/words.h"
#include "app/operator/session_words.h"
#include "experiments/order/block_turns.h"
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
  // Not "Pse" and "Jnd".
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

/// In this language or another; in words of the name where there is none.
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
  const std::string& title = in_language(study.title, study.languages.front());
  return title.empty() ? name_words(study.name, /*as_title=*/true) : title;
}

std::string short_title(const std::string& title) { return title.substr(0, title.find(": ")); }

std::string block_title(const Study& study, const std::string& block) {
  const Stage* stage = block_named(study, block);
  return stage == nullptr ? block : title_of(*stage, study.languages.front());
}

std::string words_of(const MediumSetting& setting) {
  std::string medium = name_words(setting.medium, false);
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

std::string cell_words(const Cell& cell) {
  std::string words;
  for (const Assignment& assignment : cell) {
    if (!words.empty()) words += "; ";
    for (std::size_t i = 0; i < assignment.arms.size(); ++i) {
      const std::string arm = name_words(assignment.arms[i], false);
      words += i == 0 ? arm : tr(", then {}", arm);
    }
  }
  return words;
}

}  // namespace jnd::app
