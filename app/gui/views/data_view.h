#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/curves/curve_request.h"
#include "app/gui/ui.h"
#include "app/gui/views/file_dialog.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/open_data.h"

namespace jnd::app::gui {

/// What the window remembers about the view of somebody's table.
struct DataViewState {
  enum class Page { kTable, kCurves, kComparison, kCommand };
  enum class Dialog {
    kNone,
    kFile,
    kRole,  ///< Asks for the role of `column`.
    kIntensity,
    kYes,
    kYesValue,
    kTrials,
    kGroups,
    kFilters,
    kFilterCell,  ///< Asks which cell rows must have in `column`.
    kFamily,
    kTask,
    kLapse,
    kLevels,
    kInterval,
    kGoodness,
    kPicture,
    kTable,
  };
  Page page = Page::kTable;
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  std::string column;  ///< The column that a dialog is about.
  std::string typed;   ///< What is typed in a dialog's field.
  /// Counts how often the dialog itself changed `typed`. A field that is being edited would
  /// otherwise keep its own text.
  int num_rewrites = 0;
  std::string problem;  ///< What is wrong with what was typed.
  FileDialogState opening;
  /// The first column of the table that is shown; those before it have no room.
  std::size_t first_column = 0;
  std::size_t group = 0;  ///< The group whose numbers are shown.
  float settings_height = 0, numbers_height = 0, comparison_height = 0;
  bool is_copied = false;  ///< The command is on the clipboard.
};

struct DataViewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<std::filesystem::path> open;
  std::optional<CurveRequest> request;
  std::optional<std::filesystem::path> save_picture, save_table;
  bool compare = false;
};

/// Shows the file's first rows with their columns' roles, the settings of the fit, and its
/// results. `entries_of` lists a folder and the tables in it.
[[nodiscard]] DataViewResult draw_data_view(Ui& ui, const DataView& data,
                                            const EntriesOf& entries_of, DataViewState& state);

}  // namespace jnd::app::gui
