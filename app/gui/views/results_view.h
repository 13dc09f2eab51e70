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
  /// nullptr while the results are computed, or if there are none.
  const ResultsModel* results = nullptr;
  double progress = 0.0;
  std::string problem;      ///< Why there are no results, in one sentence; "" otherwise.
  bool is_blinded = false;  ///< There are no results because nobody has unblinded the study.
  StudyWork work;           ///< The work under way: an export or a report.
};

struct ResultsViewState {
  bool is_new = true;  ///< Nobody has chosen yet whose results to show.
  /// 0 for everybody; otherwise one more than the participant's row in the table.
  std::size_t participant = 0;
  std::size_t page = 0;
  float summary_height = 0, page_height = 0;
  bool asks_to_unblind = false;
  bool asks_for_format = false;  ///< The dialog that asks for the format of an export is open.
  bool with_recordings = false;  ///< The export is to contain recordings.
  bool dialog_is_new = false;
  std::string reason;
};

struct ResultsViewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<ExportChoice> export_as;
  bool write_report = false;
  /// Saves the figures of the page that is shown.
  std::optional<StudyFiguresRequest::What> save_picture;
  bool open = false;  ///< Opens what the last work wrote.
  bool cancel = false;
  bool unblind = false;  ///< Unblinds the study, for the reason in the state.
};

[[nodiscard]] ResultsViewResult draw_results_view(Ui& ui, const ResultsViewModel& model,
                                                  ResultsViewState& state);

}  // namespace jnd::app::gui
