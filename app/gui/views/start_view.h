#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/gui/views/file_dialog.h"
#include "app/operator/preflight.h"
#include "app/operator/study_cards.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {

/// What the start view shows. The studies are recent ones; a study that cannot be read says
/// why.
struct StartModel {
  struct Study {
    std::filesystem::path path;
    std::optional<StudyFolder> folder;  ///< None for a file, or if it is unreadable.
    /// In words, also for a file with problems.
    std::string title, summary;
  };
  std::vector<Study> studies;          ///< The newest study comes first.
  std::vector<PreflightLine> machine;  ///< Empty until the machine was looked at.
  std::vector<StudyCard> drafts;       ///< The user's own study files, the newest first.
  /// Studies that come with the program, sorted by title.
  std::vector<StudyCard> shipped;
  std::string version;
};

/// What the window remembers of the start view.
struct StartViewState {
  enum class Dialog { kNone, kNew, kOpen, kBrowse };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  std::optional<std::size_t> study;  ///< The recent study that the arrow keys have reached.
  /// The place of the chosen card; drafts come first, then shipped studies.
  std::size_t chosen_card = 0;
  std::string study_file;       ///< A file typed instead of choosing a card; "" for none.
  std::string new_folder;       ///< The folder of the new study.
  std::string proposed_folder;  ///< The last proposal for `new_folder`.
  FileDialogState opening;
  std::string problem;  ///< Why the last attempt failed.
};

struct StartViewResult {
  struct Resume {
    std::filesystem::path folder;
    std::int64_t session = 0;
  };
  std::optional<Resume> resume;
  std::optional<std::filesystem::path> open;  ///< A folder or a study file.
  struct New {
    std::string study;  ///< The name of a shipped study, or a path.
    std::filesystem::path folder;
  };
  std::optional<New> create;
  bool start_tour = false;
  bool device = false;  ///< Shows the device's view.
  bool data = false;    ///< Shows the view of somebody's own table.
};

[[nodiscard]] StartViewResult draw_start_view(Ui& ui, const StartModel& model,
                                              const EntriesOf& entries_of,
                                              StartViewState& state);

}  // namespace jnd::app::gui
