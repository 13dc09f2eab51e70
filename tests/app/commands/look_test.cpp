#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "experiments/designed_study.h"
#include "support/files.h"
#include "support/program.h"

namespace jnd::app {
namespace look_test {

using test_support::ProgramOutcome;
using Words = std::vector<std::string>;

class LookTest : public CommandTest {
 protected:
  LookTest() {
    test_support::write_file(path("looks.json"), with_looks(experiments::fluid_contrast()));
  }

  /// Returns a study with this contrast, which is named fluids, and with planned looks at it.
  static std::string with_looks(const std::string& contrast) {
    std::string text = experiments::designed_study(contrast);
    const std::string at = "\"factors\":";
    return text.replace(text.find(at), at.size(),
                        R"("sequential": {"contrast": "fluids", "looks": [6, 10, 14],
                           "spending": "pocock"}, "factors":)");
  }

  /// Simulates so many people, whose Weber fraction is `factor` times as large in thin fluids.
  void simulate(int participants, const std::string& factor) {
    const ProgramOutcome outcome = jnd(
        {"simulate", "looks.json", "--participants", std::to_string(participants), "--study",
         "s.study", "--fast", "--effect", "fluid=thin:weber_fraction_factor=" + factor});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  [[nodiscard]] std::string look(const Words& more = {}) {
    Words words = {"look", "s.study"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  }
};

TEST_F(LookTest, SaysGoOnAndNothingElseUntilThereAreEnoughPeople) {
  simulate(5, "5");
  EXPECT_EQ(look(),
            "Go on: 5 of at most 14 SIMULATED participants have a complete session, the next "
            "look is at 6.\n");
  EXPECT_TRUE(opened("s.study").looks().empty()) << "nobody looked at the data";
  for (const Words& words : {Words{"results", "s.study"},
                             {"report", "s.study", "--out", "report"},
                             {"export", "csv", "s.study", "--out", "csv"}}) {
    const ProgramOutcome sealed = jnd(words);
    EXPECT_EQ(sealed.exit_code, 1) << words[0];
    EXPECT_NE(sealed.err.find("results are sealed until then"), std::string::npos)
        << sealed.err;
    EXPECT_EQ(sealed.out, "") << words[0];
  }
}

TEST_F(LookTest, StopsWhereAnEffectIsLargeAndShowsAdjustedResultsThen) {
  simulate(7, "5");
  EXPECT_EQ(look(),
            "Stop: 7 of at most 14 SIMULATED participants have a complete session, and the "
            "rule of the study has ended it.\n");
  const std::vector<core::SequentialLookRow> looks = opened("s.study").looks();
  ASSERT_EQ(looks.size(), 1U);
  EXPECT_EQ(looks[0].decision, "stop");
  EXPECT_EQ(looks[0].sessions.size(), 6U) << "the first six of them";
  EXPECT_GT(looks[0].time_ns, 0);
  (void)look();
  EXPECT_EQ(opened("s.study").looks().size(), 1U) << "a look is taken once";

  const ProgramOutcome outcome = jnd({"results", "s.study", "--resamples", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto contrast = document(outcome.out)["contrasts"][0];
  EXPECT_EQ(contrast["sequential"]["ended"], true);
  EXPECT_EQ(contrast["sequential"]["num_participants"], 6);
  EXPECT_LT(contrast["p_value"], 0.05);
  EXPECT_NE(contrast["method"].get<std::string>().find("adjusted for the looks"),
            std::string::npos);
  const ProgramOutcome unsealed = jnd({"look", "s.study", "--unseal", "--reason", "late"});
  EXPECT_EQ(unsealed.exit_code, 1);
  EXPECT_NE(unsealed.err.find("found one that its rule has ended"), std::string::npos)
      << unsealed.err;

  const ProgramOutcome more = jnd({"run", "looks.json", "--participant", "P90", "--study",
                                   "s.study", "--headless", "--device", "lumped"});
  EXPECT_NE(more.err.find("ended it at look 1; one session more was not planned"),
            std::string::npos)
      << more.err;
}

TEST_F(LookTest, TakesEveryLookThatIsDueAndEndsAtTheLast) {
  simulate(14, "1");
  EXPECT_NE(look().find("Stop: 14 of at most 14"), std::string::npos);
  const std::vector<core::SequentialLookRow> looks = opened("s.study").looks();
  ASSERT_FALSE(looks.empty());
  std::size_t num_sessions = 0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_EQ(looks[i].decision, i + 1 == looks.size() ? "stop" : "go_on");
    num_sessions += looks[i].sessions.size();
  }
  EXPECT_EQ(num_sessions, looks.size() == 3 ? 14U : looks.size() == 2 ? 10U : 6U);
}

TEST_F(LookTest, IsKeptBeforeItIsToldAndStaysAsItWasTold) {
  simulate(6, "5");
  {
    // An earlier program decided that the study goes on.
    core::StudyStore store(path("s.study"), core::StudyStore::Mode::kReadWrite);
    store.add_look(
        {.look = 1, .decision = "go_on", .time_ns = 1, .sessions = {1, 2, 3, 4, 5, 6}});
  }
  EXPECT_NE(look().find("Go on: 6 of at most 14 SIMULATED"), std::string::npos);
  EXPECT_EQ(opened("s.study").looks().size(), 1U);
}

TEST_F(LookTest, UnsealingWantsAReasonIsKeptAndToldWithTheResults) {
  simulate(5, "5");
  EXPECT_EQ(jnd({"look", "s.study", "--unseal"}).exit_code, 2);
  EXPECT_EQ(jnd({"look", "s.study", "--reason", "curious"}).exit_code, 2);
  EXPECT_NE(look({"--unseal", "--reason", "the device broke"})
                .find("s.study: unsealed with 5 complete sessions, and kept so"),
            std::string::npos);
  ASSERT_EQ(opened("s.study").unsealings().size(), 1U);
  EXPECT_EQ(opened("s.study").unsealings()[0].reason, "the device broke");
  EXPECT_EQ(opened("s.study").unsealings()[0].num_complete, 5);
  const ProgramOutcome outcome = jnd({"results", "s.study", "--resamples", "100"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("looked at before the rule of the study has ended it, which was "
                             "not planned"),
            std::string::npos);
}

TEST_F(LookTest, ToldAsJsonItHasTheSameAndNothingMore) {
  simulate(5, "1");
  const auto json = document(look({"--json"}));
  EXPECT_EQ(json["decision"], "go_on");
  EXPECT_EQ(json["num_complete"], 5);
  EXPECT_EQ(json["max_participants"], 14);
  EXPECT_EQ(json["next_look"], 6);
  EXPECT_EQ(json["simulated"], true);
  EXPECT_EQ(json["unsealed"], false);
  EXPECT_EQ(json.size(), 6U);
}

TEST_F(LookTest, AStudyWithoutLooksIsRefusedInASentence) {
  test_support::write_file(path("plain.json"),
                           experiments::designed_study(experiments::fluid_contrast()));
  ASSERT_EQ(
      jnd({"simulate", "plain.json", "--participants", "1", "--study", "p.study", "--fast"})
          .exit_code,
      0);
  const ProgramOutcome outcome = jnd({"look", "p.study"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("expected a study that plans looks, found none in its file"),
            std::string::npos)
      << outcome.err;
}

TEST_F(LookTest, PowerSimulatesTheRuleAndShardsGiveTheSame) {
  // The contrast compares groups of people. Between fluids, whose levels are so easy, only half
  // an answer would differ.
  test_support::write_file(path("groups.json"),
                           with_looks(experiments::fluid_contrast(
                               "", "fluids", R"({"priming": {"primed": 1, "control": -1}})")));
  const Words words = {"power", "groups.json", "--participants", "6,14", "--runs", "40"};
  const auto with = [&](const Words& more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    const ProgramOutcome outcome = jnd(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const auto null = document(with({"--null", "--json"}))["sequential"];
  EXPECT_EQ(null["contrast"], "fluids");
  EXPECT_EQ(null["power_is"], "false_positive_rate");
  // In 40 runs without an effect, at most 7 reject with a probability of 99.9 %.
  EXPECT_LE(null["power"], 7.0 / 40.0);
  EXPECT_GT(null["expected_participants"], 12.0);
  const Words effect = {"--effect", "priming=primed:weber_fraction_factor=5"};
  Words json = effect;
  json.emplace_back("--json");
  const std::string whole = with(json);
  const auto power = document(whole)["sequential"];
  EXPECT_GT(power["power"], 0.9);
  EXPECT_LT(power["expected_participants"], 12.0);
  for (const char* shard : {"1/2", "2/2"}) {
    Words of_shard = effect;
    of_shard.insert(of_shard.end(), {"--shard", shard, "--out", "shards"});
    (void)with(of_shard);
  }
  const ProgramOutcome merged =
      jnd({"power-merge", "shards/shard-1-of-2.json", "shards/shard-2-of-2.json", "--json"});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(merged.out, whole);
  EXPECT_NE(with(effect).find("By looks at fluids: alpha 0.05, spent as by Pocock"),
            std::string::npos);
}

TEST_F(LookTest, APreregistrationNamesTheRuleAndWhatDeviatesFromIt) {
  const ProgramOutcome wrong =
      jnd({"preregister", "looks.json", "--participants", "12", "--study", "s.study"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("expected 14, the last of the study's looks, found 12"),
            std::string::npos)
      << wrong.err;
  const ProgramOutcome plan = jnd({"preregister", "looks.json", "--participants", "14",
                                   "--study", "s.study", "--out", "plan"});
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const std::string text = test_support::read_file(path("plan") / "preregistration.md");
  EXPECT_NE(text.find("The study is looked at after 6, 10, 14 complete sessions"),
            std::string::npos);
  EXPECT_NE(text.find("as by Pocock"), std::string::npos);
  simulate(6, "5");
  (void)look();
  const auto results =
      document(jnd({"results", "s.study", "--resamples", "100", "--json"}).out);
  for (const auto& deviation : results["preregistration"]["deviations"]) {
    EXPECT_NE(deviation["topic"], "number of participants")
        << "the rule has said how many: " << deviation.dump();
  }
}

}  // namespace look_test
}  // namespace jnd::app
