#include "core/storage/study_format.h"

#include <gtest/gtest.h>

#include "core/storage/integrity.h"
#include "core/storage/kept_study.h"
#include "support/places.h"

namespace jnd::core {
namespace study_format_test {

namespace fs = std::filesystem;

class StudyFormatTest : public ::testing::Test {
 protected:
  StudyFormatTest() {
    fs::copy(test_support::source_folder() / "tests/core/storage/layout_1", old(),
             fs::copy_options::recursive);
  }
  [[nodiscard]] fs::path old() const { return temporary_.path() / "old.study"; }
  [[nodiscard]] std::int64_t format() const {
    Database database(old() / "study.sqlite", Database::Mode::kReadOnly,
                      Durability::kEveryCommit);
    return study_format_of(database);
  }

  test_support::TemporaryFolder temporary_;
};

TEST_F(StudyFormatTest, AnOlderStudyIsReadAndStaysAsItIs) {
  ASSERT_EQ(format(), 1);
  const std::string before = bytes_of(old() / "study.sqlite");
  {
    const StudyStore store(old(), StudyStore::Mode::kReadOnly);
    EXPECT_EQ(store.sessions().at(0).participant, "P01");
    EXPECT_EQ(store.events(1).size(), 45U);
    EXPECT_EQ(store.protocol(store.sessions()[0].protocol_sha256).relative_path, "");
    EXPECT_TRUE(verify(store).complete);
  }
  EXPECT_EQ(bytes_of(old() / "study.sqlite"), before);
}

TEST_F(StudyFormatTest, AnOlderStudyIsBroughtUpToDateBeforeItIsWrittenTo) {
  {
    StudyStore store(old(), StudyStore::Mode::kReadWrite);
    store.append({.event = {.session = 1, .sequence = 46, .kind = "note_added"}});
  }
  EXPECT_EQ(format(), current_study_format());
  const StudyStore store(old(), StudyStore::Mode::kReadOnly);
  EXPECT_EQ(store.events(1).size(), 46U);
  EXPECT_EQ(store.study_id().size(), 32U);
}

TEST_F(StudyFormatTest, EachStepOrNothing) {
  Database database(old() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  // The second step makes this table; that it cannot leaves the first layout behind, whole.
  database.execute("CREATE TABLE backup (in_the_way INTEGER)");
  EXPECT_THROW(bring_up_to_date(database), Error);
  EXPECT_EQ(study_format_of(database), 1);
  database.execute("DROP TABLE backup");
  EXPECT_NO_THROW(bring_up_to_date(database));
  EXPECT_EQ(study_format_of(database), current_study_format());
}

TEST_F(StudyFormatTest, ANewerLayoutIsRefusedReadingAndWriting) {
  {
    Database database(old() / "study.sqlite", Database::Mode::kReadWrite,
                      Durability::kEveryCommit);
    database.execute("INSERT INTO study_format VALUES (99, 'jnd 9')");
  }
  for (const auto mode :
       {StudyStore::Mode::kReadOnly, StudyStore::Mode::kReadWrite, StudyStore::Mode::kCreate}) {
    try {
      const StudyStore store(old(), mode);
      FAIL() << "opened";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("found 99; open it with a newer jnd"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(bytes_of(old() / "study.sqlite").empty(), false);
}

TEST_F(StudyFormatTest, AFreshStudyHasEveryStepNoted) {
  const fs::path fresh = temporary_.path() / "fresh.study";
  { const StudyStore store(fresh, StudyStore::Mode::kCreate); }
  Database database(fresh / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  Statement count(database, "SELECT COUNT(*) FROM study_format");
  ASSERT_TRUE(count.step());
  EXPECT_EQ(count.integer(0), current_study_format());
}

}  // namespace study_format_test
}  // namespace jnd::core
