#include <gtest/gtest.h>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "support/program.h"

namespace jnd::app {
namespace simulate_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class SimulateCommandTest : public CommandTest {
 protected:
  SimulateCommandTest() { write_file(temporary_.path() / "tiny.json", kTinyStudy); }

  ProgramOutcome simulate(const std::string& study, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"simulate", "tiny.json", "--participants", "4",
                                      "--study",  study,       "--seed",         "11"};
    words.insert(words.end(), more.begin(), more.end());
    return test_support::run_program(words, {.folder = temporary_.path(), .environment = {}});
  }
};

TEST_F(SimulateCommandTest, EverySessionIsTheSameForAnyNumberOfJobs) {
  ASSERT_EQ(simulate("one.study", {"--jobs", "1"}).exit_code, 0);
  ASSERT_EQ(simulate("two.study", {"--jobs", "2"}).exit_code, 0);
  const core::StudyStore one = opened("one.study");
  const core::StudyStore two = opened("two.study");
  ASSERT_EQ(one.sessions().size(), 4U);
  for (std::int64_t session = 1; session <= 4; ++session) {
    EXPECT_TRUE(one.completed(session));
    EXPECT_EQ(difference(tables_text(one, session), tables_text(two, session)), "") << session;
    EXPECT_EQ(difference(samples_text(one, session), samples_text(two, session)), "")
        << session;
  }
}

TEST_F(SimulateCommandTest, FastGivesTheSameAnswersWithoutSamples) {
  ASSERT_EQ(simulate("full.study").exit_code, 0);
  ASSERT_EQ(simulate("fast.study", {"--fast"}).exit_code, 0);
  const core::StudyStore full = opened("full.study");
  const core::StudyStore fast = opened("fast.study");
  for (std::int64_t session = 1; session <= 4; ++session) {
    EXPECT_EQ(difference(tables_text(full, session), tables_text(fast, session)), "")
        << session;
    EXPECT_NE(samples_text(full, session), "") << session;
    EXPECT_EQ(samples_text(fast, session), "") << session;
  }
}

TEST_F(SimulateCommandTest, ParticipantsAndSeedsDiffer) {
  ASSERT_EQ(simulate("a.study", {"--fast"}).exit_code, 0);
  ASSERT_EQ(simulate("b.study", {"--fast", "--seed", "12"}).exit_code, 2) << "given twice";
  ASSERT_EQ(test_support::run_program({"simulate", "tiny.json", "--participants", "1",
                                       "--study", "b.study", "--seed", "12", "--fast"},
                                      {.folder = temporary_.path(), .environment = {}})
                .exit_code,
            0);
  const core::StudyStore a = opened("a.study");
  EXPECT_NE(trials_text(a, 1), trials_text(a, 2));
  EXPECT_NE(trials_text(a, 1), trials_text(opened("b.study"), 1));
}

TEST_F(SimulateCommandTest, GoesOnWithTheNextFreePseudonyms) {
  ASSERT_EQ(simulate("a.study", {"--fast"}).exit_code, 0);
  const ProgramOutcome outcome = simulate("a.study", {"--fast", "--json"});
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const auto json = document(outcome.out);
  EXPECT_EQ(json["participants"], (nlohmann::json{"P05", "P06", "P07", "P08"}));
  EXPECT_EQ(json["study"], "tiny");
  EXPECT_EQ(opened("a.study").sessions().size(), 8U);
}

TEST_F(SimulateCommandTest, AFolderThatIsAFileIsToldInOneSentence) {
  write_file(temporary_.path() / "file.study", "not a folder");
  const ProgramOutcome outcome = simulate("file.study");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("file.study"), std::string::npos) << outcome.err;
}

TEST_F(SimulateCommandTest, ForeignDatabasesAreLeftAlone) {
  fs::create_directory(temporary_.path() / "foreign.study");
  write_file(temporary_.path() / "foreign.study/study.sqlite", "not a database, but precious");
  EXPECT_EQ(simulate("foreign.study").exit_code, 1);
  EXPECT_EQ(read_file(temporary_.path() / "foreign.study/study.sqlite"),
            "not a database, but precious");
}

}  // namespace simulate_test
}  // namespace jnd::app
