#pragma once

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
};

struct StudyViewState {
  int num_participants = 8;  ///< Whose orders are shown.
  float outline_height = 0, orders_height = 0;
};

struct StudyViewResult {
  StudyTab tab = StudyTab::kNone;
  bool orders_changed = false;  ///< `num_participants` is another one.
};

[[nodiscard]] StudyViewResult draw_study_view(Ui& ui, const StudyViewModel& model,
                                              StudyViewState& state);

}  // namespace jnd::app::gui
