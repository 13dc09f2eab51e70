#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/files.h"
#include "support/places.h"
#include "support/program.h"

namespace jnd::app {
namespace plan_balance_test {

using nlohmann::json;
using test_support::ProgramOutcome;

class PlanBalanceTest : public CommandTest {
 protected:
  /// Writes a study of two blocks whose stimuli come in Williams squares. Each person has one
  /// row of each square.
  void write_squares(std::size_t num_stimuli) {
    json study = json::parse(test_support::read_file(
        test_support::source_folder() / "protocols" / "viscosity_free_estimation.json"));
    json blocks = json::array();
    for (json stage : study["stages"]) {
      if (stage["name"] != "numbers") continue;
      stage["order"] = {{"method", "williams"}};
      json& stimuli = stage["viscosity_pa_s"];
      ASSERT_GE(stimuli.size(), num_stimuli);
      while (stimuli.size() > num_stimuli) stimuli.erase(stimuli.size() - 1);
      for (const char* name : {"first", "second"}) {
        stage["name"] = name;
        blocks.push_back(stage);
      }
    }
    study["stages"] = blocks;
    study.erase("$schema");
    test_support::write_file(path("squares.json"), study.dump(1));
  }

  static std::size_t num_cells_in(const std::string& out) {
    std::size_t num = 0;
    std::istringstream lines(out.substr(out.find("\nBalance: ")));
    for (std::string line; std::getline(lines, line);) num += line.starts_with("  first=row_");
    return num;
  }
};

TEST_F(PlanBalanceTest, OfManyCellsTheFirstAreShownAndAllAreAvailable) {
  write_squares(6);
  const ProgramOutcome folded = jnd({"plan", "squares.json", "--participants", "3"});
  ASSERT_EQ(folded.exit_code, 0) << folded.err;
  EXPECT_EQ(num_cells_in(folded.out), 12U);
  EXPECT_NE(folded.out.find("  ... and 24 more; with the planned ones each of all 36 has 0 to "
                            "1; --all lists them\n"),
            std::string::npos)
      << folded.out;
  const ProgramOutcome all = jnd({"plan", "squares.json", "--participants", "3", "--all"});
  EXPECT_EQ(num_cells_in(all.out), 36U);
  EXPECT_EQ(all.out.find("more;"), std::string::npos);
  const ProgramOutcome as_json = jnd({"plan", "squares.json", "--participants", "3", "--json"});
  EXPECT_EQ(document(as_json.out)["balance"].size(), 36U);
}

TEST_F(PlanBalanceTest, FewCellsAreShownWhole) {
  write_squares(2);
  const ProgramOutcome outcome = jnd({"plan", "squares.json", "--participants", "3"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(num_cells_in(outcome.out), 4U);
  EXPECT_EQ(outcome.out.find("--all"), std::string::npos);
}

TEST_F(PlanBalanceTest, NoLineEndsWithABlank) {
  for (const char* study : {"viscosity_interleaved", "viscosity_priming"}) {
    const ProgramOutcome outcome = jnd({"plan", study, "--participants", "2"});
    EXPECT_NE(outcome.out.find("\n  P02"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out.find(" \n"), std::string::npos) << outcome.out;
  }
}

}  // namespace plan_balance_test
}  // namespace jnd::app
