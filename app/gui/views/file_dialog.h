#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Something in a folder that can be opened, or a folder in which to look.
struct FolderEntry {
  std::filesystem::path path;
  enum class Kind { kFolder, kStudyFolder, kBackup, kStudyFile, kTable } kind = Kind::kFolder;
};

/// Lists a folder, so that the view reads nothing itself. The dialog calls it once for each
/// folder that it shows.
using EntriesOf = std::function<std::vector<FolderEntry>(const std::filesystem::path&)>;

/// What is remembered about the dialog that opens something by its path.
struct FileDialogState {
  bool is_new = false;
  std::filesystem::path browsing;  ///< The folder whose entries are shown.
  std::filesystem::path listed;    ///< The folder that `entries` were read from.
  std::vector<FolderEntry> entries;
  /// The path that was typed; it stays there if it was wrong.
  std::string open_path;
  std::optional<std::size_t> chosen;  ///< The entry that the arrow keys have reached.
  std::string problem;                ///< Why the last attempt failed; "" otherwise.
};

struct FileDialogWords {
  std::string title;    ///< The title, such as "Open a study".
  std::string hint;     ///< The hint in the field for a path.
  std::string nothing;  ///< Shown for a folder without entries.
};

struct FileDialogResult {
  std::optional<std::filesystem::path> chosen;
  bool is_closed = false;  ///< Something was chosen, or the person cancelled.
};

/// Call it before the dialog is drawn for the first time. The dialog begins in the folder
/// `start` if it has not shown any folder before.
void begin_file_dialog(FileDialogState& state, const std::filesystem::path& start);

/// Opens the dialog again after what was chosen could not be opened. It shows the path that was
/// typed, and the problem.
void go_on_with_file_dialog(FileDialogState& state, const std::string& problem);

/// Draws the dialog. The person types a path, or finds one by going from folder to folder.
[[nodiscard]] FileDialogResult draw_file_dialog(Ui& ui, const FileDialogWords& words,
                                                const EntriesOf& entries_of,
                                                FileDialogState& state);

/// The path as a shell would read it: ~ is the home folder.
[[nodiscard]] std::filesystem::path typed_path(const std::string& typed);

}  // namespace jnd::app::gui
