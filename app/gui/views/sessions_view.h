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

/// What the application does beside the window for this view.
struct StudyWork {
  std::string running;  ///< "Verifying"; "" for nothing.
  double progress = 0.0;
  ActionOutcome outcome;  ///< Of the last; its sentence is "" before any.
};

struct SessionsViewState {
  std::int64_t selected = 0;  ///< Session; 0 for none.
  bool asks_for_backup = false;
  bool dialog_is_new = false;
  std::string backup_folder;  ///< Proposed by the application: the known one, or beside it.
  DoubleClick clicks;
  float column_height = 0;  ///< Of what stands beside the table.
};

struct SessionsViewResult {
  StudyTab tab = StudyTab::kNone;
  bool new_session = false;
  std::optional<std::int64_t> resume;
  std::optional<std::int64_t> show;  ///< The page of this session.
  bool verify = false;
  bool back_up = false;  ///< Into `backup_folder`.
  bool cancel = false;
};

[[nodiscard]] SessionsViewResult draw_sessions_view(Ui& ui, const StudyFolder& study,
                                                    const StudyWork& work,
                                                    SessionsViewState& state);

}  // namespace jnd::app::gui
