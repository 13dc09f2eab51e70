#include "analysis/export/unfinished_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/missing_right.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace unfinished_folder_test {

namespace fs = std::filesystem;

class UnfinishedFolderTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::size_t num_entries() const {
    const fs::directory_iterator entries(temporary_.path());
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  }
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  fs::path out_ = temporary_.path() / "out";
};

TEST_F(UnfinishedFolderTest, IsNotThereBeforeItIsPublished) {
  UnfinishedFolder folder(out_);
  std::ofstream(folder.make("a/b") / "file") << "text";
  EXPECT_FALSE(fs::exists(out_));
  folder.publish();
  EXPECT_TRUE(fs::exists(out_ / "a" / "b" / "file"));
  EXPECT_EQ(num_entries(), 1U);
}

TEST_F(UnfinishedFolderTest, LeavesNothingIfItIsNeverPublished) {
  { std::ofstream(UnfinishedFolder(out_).make("a") / "file") << "text"; }
  EXPECT_EQ(num_entries(), 0U);
}

TEST_F(UnfinishedFolderTest, TakesAnEmptyFolderALinkToOneAndOneWithASlash) {
  fs::create_directory(out_);
  UnfinishedFolder(out_ / "").publish();
  fs::create_directory(temporary_.path() / "real");
  fs::create_directory_symlink(temporary_.path() / "real", temporary_.path() / "link");
  UnfinishedFolder linked(temporary_.path() / "link");
  std::ofstream(linked.path() / "file") << "text";
  linked.publish();
  EXPECT_TRUE(fs::exists(temporary_.path() / "real" / "file"));
  EXPECT_TRUE(fs::is_symlink(temporary_.path() / "link"));
}

/// The files must go to the disk that may be mounted there, and the parent folder need not be
/// writable.
TEST_F(UnfinishedFolderTest, FillsAnEmptyFolderFromWithin) {
  fs::create_directory(out_);
  {
    UnfinishedFolder folder(out_);
    EXPECT_EQ(folder.path().parent_path(), out_);
    std::ofstream(folder.make("a") / "file") << "text";
    std::ofstream(folder.path() / "unfinished") << "text";
  }
  EXPECT_TRUE(fs::is_empty(out_)) << "it was not published";
  UnfinishedFolder folder(out_);
  std::ofstream(folder.make("a") / "file") << "text";
  std::ofstream(folder.path() / "b") << "text";
  folder.publish();
  EXPECT_TRUE(fs::exists(out_ / "a" / "file"));
  EXPECT_TRUE(fs::exists(out_ / "b"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out_), fs::directory_iterator()), 2);
  EXPECT_EQ(num_entries(), 1U);
}

TEST_F(UnfinishedFolderTest, PublishesNothingBesideWhatCameIntoTheFolderMeanwhile) {
  fs::create_directory(out_);
  {
    UnfinishedFolder folder(out_);
    std::ofstream(folder.path() / "mine") << "text";
    std::ofstream(out_ / "precious") << "text";
    EXPECT_THROW(folder.publish(), core::Error);
  }
  EXPECT_TRUE(fs::exists(out_ / "precious"));
  EXPECT_FALSE(fs::exists(out_ / "mine"));
}

TEST_F(UnfinishedFolderTest, ErrorsNameTheFolderThatWasAskedForAndSayThatNothingIsThere) {
  std::string said;
  try {
    write_folder(out_, [](const UnfinishedFolder& folder) {
      throw core::Error((folder.path() / "trials.csv").string() + ": expected room");
    });
  } catch (const core::Error& error) {
    said = error.what();
  }
  EXPECT_EQ(said, (out_ / "trials.csv").string() + ": expected room; nothing was written");
  EXPECT_EQ(num_entries(), 0U);
}

TEST_F(UnfinishedFolderTest, AFileInItsPlaceIsNotCalledAFolder) {
  std::ofstream(out_) << "precious";
  try {
    const UnfinishedFolder folder(out_);
    FAIL() << "a file was taken for a folder";
  } catch (const core::Error& error) {
    const std::string said = error.what();
    EXPECT_EQ(said.find("files in it"), std::string::npos) << said;
    EXPECT_NE(said.find("something else of this name"), std::string::npos) << said;
  }
}

/// Nobody may make a folder there, not even root.
TEST_F(UnfinishedFolderTest, ARightThatLacksIsToldApart) {
  std::error_code error;
  if (fs::create_directory("/sys/jnd", error) || error == std::errc::read_only_file_system) {
    GTEST_SKIP() << "/sys is another one here";
  }
  EXPECT_THROW(UnfinishedFolder{"/sys/jnd"}, core::MissingRight);
}

TEST_F(UnfinishedFolderTest, OverwritesNothingAlsoIfItCameMeanwhile) {
  UnfinishedFolder folder(out_);
  fs::create_directory(out_);
  std::ofstream(out_ / "precious") << "text";
  EXPECT_THROW(folder.publish(), core::Error);
  EXPECT_THROW(UnfinishedFolder{out_}, core::Error);
  EXPECT_THROW(UnfinishedFolder{out_ / "precious"}, core::Error);
  EXPECT_THROW(UnfinishedFolder{out_ / "precious" / "below"}, core::Error);
  EXPECT_TRUE(fs::exists(out_ / "precious"));
}

}  // namespace unfinished_folder_test
}  // namespace jnd::analysis
