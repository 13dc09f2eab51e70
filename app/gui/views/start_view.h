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

/// What the start view shows. Studies were opened lately; one that cannot be read says why.
struct StartModel {
  struct Study {
    std::filesystem::path path;
    std::optional<StudyFolder>
        folder;                  ///< Nothing for a study file, or where it cannot be read.
    std::string title, summary;  ///< In words, also of a file with problems.
  };
  std::vector<Study> studies;          ///< The newest first.
  std::vector<PreflightLine> machine;  ///< Empty until it was looked at.
  std::vector<StudyCard> drafts;       ///< Study files of one's own, the newest first.
  std::vector<StudyCard> shipped;      ///< Studies that come with the program, by title.
  std::string version;
};

/// What the window remembers of the start view.
struct StartViewState {
  enum class Dialog { kNone, kNew, kOpen, kBrowse };
  Dialog dialog = Dialog::kNone;
  bool dialog_is_new = false;
  std::optional<std::size_t> study;  ///< Of those opened lately, that arrow keys have come to.
  std::size_t chosen_card = 0;       ///< Drafts first, then shipped ones.
  std::string study_file;            ///< Typed instead of a card; "" for none.
  std::string new_folder;            ///< Where the new study goes.
  std::string proposed_folder;       ///< What stood there before anybody typed.
  FileDialogState opening;
  std::string problem;  ///< Why the last attempt did not work.
};

struct StartViewResult {
  struct Resume {
    std::filesystem::path folder;
    std::int64_t session = 0;
  };
  std::optional<Resume> resume;
  std::optional<std::filesystem::path> open;  ///< Folder or study file.
  struct New {
    std::string study;  ///< Name of a shipped study, or a path.
    std::filesystem::path folder;
  };
  std::optional<New> create;
  bool start_tour = false;
  bool device = false;  ///< Its view.
  bool data = false;    ///< That of somebody's own table.
};

[[nodiscard]] StartViewResult draw_start_view(Ui& ui, const StartModel& model,
                                              const EntriesOf& entries_of,
                                              StartViewState& state);

}  // namespace jnd::app::gui
