#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_outline.h"

namespace jnd::app::gui {

struct StudyViewModel {
  const StudyFolder* study = nullptr;  ///< Of the folder; nullptr for a file alone.
  const StudyOutline& outline;
  const std::vector<PlannedOrder>& orders;
  std::string orders_problem;  ///< Why there are none; "" otherwise.
  int num_reloads = 0;
  double since_reload_s = 0.0;
  std::string proposed_folder{};  ///< For a study that is begun with a file alone.
};

struct StudyViewState {
  int num_participants = 8;  ///< Whose orders are shown.
  float outline_height = 0, orders_height = 0;
  std::optional<std::size_t> problem;  ///< That arrow keys have come to.
  bool asks_for_folder = false, dialog_is_new = false;
  std::string new_folder;      ///< Of the study that is begun with the file.
  std::string folder_problem;  ///< Why it cannot be; "" otherwise.
};

struct StudyViewResult {
  StudyTab tab = StudyTab::kNone;
  bool orders_changed = false;  ///< `num_participants` is another one.
  bool edit = false;            ///< The file, with another program.
  bool begin = false;           ///< A study with the file, in `new_folder`.
};

[[nodiscard]] StudyViewResult draw_study_view(Ui& ui, const StudyViewModel& model,
                                              StudyViewState& state);

}  // namespace jnd::app::gui
