#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// What a folder holds that may be opened, and where else to look.
struct FolderEntry {
  std::filesystem::path path;
  enum class Kind { kFolder, kStudyFolder, kBackup, kStudyFile, kTable } kind = Kind::kFolder;
};

/// Lists a folder, so that no view does any reading: once for each that is shown.
using EntriesOf = std::function<std::vector<FolderEntry>(const std::filesystem::path&)>;

/// What is remembered of the dialog that opens something by its path.
struct FileDialogState {
  bool is_new = false;
  std::filesystem::path browsing;  ///< Folder whose entries are shown.
  std::filesystem::path listed;    ///< Folder that `entries` were read from.
  std::vector<FolderEntry> entries;
  std::string open_path;              ///< Typed; stays where it is when it was wrong.
  std::optional<std::size_t> chosen;  ///< Entry that arrow keys have come to.
  std::string problem;                ///< Why the last attempt did not work; "" otherwise.
};

struct FileDialogWords {
  std::string title;    ///< "Open a study"
  std::string hint;     ///< Of the field for a path.
  std::string nothing;  ///< Of a folder without entries.
};

struct FileDialogResult {
  std::optional<std::filesystem::path> chosen;
  bool is_closed = false;  ///< Something was chosen, or nothing is wanted.
};

/// Before it is drawn for the first time. `start`: the folder to begin in, where none was shown
/// before.
void begin_file_dialog(FileDialogState& state, const std::filesystem::path& start);

/// Once more, where what was chosen cannot be opened: with the path that was typed, and why.
void go_on_with_file_dialog(FileDialogState& state, const std::string& problem);

/// A path is typed, or found by going from folder to folder.
[[nodiscard]] FileDialogResult draw_file_dialog(Ui& ui, const FileDialogWords& words,
                                                const EntriesOf& entries_of,
                                                FileDialogState& state);

/// As a shell would take it: ~ is the home folder.
[[nodiscard]] std::filesystem::path typed_path(const std::string& typed);

}  // namespace jnd::app::gui
