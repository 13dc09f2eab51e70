#include <gtest/gtest.h>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "support/program.h"

namespace jnd::app {
namespace unblind_test {

using test_support::ProgramOutcome;

class UnblindCommandTest : public CommandTest {
 protected:
  UnblindCommandTest() {
    write_file(temporary_.path() / "blind.json",
               replaced(kTinyStudy, R"("languages")", R"("blinding": "double", "languages")"));
    EXPECT_EQ(jnd({"simulate", "blind.json", "--participants", "2", "--study", "a.study",
                   "--seed", "7"})
                  .exit_code,
              0);
  }
};

TEST_F(UnblindCommandTest, ADoubleBlindStudyShowsNothingUntilSomebodyUnblindsIt) {
  const std::vector<std::vector<std::string>> kLooks = {
      {"results", "a.study"},
      {"export", "csv", "a.study", "--out", "csv"},
      {"plan", "blind.json", "--study", "a.study"}};
  for (const auto& look : kLooks) {
    const ProgramOutcome out = jnd(look);
    EXPECT_EQ(out.exit_code, 1) << look[0];
    EXPECT_EQ(out.out, "") << look[0];
    EXPECT_NE(out.err.find("blind"), std::string::npos) << out.err;
  }
  EXPECT_FALSE(std::filesystem::exists(temporary_.path() / "csv"));

  EXPECT_EQ(jnd({"unblind", "a.study"}).exit_code, 2);
  EXPECT_EQ(jnd({"unblind", "a.study", "--reason", "all sessions done"}).exit_code, 0);
  for (const auto& look : kLooks) EXPECT_EQ(jnd(look).exit_code, 0) << look[0];

  const core::StudyStore store(temporary_.path() / "a.study",
                               core::StudyStore::Mode::kReadOnly);
  for (const std::int64_t session : {1, 2}) {
    EXPECT_EQ(store.events(session).back().kind, "unblinded");
    EXPECT_NE(store.events(session).back().data.find("all sessions done"), std::string::npos);
  }
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(UnblindCommandTest, TheRecordOutlivesTheParticipants) {
  EXPECT_EQ(jnd({"unblind", "a.study", "--reason", "paper"}).exit_code, 0);
  EXPECT_EQ(
      jnd({"simulate", "blind.json", "--participants", "1", "--study", "a.study"}).exit_code,
      0);
  for (const char* name : {"P01", "P02"}) {
    EXPECT_EQ(jnd({"withdraw", "a.study", "--participant", name}).exit_code, 0);
  }
  EXPECT_EQ(jnd({"export", "csv", "a.study", "--out", "csv"}).exit_code, 0);
}

TEST_F(UnblindCommandTest, AStudyThatIsNotBlindHasNothingToUnblind) {
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  ASSERT_EQ(
      jnd({"simulate", "tiny.json", "--participants", "1", "--study", "b.study"}).exit_code, 0);
  const ProgramOutcome out = jnd({"unblind", "b.study", "--reason", "x"});
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_NE(out.err.find("expected a double-blind study"), std::string::npos) << out.err;
}

}  // namespace unblind_test
}  // namespace jnd::app
