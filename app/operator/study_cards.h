#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/operator/recent_studies.h"

namespace jnd::app {

/// A study file with which a new study can begin, as a card.
struct StudyCard {
  std::string name;  ///< As `jnd new --from` takes it; for a draft, its path.
  std::filesystem::path file;
  std::string title;
  std::string purpose;  ///< What its author says about it; "" for nothing.
  /// Such as "about 40 min · 160 trials"; "" for a draft with problems.
  std::string length;
  std::string citation;   ///< The publication that the study follows; "" for none.
  bool is_draft = false;  ///< The user's own file, opened recently.
  int num_problems = 0;   ///< The number of a draft's problems.
};

/// The studies that come with the program: first the tour, then the others by title. It reads
/// them all, which takes a moment. Not real time.
[[nodiscard]] std::vector<StudyCard> shipped_study_cards();
/// The user's own study files that were opened recently and still exist, the newest first.
[[nodiscard]] std::vector<StudyCard> draft_cards(const std::vector<RecentStudy>& recent);

}  // namespace jnd::app
