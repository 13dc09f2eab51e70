#include "app/operator/recent_studies.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/environment.h"
#include "app/tiny_study.h"
#include "core/error.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace recent_studies_test {

namespace fs = std::filesystem;

class RecentStudiesTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path file() const { return temporary_.path() / "state" / "recent.json"; }
  fs::path study(const std::string& name) const {
    fs::create_directories(temporary_.path() / name);
    return temporary_.path() / name;
  }
  [[nodiscard]] std::vector<fs::path> paths() const {
    std::vector<fs::path> all;
    for (const RecentStudy& one : recent_.list()) all.push_back(one.path);
    return all;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  RecentStudies recent_{file()};
};

TEST_F(RecentStudiesTest, TheLastOneOpenedComesFirstAndEachOnce) {
  recent_.add(study("a.study"), 10);
  recent_.add(study("b.study"), 20);
  recent_.add(temporary_.path() / "a.study/", 30);
  EXPECT_EQ(paths(), (std::vector<fs::path>{study("a.study"), study("b.study")}));
  EXPECT_EQ(recent_.list()[0].opened_ns, 30);
}

TEST_F(RecentStudiesTest, NoMoreThanTwelveAreKept) {
  for (int i = 0; i < 15; ++i) recent_.add(study(std::to_string(i) + ".study"), i);
  ASSERT_EQ(recent_.list().size(), 12U);
  EXPECT_EQ(recent_.list().front().path.filename(), "14.study");
  EXPECT_EQ(recent_.list().back().path.filename(), "3.study");
  EXPECT_EQ(nlohmann::json::parse(read_file(file()))["studies"].size(), 12U);
}

TEST_F(RecentStudiesTest, AFileThatSomebodyMadeLongerIsReadNoFurther) {
  std::string entries;
  for (int i = 0; i < 20; ++i) {
    entries += (i == 0 ? "" : ",") + std::string(R"({"path": "/a", "opened_ns": 1})");
  }
  fs::create_directories(file().parent_path());
  write_file(file(), R"({"studies": [)" + entries + "]}");
  EXPECT_EQ(recent_.list().size(), 12U);
}

TEST_F(RecentStudiesTest, OneThatVanishedIsMarkedUntilItIsRemoved) {
  recent_.add(study("a.study"), 1);
  recent_.add(temporary_.path() / "gone.study", 2);
  EXPECT_FALSE(recent_.list()[0].exists);
  EXPECT_TRUE(recent_.list()[1].exists);
  recent_.remove(temporary_.path() / "gone.study");
  EXPECT_EQ(paths(), std::vector<fs::path>{study("a.study")});
}

TEST_F(RecentStudiesTest, ADamagedFileIsAnEmptyListThatCanBeAddedTo) {
  for (const char* damage :
       {"", "{", "[]", "7", R"({"studies": 3})", R"({"studies": [1, {"path": 2}]})",
        R"({"studies": [{"path": "not/absolute", "opened_ns": 1}]})",
        R"({"studies": [{"path": "/a", "opened_ns": "x"}]})", "\xff\xfe"}) {
    fs::create_directories(file().parent_path());
    write_file(file(), damage);
    EXPECT_TRUE(recent_.list().empty()) << damage;
    recent_.add(study("a.study"), 1);
    EXPECT_EQ(recent_.list().size(), 1U) << damage;
  }
}

TEST_F(RecentStudiesTest, KeepsPathsAndTimesAloneForTheirOwnerAlone) {
  recent_.add(study("blind.study"), 5);
  const auto document = nlohmann::json::parse(read_file(file()));
  ASSERT_EQ(document["studies"].size(), 1U);
  EXPECT_EQ(document["studies"][0].size(), 2U) << document;
  EXPECT_EQ(fs::status(file()).permissions() & fs::perms::all,
            fs::perms::owner_read | fs::perms::owner_write);
  // The temporary file, through which the list was written, is gone.
  EXPECT_EQ(std::distance(fs::directory_iterator(file().parent_path()), {}), 1);
}

TEST_F(RecentStudiesTest, APathThatIsNoUtf8IsLeftOut) {
  recent_.add(study("a.study"), 1);
  recent_.add(temporary_.path() / "b\xff.study", 2);
  EXPECT_EQ(paths(), std::vector<fs::path>{study("a.study")});
}

TEST_F(RecentStudiesTest, AFolderThatCannotBeMadeIsToldAsSuch) {
  write_file(temporary_.path() / "file", "");
  const RecentStudies nowhere(temporary_.path() / "file" / "recent.json");
  EXPECT_TRUE(nowhere.list().empty());
  EXPECT_THROW(nowhere.add(study("a.study"), 1), core::Error);
}

TEST(RecentStudies, LieWhereTheSystemKeepsState) {
  {
    const EnvironmentVariable state("XDG_STATE_HOME", "/var/state");
    EXPECT_EQ(RecentStudies::default_file(), "/var/state/jnd/recent.json");
  }
  const EnvironmentVariable state("XDG_STATE_HOME", nullptr);
  {
    const EnvironmentVariable home("HOME", "/home/me");
    EXPECT_EQ(RecentStudies::default_file(), "/home/me/.local/state/jnd/recent.json");
  }
  const EnvironmentVariable home("HOME", nullptr);
  EXPECT_EQ(RecentStudies::default_file(), "");
  EXPECT_NO_THROW(RecentStudies().add("/tmp", 1));
}

}  // namespace recent_studies_test
}  // namespace jnd::app
