#include "app/gui/application/start_contents.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>
#include <utility>

#include "app/language/words.h"
#include "app/operator/device_look.h"
#include "app/operator/study_outline.h"
#include "core/error.h"
#include "core/storage/backup_mark.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

/// The path as a shell writes it, with "~" for the home folder.
std::string path_words(const fs::path& path) {
  const char* home = std::getenv("HOME");
  const std::string text = path.string();
  const std::string begin = home == nullptr ? "" : std::string(home) + "/";
  return begin.size() > 1 && text.starts_with(begin) ? "~/" + text.substr(begin.size()) : text;
}

StartModel::Study start_study(const fs::path& path) {
  StartModel::Study study{.path = path};
  study.title = path.stem().string();
  try {
    if (fs::is_directory(path)) {
      study.folder = open_study_folder(path);
      study.title = study.folder->title;
      study.summary = study.folder->summary();
    } else {
      const StudyOutline outline = read_outline(path);
      if (!outline.title.empty()) study.title = outline.title;
      study.summary = outline.problems.empty() ? std::string(tr("study file · no session yet"))
                                               : trn("draft · {} problem in the study file",
                                                     "draft · {} problems in the study file",
                                                     std::ssize(outline.problems));
    }
  } catch (const std::exception& error) {
    study.summary = error.what();
  }
  return study;
}

/// Puts its path before the summary of each study that shares its title with another one.
void tell_namesakes_apart(std::vector<StartModel::Study>& studies) {
  std::map<std::string, int> num_of_title;
  for (const StartModel::Study& study : studies) ++num_of_title[study.title];
  for (StartModel::Study& study : studies) {
    if (num_of_title[study.title] > 1)
      study.summary = path_words(study.path) + " · " + study.summary;
  }
}

/// The order in the list: studies, then backups, then other folders.
int rank_of(FolderEntry::Kind kind) {
  if (kind == FolderEntry::Kind::kStudyFolder) return 0;
  return kind == FolderEntry::Kind::kBackup ? 1 : 2;
}

FolderEntry::Kind kind_of_study(const fs::path& folder) {
  try {
    return core::is_backup(folder) ? FolderEntry::Kind::kBackup
                                   : FolderEntry::Kind::kStudyFolder;
  } catch (const core::Error&) {
    return FolderEntry::Kind::kStudyFolder;  // Opening the folder will say what is wrong.
  }
}

}  // namespace

StartModel look_around(const RecentStudies& recent, const std::string& device,
                       const std::string& profile, WorkControl& control) {
  const std::vector<RecentStudy> opened = recent.list();
  StartModel model{
      .drafts = draft_cards(opened), .shipped = shipped_study_cards(), .version = JND_VERSION};
  for (const RecentStudy& study : opened) {
    control.stop_if_cancelled();
    if (study.exists) model.studies.push_back(start_study(study.path));
  }
  tell_namesakes_apart(model.studies);
  model.machine = look_at_machine();
  model.machine.push_back(waiting_device_line(device, profile));
  return model;
}

std::vector<FolderEntry> entries_of(const fs::path& folder) {
  std::vector<FolderEntry> entries;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".")) continue;
    if (entry.is_directory(error)) {
      const bool is_study = fs::exists(entry.path() / "study.sqlite", error);
      entries.push_back(
          {entry.path(), is_study ? kind_of_study(entry.path()) : FolderEntry::Kind::kFolder});
    } else if (entry.path().extension() == ".json") {
      entries.push_back({entry.path(), FolderEntry::Kind::kStudyFile});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
    return std::pair(rank_of(a.kind), a.path) < std::pair(rank_of(b.kind), b.path);
  });
  return entries;
}

}  // namespace jnd::app::gui
