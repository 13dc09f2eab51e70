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
  const StudyFolder* study = nullptr;  ///< The open study folder; nullptr for a file alone.
  const StudyOutline& outline;
  const std::vector<PlannedOrder>& orders;
  std::string orders_problem;  ///< Why there are no orders; "" otherwise.
  int num_reloads = 0;
  double since_reload_s = 0.0;
  /// The folder proposed for a study of which only the file exists.
  std::string proposed_folder{};
};

struct StudyViewState {
  int num_participants = 8;  ///< How many participants' orders are shown.
  float outline_height = 0, orders_height = 0;
  std::optional<std::size_t> problem;  ///< The problem that the arrow keys have reached.
  bool asks_for_folder = false, dialog_is_new = false;
  std::string new_folder;      ///< The folder of the study that begins with the file.
  std::string folder_problem;  ///< Why the folder cannot be used; "" otherwise.
};

struct StudyViewResult {
  StudyTab tab = StudyTab::kNone;
  bool orders_changed = false;  ///< `num_participants` has changed.
  bool edit = false;            ///< Opens the file with another program.
  bool begin = false;           ///< Begins a study with the file, in `new_folder`.
};

[[nodiscard]] StudyViewResult draw_study_view(Ui& ui, const StudyViewModel& model,
                                              StudyViewState& state);

}  // namespace jnd::app::gui
