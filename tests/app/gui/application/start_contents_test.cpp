#include "app/gui/application/start_contents.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/operator/simulated_study.h"
#include "core/storage/backup.h"

namespace jnd::app::gui {
namespace start_contents_test {

namespace fs = std::filesystem;

TEST(StartContents, StudiesOfOneTitleShowTheirFolders) {
  const SimulatedStudy one, other;
  create_study_folder(one.file(), one.folder());
  const RecentStudies recent(one.temporary() / "recent.json");
  recent.add(one.folder(), 1);
  WorkControl control;
  EXPECT_EQ(look_around(recent, "lumped", "", control).studies.at(0).summary, "no session yet");
  create_study_folder(other.file(), other.folder());
  recent.add(other.folder(), 2);
  const StartModel model = look_around(recent, "lumped", "", control);
  ASSERT_EQ(model.studies.size(), 2U);
  for (const StartModel::Study& study : model.studies) {
    EXPECT_EQ(study.title, "Tiny");
    EXPECT_NE(study.summary.find(study.path.string()), std::string::npos) << study.summary;
  }
}

TEST(StartContents, ABackupIsListedAsOneBehindTheStudies) {
  SimulatedStudy made;
  made.simulate(1);
  (void)core::back_up(made.folder(), made.temporary() / "a_copy", 1);
  const std::vector<FolderEntry> entries = entries_of(made.temporary());
  const auto kind_of = [&](const fs::path& path) {
    return std::ranges::find(entries, path, &FolderEntry::path)->kind;
  };
  EXPECT_EQ(kind_of(made.folder()), FolderEntry::Kind::kStudyFolder);
  EXPECT_EQ(kind_of(made.temporary() / "a_copy"), FolderEntry::Kind::kBackup);
  EXPECT_EQ(entries.front().path, made.folder());
}

}  // namespace start_contents_test
}  // namespace jnd::app::gui
