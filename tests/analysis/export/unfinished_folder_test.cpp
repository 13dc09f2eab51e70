#include "analysis/export/unfinished_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace {

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

}  // namespace
}  // namespace jnd::analysis
