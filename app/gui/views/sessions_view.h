#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/gui/ui.h"
#include "app/gui/views/list_keys.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/export_actions.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

/// The work that the application does in the background for this view.
struct StudyWork {
  std::string running;  ///< What the work is, such as "Verifying"; "" if none runs.
  double progress = 0.0;
  ActionOutcome outcome;  ///< How the last work ended; its sentence is "" before any has.
};

struct SessionsViewState {
  std::int64_t selected = 0;  ///< The chosen session; 0 for none.
  bool asks_for_backup = false;
  bool dialog_is_new = false;
  /// The application proposes a known backup's folder, or a new one beside the study.
  std::string backup_folder;
  DoubleClick clicks;
  float column_height = 0;  ///< The height of the column beside the table.
};

struct SessionsViewResult {
  StudyTab tab = StudyTab::kNone;
  bool new_session = false;
  std::optional<std::int64_t> resume;
  std::optional<std::int64_t> show;  ///< Shows this session's page.
  bool verify = false;
  bool back_up = false;  ///< Backs the study up into `backup_folder`.
  bool cancel = false;
};

[[nodiscard]] SessionsViewResult draw_sessions_view(Ui& ui, const StudyFolder& study,
                                                    const StudyWork& work,
                                                    SessionsViewState& state);

}  // namespace jnd::app::gui
