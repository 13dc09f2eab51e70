#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/operator/recent_studies.h"

namespace jnd::app {

/// A study file that a new study can be begun with, as a card.
struct StudyCard {
  std::string name;  ///< As `jnd new --from` takes it; a path for a draft.
  std::filesystem::path file;
  std::string title;
  std::string purpose;    ///< What its author says of it; "" for nothing.
  std::string length;     ///< "about 40 min · 160 trials"; "" of a draft with problems.
  std::string citation;   ///< Of the study it follows; "" for none.
  bool is_draft = false;  ///< Somebody's own file, opened lately.
  int num_problems = 0;   ///< Of a draft.
};

/// Those that come with the program: the tour first, then by title. Reads them all: a moment.
/// Not real time.
[[nodiscard]] std::vector<StudyCard> shipped_study_cards();
/// Study files of one's own that were opened lately and are still there, the newest first.
[[nodiscard]] std::vector<StudyCard> draft_cards(const std::vector<RecentStudy>& recent);

}  // namespace jnd::app
