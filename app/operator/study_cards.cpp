#include "app/operator/study_cards.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "app/language/words.h"
#include "app/operator/study_outline.h"
#include "app/session/shipped_files.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

std::string length_of_study(const StudyOutline& outline) {
  const std::string longest = duration_words(outline.longest_s);
  const std::string shortest = duration_words(outline.shortest_s);
  const std::string duration =
      shortest == longest ? tr("about {}", longest) : tr("{} to {}", shortest, longest);
  return duration + " · " + trn("{} trial", "{} trials", outline.num_trials);
}

StudyCard card_of(const fs::path& file) {
  const StudyOutline outline = read_outline(file);
  StudyCard card{.file = file, .title = outline.title};
  if (card.title.empty()) card.title = file.filename().string();
  card.num_problems = static_cast<int>(outline.problems.size());
  if (card.num_problems > 0) return card;
  card.purpose = outline.description;
  card.length = length_of_study(outline);
  card.citation = outline.citation;
  return card;
}

bool is_study_file(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".json") && !name.ends_with(".schema.json");
}

}  // namespace

std::vector<StudyCard> shipped_study_cards() {
  std::vector<StudyCard> cards;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(shipped_folder() / "protocols", error)) {
    if (!is_study_file(entry.path())) continue;
    StudyCard card = card_of(entry.path());
    card.name = entry.path().stem().string();
    cards.push_back(std::move(card));
  }
  std::ranges::sort(cards, {}, [](const StudyCard& card) {
    return std::pair(card.name != "short_tour", card.title);
  });
  return cards;
}

std::vector<StudyCard> draft_cards(const std::vector<RecentStudy>& recent) {
  std::vector<StudyCard> cards;
  for (const RecentStudy& study : recent) {
    std::error_code ignored;
    if (!study.exists || fs::is_directory(study.path, ignored) || !is_study_file(study.path)) {
      continue;
    }
    StudyCard card = card_of(study.path);
    card.name = study.path.string();
    card.is_draft = true;
    cards.push_back(std::move(card));
  }
  return cards;
}

}  // namespace jnd::app
