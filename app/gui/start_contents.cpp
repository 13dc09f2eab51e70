#include "app/gui/start_contents.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "analysis/report/report_words.h"
#include "app/operator/study_outline.h"
#include "app/share.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped_studies() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(share_folder() / "protocols", error)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".json" && !name.ends_with(".schema.json")) {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
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
      study.summary =
          outline.problems.empty()
              ? "study file · no session yet"
              : "draft · " + analysis::counted_words(std::ssize(outline.problems), "problem") +
                    " in the study file";
    }
  } catch (const std::exception& error) {
    study.summary = error.what();
  }
  return study;
}

}  // namespace

StartModel look_around(const RecentStudies& recent, WorkControl& control) {
  StartModel model{.shipped = shipped_studies(), .version = JND_VERSION};
  for (const RecentStudy& study : recent.list()) {
    control.stop_if_cancelled();
    if (study.exists) model.studies.push_back(start_study(study.path));
  }
  model.machine = look_at_machine();
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
      entries.push_back({entry.path(), is_study ? FolderEntry::Kind::kStudyFolder
                                                : FolderEntry::Kind::kFolder});
    } else if (entry.path().extension() == ".json") {
      entries.push_back({entry.path(), FolderEntry::Kind::kStudyFile});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
    return std::pair(a.kind != FolderEntry::Kind::kStudyFolder, a.path) <
           std::pair(b.kind != FolderEntry::Kind::kStudyFolder, b.path);
  });
  return entries;
}

}  // namespace jnd::app::gui
