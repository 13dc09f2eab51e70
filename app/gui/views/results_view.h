#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "app/gui/ui.h"
#include "app/gui/views/sessions_view.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/results_model.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

struct ResultsViewModel {
  const StudyFolder& study;
  const ResultsModel* results = nullptr;  ///< nullptr while computed, or where there are none.
  double progress = 0.0;
  std::string problem;      ///< Why there are none: one sentence; "" otherwise.
  bool is_blinded = false;  ///< The problem is that nobody has unblinded it.
  StudyWork work;           ///< Export, report.
};

struct ResultsViewState {
  bool is_new = true;           ///< Nobody has chosen yet whom to show.
  std::size_t participant = 0;  ///< 0: all; else one more than its place in the table.
  std::size_t page = 0;
  float summary_height = 0, page_height = 0;
  bool asks_to_unblind = false;
  bool asks_for_format = false;  ///< Of an export.
  bool with_recordings = false;  ///< Chosen for it.
  bool dialog_is_new = false;
  std::string reason;
};

struct ResultsViewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<ExportChoice> export_as;
  bool write_report = false;
  std::optional<StudyFiguresRequest::What> save_picture;  ///< Of the page that is shown.
  bool open = false;                                      ///< What the last work wrote.
  bool cancel = false;
  bool unblind = false;  ///< For the state's reason.
};

[[nodiscard]] ResultsViewResult draw_results_view(Ui& ui, const ResultsViewModel& model,
                                                  ResultsViewState& state);

}  // namespace jnd::app::gui
