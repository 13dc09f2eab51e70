#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "support/program.h"

namespace jnd::app {
namespace exclude_test {

using test_support::ProgramOutcome;

class ExcludeCommandTest : public CommandTest {
 protected:
  ExcludeCommandTest() {
    write_file(temporary_.path() / "tiny.json", kTinyStudy);
    EXPECT_EQ(jnd({"simulate", "tiny.json", "--participants", "2", "--study", "a.study",
                   "--seed", "7"})
                  .exit_code,
              0);
  }
  [[nodiscard]] std::size_t trials_in_force(std::int64_t session) const {
    return core::StudyStore(temporary_.path() / "a.study", core::StudyStore::Mode::kReadOnly)
        .trials(session)
        .size();
  }
};

TEST_F(ExcludeCommandTest, LeavesTrialsOutWithTheReasonAndTakesThemBack) {
  const ProgramOutcome out = jnd({"exclude", "a.study", "--participant", "P02", "--trial", "3",
                                  "5", "--reason", "sneezed"});
  EXPECT_EQ(out.exit_code, 0) << out.err;
  EXPECT_NE(out.out.find("P02, session 2, trial 5: excluded"), std::string::npos) << out.out;
  EXPECT_EQ(trials_in_force(1), static_cast<std::size_t>(kTinyTrials));
  EXPECT_EQ(trials_in_force(2), static_cast<std::size_t>(kTinyTrials - 2));
  {
    const core::StudyStore store(temporary_.path() / "a.study",
                                 core::StudyStore::Mode::kReadOnly);
    EXPECT_EQ(store.events(2).back().kind, "trial_excluded");
    EXPECT_NE(store.events(2).back().data.find("sneezed"), std::string::npos);
  }
  EXPECT_EQ(jnd({"exclude", "a.study", "--session", "2", "--trial", "5", "--reason", "no",
                 "--include"})
                .exit_code,
            0);
  EXPECT_EQ(trials_in_force(2), static_cast<std::size_t>(kTinyTrials - 1));
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(ExcludeCommandTest, WhoHasNoAnswerLeftIsNotCounted) {
  std::vector<std::string> all = {"exclude",  "a.study", "--session", "1",
                                  "--reason", "asleep",  "--trial"};
  for (int trial = 1; trial <= kTinyTrials; ++trial) all.push_back(std::to_string(trial));
  ASSERT_EQ(jnd(all).exit_code, 0);
  const ProgramOutcome results = jnd({"results", "a.study"});
  EXPECT_TRUE(results.out.find(": 1 participant, SIMULATED") != std::string::npos)
      << results.out.substr(0, 200);
}

TEST_F(ExcludeCommandTest, OneOfAllTrialsMissingChangesNothing) {
  const ProgramOutcome out = jnd(
      {"exclude", "a.study", "--session", "1", "--trial", "2", "99", "--reason", "sneezed"});
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_NE(out.err.find("--trial 99: expected one of the session's 10 trials"),
            std::string::npos)
      << out.err;
  EXPECT_EQ(trials_in_force(1), static_cast<std::size_t>(kTinyTrials));
}

TEST_F(ExcludeCommandTest, SaysWhatIsMissingInTheCommand) {
  const ProgramOutcome whose = jnd({"exclude", "a.study", "--trial", "2", "--reason", "x"});
  EXPECT_EQ(whose.exit_code, 2);
  EXPECT_NE(whose.err.find("--participant or --session"), std::string::npos) << whose.err;
  EXPECT_EQ(jnd({"exclude", "a.study", "--session", "1", "--trial", "2"}).exit_code, 2);
  EXPECT_EQ(jnd({"exclude", "a.study", "--session", "1", "--reason", "x"}).exit_code, 2);
  EXPECT_EQ(
      jnd({"exclude", "a.study", "--session", "1", "--trial", "2", "--reason", ""}).exit_code,
      2);
  const ProgramOutcome nobody =
      jnd({"exclude", "a.study", "--participant", "P09", "--trial", "2", "--reason", "x"});
  EXPECT_EQ(nobody.exit_code, 1);
  EXPECT_NE(nobody.err.find("a session of P09, found none"), std::string::npos) << nobody.err;
}

}  // namespace exclude_test
}  // namespace jnd::app
