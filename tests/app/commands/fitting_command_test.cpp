#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/commands/command_fixture.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/files.h"

namespace jnd::app {
namespace fitting_command_test {

using test_support::ProgramOutcome;

class FittingCommandTest : public CommandTest {
 protected:
  void SetUp() override { test_support::write_file(path("tiny.json"), kTinyStudy); }
  [[nodiscard]] ProgramOutcome run(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"run",           "tiny.json", "--study", "t.study",
                                      "--participant", "P01",       "--seed",  "7",
                                      "--headless"};
    words.insert(words.end(), more.begin(), more.end());
    return jnd(words);
  }
};

TEST_F(FittingCommandTest, IsKeptOnceWithWhereTheHandRests) {
  const ProgramOutcome outcome = run({"--fitting", "glove=M", "--fitting", "thumb=a thin pad"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const core::StudyStore store = opened("t.study");
  std::vector<nlohmann::json> kept;
  for (const core::EventRow& event : store.events(1)) {
    if (event.kind == "fitting_kept") kept.push_back(nlohmann::json::parse(event.data));
  }
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0]["fitting"], (nlohmann::json{{"glove", "M"}, {"thumb", "a thin pad"}}));
  EXPECT_EQ(kept[0]["held"],
            nlohmann::json({"palm_inner", "palm_outer", "thumb", "index", "middle"}));
  ASSERT_EQ(kept[0]["neutral_pose_m"].size(), 5U);
  // The simulated hand rests below the surface.
  double mean_m = 0.0;
  for (const auto& position_m : kept[0]["neutral_pose_m"]) {
    mean_m += position_m.at(2).get<double>() / 5.0;
  }
  EXPECT_LT(mean_m, -0.05);
  EXPECT_GT(mean_m, -1.0);
  EXPECT_EQ(store.events(1).at(1).kind, "fitting_kept") << "before the first stage";
  EXPECT_EQ(jnd({"verify", "t.study"}).exit_code, 0);
}

TEST_F(FittingCommandTest, WhereNobodySaysNothingIsKept) {
  ASSERT_EQ(run({}).exit_code, 0);
  const std::vector<core::EventRow> events = opened("t.study").events(1);
  EXPECT_TRUE(std::none_of(events.begin(), events.end(), [](const core::EventRow& event) {
    return event.kind == "fitting_kept";
  }));
}

TEST_F(FittingCommandTest, WhatIsNoPairIsWrongUsage) {
  for (const char* wrong : {"glove", "glove=", "=M", "Glove=M"}) {
    const ProgramOutcome outcome = run({"--fitting", wrong});
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_EQ(sentence_flaw(outcome.err, {"--fitting: expected KEY=VALUE"}), "") << wrong;
  }
  const ProgramOutcome twice = run({"--fitting", "glove=M", "--fitting", "glove=L"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_EQ(sentence_flaw(twice.err, {"found `glove` a second time"}), "");
}

}  // namespace fitting_command_test
}  // namespace jnd::app
