#include "app/operator/study_outline.h"
#include "app/session/pseudonym.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/answering_study.h"
#include "app/operator/simulated_study.h"
#include "experiments/session/plan.h"
#include "support/places.h"

namespace jnd::app {
namespace study_outline_test {

namespace fs = std::filesystem;

experiments::Study tiny() { return experiments::read_study_text(kTinyStudy, "tiny.json"); }

experiments::Study shipped(const char* name) {
  return experiments::read_study(test_support::source_folder() / "protocols" / name);
}

const OutlineStage& stage(const StudyOutline& outline, const std::string& title) {
  for (const OutlineStage& one : outline.stages) {
    if (one.title == title) return one;
  }
  throw std::out_of_range("no stage " + title);
}

std::string all_words(const StudyOutline& outline) {
  std::string words = outline.title + "|" + outline.blinding;
  for (const OutlineStage& one : outline.stages) {
    words += "|" + one.title + "|" + one.kind + "|" + one.what + "|" + one.only_for;
    for (const std::string& detail : one.details) words += "|" + detail;
  }
  return words;
}

TEST(StudyOutline, TellsEveryStageInTheOrderOfTheFile) {
  const StudyOutline outline = outline_of(tiny());
  EXPECT_EQ(outline.title, "Tiny");
  EXPECT_EQ(outline.authors, "A. Author");
  ASSERT_EQ(outline.stages.size(), 8U);
  EXPECT_EQ(outline.stages[0].kind, "Checklist");
  EXPECT_EQ(outline.stages[0].what, "1 item");
  EXPECT_EQ(outline.stages[2].what, "1 medium");
  EXPECT_EQ(outline.stages[2].details, std::vector<std::string>{"free space, 0 s"});
  EXPECT_EQ(outline.stages[5].what, "at least 1 min");
  EXPECT_EQ(outline.stages[7].title, "About you");
  for (std::size_t i = 1; i < outline.stages.size(); ++i) {
    EXPECT_GT(outline.stages[i].line, outline.stages[i - 1].line);
  }
}

TEST(StudyOutline, TellsStimuliWithUnits) {
  const StudyOutline outline = outline_of(tiny());
  const OutlineStage& estimation = stage(outline, "Estimation");
  EXPECT_EQ(estimation.kind, "Magnitude estimation");
  EXPECT_EQ(estimation.what, "2 stimuli, 2 times: 4 trials");
  EXPECT_EQ(estimation.details, std::vector<std::string>{"water, scale 0.5, 2"});
  const OutlineStage& production = stage(outline, "Production");
  EXPECT_EQ(production.what, "2 starting values for 1 target: 2 trials");
  EXPECT_EQ(production.details, (std::vector<std::string>{"water, scale 1, 2", "targets 100 %",
                                                          "steps of 0.5, 0.25"}));
  const OutlineStage& comparison = stage(outline, "Comparison");
  EXPECT_EQ(comparison.details,
            (std::vector<std::string>{"viscous, 4, 16 Pa s", "reference 8 Pa s"}));
}

TEST(StudyOutline, DurationsAndTrialsAreThoseOfThePlan) {
  for (const char* name : {"viscosity_discrimination.json", "magnitude_of_virtual_water.json",
                           "short_tour.json"}) {
    const experiments::Study study = shipped(name);
    const StudyOutline outline = outline_of(study);
    double shortest_s = 1e300;
    double longest_s = 0.0;
    int num_trials = 0;
    for (const experiments::ParticipantPlan& plan :
         experiments::plan_participants(study, {.participants = next_participants({}, 24)})) {
      shortest_s = std::min(shortest_s, plan.duration_s);
      longest_s = std::max(longest_s, plan.duration_s);
      int trials = 0;
      for (const experiments::PlannedBlock& block : plan.blocks) trials += block.num_trials;
      num_trials = std::max(num_trials, trials);
    }
    EXPECT_DOUBLE_EQ(outline.shortest_s, shortest_s) << name;
    EXPECT_DOUBLE_EQ(outline.longest_s, longest_s) << name;
    EXPECT_DOUBLE_EQ(longest_session_s(study), longest_s) << name;
    EXPECT_EQ(outline.num_trials, num_trials) << name;
    // The durations of the top level add up to the longest session. A counterbalance counts
    // once together with its stages.
    double sum_s = 0.0;
    for (const OutlineStage& one : outline.stages) {
      EXPECT_FALSE(one.kind.empty()) << name << " " << one.title;
      EXPECT_FALSE(one.title.empty()) << name;
      if (one.depth == 0 && one.only_for.empty()) sum_s += one.duration_s;
    }
    EXPECT_LE(sum_s, longest_s + 1e-6) << name;
  }
}

TEST(StudyOutline, ACounterbalanceShowsItsArmsFurtherIn) {
  const StudyOutline outline = outline_of(shipped("viscosity_discrimination.json"));
  bool found = false;
  for (std::size_t i = 0; i + 2 < outline.stages.size(); ++i) {
    if (outline.stages[i].kind != "Order") continue;
    found = true;
    const int depth = outline.stages[i].depth;
    EXPECT_EQ(outline.stages[i + 1].kind, "Arm");
    EXPECT_EQ(outline.stages[i + 1].depth, depth + 1);
    EXPECT_EQ(outline.stages[i + 2].depth, depth + 2);
  }
  EXPECT_TRUE(found);
}

TEST(StudyOutline, ADoubleBlindStudyTellsNeitherLevelNorNameOfABlock) {
  const experiments::Study study = experiments::read_study_text(
      replaced(kDoubleBlindStudy, R"({"medium": "free_space", "duration_s": 0.5})",
               R"({"medium": "water", "scale": 3, "duration_s": 30},
                {"medium": "free_space", "duration_s": 30})"),
      "t.json");
  const StudyOutline hidden = outline_of(study);
  EXPECT_TRUE(hidden.hides_levels);
  EXPECT_NO_THROW((void)stage(hidden, "Block 3"));
  for (const char* word : {"Comparison", "Estimation", "0.5", "16", "Pa s", "scale", "water"}) {
    EXPECT_EQ(all_words(hidden).find(word), std::string::npos) << word << all_words(hidden);
  }
  EXPECT_EQ(stage(hidden, "Free").details,
            (std::vector<std::string>{"a fluid, 30 s", "free space, 30 s"}));
  EXPECT_NE(all_words(outline_of(study, /*shows_levels=*/true)).find("16 Pa s"),
            std::string::npos);
}

TEST(StudyOutline, EveryProblemIsToldAtItsPlace) {
  const SimulatedStudy made;
  const fs::path file =
      write_file(made.temporary() / "wrong.json",
                 replaced(replaced(kTinyStudy, R"("scale": [0.5, 2])", R"("scale": [-1, 2])"),
                          R"("duration_s": 60)", R"("duration": 60)"));
  const StudyOutline outline = read_outline(file);
  EXPECT_EQ(outline.file, file);
  EXPECT_TRUE(outline.stages.empty());
  ASSERT_GE(outline.problems.size(), 3U);
  EXPECT_EQ(outline.problems[0].pointer, "/stages/3/scale/0");
  EXPECT_EQ(outline.problems[0].line, 15);
  EXPECT_GT(outline.problems[0].column, 1);
  EXPECT_NE(outline.problems[0].message.find("-1"), std::string::npos);
}

TEST(StudyOutline, AFileThatIsNotThereIsAProblem) {
  const StudyOutline outline = read_outline("/nowhere/study.json");
  ASSERT_EQ(outline.problems.size(), 1U);
  EXPECT_FALSE(outline.problems[0].message.empty());
}

TEST(PlannedOrders, AreWhatSessionsWillDraw) {
  SimulatedStudy made;
  made.simulate(1);
  const std::vector<PlannedOrder> orders =
      planned_orders(made.study(), {.folder = made.folder(), .num_participants = 2, .seed = 3});
  ASSERT_EQ(orders.size(), 2U);
  EXPECT_EQ(orders[0].participant, "P02");
  EXPECT_GT(orders[0].duration_s, 0.0);
  ASSERT_EQ(orders[0].blocks.size(), 3U);
  made.simulate(1);
  const core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadOnly);
  std::string drawn;
  for (const core::DesignRow& row : store.design(2)) {
    if (row.block != "comparison") continue;
    drawn += (drawn.empty() ? "" : ", ") + std::to_string(static_cast<int>(*row.intensity));
  }
  EXPECT_EQ(orders[0].blocks[2], "Comparison: " + drawn + " Pa s");
}

TEST(PlannedOrders, OfMatchesHaveTheirStandardsAndOfStaircasesWhatTheyDo) {
  const auto shipped = [](const char* name) {
    return experiments::read_study(test_support::source_folder() / "protocols" /
                                   (std::string(name) + ".json"));
  };
  const OrdersRequest one{.num_participants = 1, .seed = 1};
  const std::string matches = planned_orders(shipped("viscosity_matching"), one)[0].blocks[0];
  EXPECT_TRUE(matches.starts_with("First half: ")) << matches;
  EXPECT_NE(matches.find("16 (from 0.5)"), std::string::npos) << matches;
  const auto stairs = planned_orders(shipped("viscosity_threshold"), one)[0].blocks;
  EXPECT_NE((stairs[0] + stairs[1]).find("about 50 trials, 2 staircases, 1 up 1 down"),
            std::string::npos)
      << stairs[0] << stairs[1];
}

TEST(PlannedOrders, MakeUpForTheSessionsThatAreDone) {
  SimulatedStudy made(kCounterbalancedStudy);
  made.simulate(1);
  const core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadOnly);
  const std::string done =
      cell_words(experiments::cell_from_text(made.study(), store.session(1).cells));
  const std::string other = done == "first arm, then second arm" ? "second arm, then first arm"
                                                                 : "first arm, then second arm";
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const auto orders = planned_orders(made.study(), {.folder = made.folder(), .seed = seed});
    EXPECT_EQ(orders.front().cells, other) << seed;
    EXPECT_EQ(orders.front().participant, "P02");
  }
}

TEST(PlannedOrders, OfADoubleBlindStudyAreShownOnceItIsUnblinded) {
  SimulatedStudy made(kDoubleBlindStudy);
  made.simulate(1);
  EXPECT_TRUE(planned_orders(made.study(), {}).empty());
  EXPECT_TRUE(planned_orders(made.study(), {.folder = made.folder()}).empty());
  core::StudyStore(made.folder(), core::StudyStore::Mode::kReadWrite).add_unblinding(1, "done");
  EXPECT_FALSE(planned_orders(made.study(), {.folder = made.folder()}).empty());
}

TEST(Words, OfMediaCellsAndDurations) {
  EXPECT_EQ(words_of({"water", "scale", 2.0}), "water, scale 2");
  EXPECT_EQ(words_of({"viscous", "viscosity_pa_s", 8.0}), "viscous, 8 Pa s");
  EXPECT_EQ(words_of({"free_space", "", 0.0}), "free space");
  EXPECT_EQ(cell_words({}), "");
  // If each arm is one block, the words are the blocks' titles.
  const experiments::Study titled = shipped("viscosity_discrimination.json");
  EXPECT_EQ(cell_words(titled, {{"group_order", {"e", "d"}}}), "Group E, then Group D");
  EXPECT_EQ(cell_words({{"order", {"low_first", "high"}}, {"priming", {"primed"}}}),
            "low first, then high; primed");
  EXPECT_EQ(duration_words(0.0), "0 s");
  EXPECT_EQ(duration_words(59.0), "59 s");
  EXPECT_EQ(duration_words(59.9), "1 min");
  EXPECT_EQ(duration_words(3540.0), "59 min");
  EXPECT_EQ(duration_words(3600.0), "1 h");
  EXPECT_EQ(duration_words(3900.0), "1 h 5 min");
  EXPECT_EQ(duration_words(-1.0), "unknown");
}

TEST(ShownTitles, FallBackOnNamesAndNumberHiddenBlocksByTheirPlace) {
  const experiments::Study study = tiny();
  const std::vector<const experiments::Stage*> stages = {&study.stages[6], &study.stages[5],
                                                         &study.stages[3]};
  EXPECT_EQ(shown_titles(stages, "en", false),
            (std::vector<std::string>{"Comparison", "Rest", "Estimation"}));
  EXPECT_EQ(shown_titles(stages, "en", true),
            (std::vector<std::string>{"Block 1", "Rest", "Block 2"}));
}

class StudyWatchTest : public ::testing::Test {
 protected:
  /// Saves as editors do: into a file beside it, which then replaces it.
  void save(const std::string& text) const {
    fs::rename(write_file(temporary_.path() / "new", text), file_);
  }
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  fs::path file_ = write_file(temporary_.path() / "tiny.json", kTinyStudy);
  StudyWatch watch_{file_};
};

TEST_F(StudyWatchTest, ReadsTheFileAgainOnceItWasSaved) {
  EXPECT_EQ(watch_.outline().title, "Tiny");
  EXPECT_FALSE(watch_.look(0.0));
  save(replaced(kTinyStudy, R"("en": "Tiny")", R"("en": "Tony")"));
  EXPECT_TRUE(watch_.look(1.0));
  EXPECT_EQ(watch_.outline().title, "Tony");
  EXPECT_TRUE(watch_.study().has_value());
  EXPECT_FALSE(watch_.look(2.0));
  EXPECT_EQ(watch_.num_reloads(), 1);
}

TEST_F(StudyWatchTest, AFileOfTheSameSizeAndTimeIsAnotherFileAllTheSame) {
  const auto time = fs::last_write_time(file_);
  EXPECT_FALSE(watch_.look(0.0));
  save(replaced(kTinyStudy, R"("en": "Tiny")", R"("en": "Tony")"));
  fs::last_write_time(file_, time);
  EXPECT_TRUE(watch_.look(1.0));
}

TEST_F(StudyWatchTest, LooksTwiceASecondAtMost) {
  EXPECT_FALSE(watch_.look(10.0));
  save(replaced(kTinyStudy, R"("en": "Tiny")", R"("en": "Tony")"));
  EXPECT_FALSE(watch_.look(10.3));
  EXPECT_TRUE(watch_.look(10.5));
}

TEST_F(StudyWatchTest, AFileThatIsGoneOrEmptyForAMomentIsNoErrorYet) {
  fs::remove(file_);
  EXPECT_FALSE(watch_.look(1.0));
  EXPECT_TRUE(watch_.study().has_value());
  write_file(file_, "");
  EXPECT_FALSE(watch_.look(2.0));
  save(kTinyStudy);
  EXPECT_TRUE(watch_.look(2.6));
  EXPECT_TRUE(watch_.outline().problems.empty());

  fs::remove(file_);
  EXPECT_FALSE(watch_.look(10.0));
  EXPECT_FALSE(watch_.look(11.9));
  EXPECT_TRUE(watch_.look(12.5)) << "gone for good";
  EXPECT_EQ(watch_.outline().problems.size(), 1U);
  EXPECT_FALSE(watch_.study().has_value());
  EXPECT_FALSE(watch_.look(13.5));
  save(kTinyStudy);
  EXPECT_TRUE(watch_.look(14.5));
  EXPECT_TRUE(watch_.study().has_value());
}

TEST_F(StudyWatchTest, ShowsTheLevelsOfABlindStudyToWhomItWasUnblindedFor) {
  save(kDoubleBlindStudy);
  EXPECT_TRUE(StudyWatch(file_).outline().hides_levels);
  EXPECT_FALSE(StudyWatch(file_, /*shows_levels=*/true).outline().hides_levels);
}

TEST_F(StudyWatchTest, ProblemsComeAndGoWithTheFile) {
  save(replaced(kTinyStudy, "\"tiny\"", "7"));
  EXPECT_TRUE(watch_.look(1.0));
  EXPECT_FALSE(watch_.outline().problems.empty());
  EXPECT_FALSE(watch_.study().has_value());
  save(kTinyStudy);
  EXPECT_TRUE(watch_.look(2.0));
  EXPECT_TRUE(watch_.outline().problems.empty());
}

TEST(StudyOutline, TellsWhatBoundsATrial) {
  const StudyOutline outline =
      outline_of(experiments::read_study_text(kAnsweringStudy, "study.json"));
  const std::vector<std::string>& open = outline.stages.at(0).details;
  for (const char* words :
       {"\"cannot tell\" is an answer, too",
        "an answer has 3 s, or it is missed and the trial comes again",
        "a stimulus is felt for 1 s at least", "a stimulus is felt for 2 s at most"}) {
    EXPECT_NE(std::ranges::find(open, words), open.end()) << words;
  }
  const std::vector<std::string>& stairs = outline.stages.at(1).details;
  EXPECT_NE(std::ranges::find(stairs, "a trial allows 0 returns to a stimulus"), stairs.end());
}

}  // namespace study_outline_test
}  // namespace jnd::app
