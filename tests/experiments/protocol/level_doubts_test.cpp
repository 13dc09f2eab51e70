#include "experiments/protocol/level_doubts.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "experiments/protocol/broken_study.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"

namespace jnd::experiments {
namespace level_doubts_test {

constexpr char kViscosities[] = "[10.5, 20]";

std::vector<StudyProblem> doubts_of(const std::string& levels) {
  return study_text_doubts(broken(kViscosities, levels), "x.json");
}

TEST(LevelDoubts, ADecimalCommaIsAskedAboutAtItsPlace) {
  const std::vector<StudyProblem> doubts = doubts_of("[10,5, 20]");
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts[0].pointer, "/stages/2/arms/1/stages/0/viscosity_pa_s");
  EXPECT_EQ(doubts[0].line, 26);
  EXPECT_EQ(doubts[0].message,
            "expected levels in order, with a comma and a space between them, found "
            "[10,5, 20], which is 3 levels; if a comma was to be a decimal one, write a point: "
            "10.5; if the list is meant so, nothing is wrong");
  EXPECT_EQ(problems_of(broken(kViscosities, "[10,5, 20]")), "") << "it can be run";
}

TEST(LevelDoubts, CommasOfTwoKindsAreAskedAboutWhereTheLevelsHappenToBeInOrder) {
  EXPECT_EQ(doubts_of("[12,15, 20]").size(), 1U);
  EXPECT_EQ(doubts_of("[20, 16,5]").size(), 1U);
}

TEST(LevelDoubts, ShuffledLevelsAreAskedAboutAndStayAStudy) {
  EXPECT_EQ(doubts_of("[20, 10.5, 18]").size(), 1U);
  EXPECT_NO_THROW((void)read_study_text(broken(kViscosities, "[20, 10.5, 18]"), "x.json"));
}

TEST(LevelDoubts, LevelsInOrderAreNotAskedAbout) {
  for (const char* levels : {"[10.5, 20]", "[20, 10.5]", "[10.5,18,20]", "[10.5,\n 18,\n 20]",
                             "[10.5 , 18 , 20]", "[10, 18.0, 20]"}) {
    EXPECT_TRUE(doubts_of(levels).empty()) << levels;
  }
}

TEST(LevelDoubts, TargetsInTheOrderOfTheTrialsAreNoLevels) {
  EXPECT_TRUE(study_text_doubts(broken("[100, 50]", "[100, 50, 200]"), "x.json").empty());
}

TEST(LevelDoubts, AStudyWithProblemsIsToldOfThoseAlone) {
  EXPECT_TRUE(doubts_of("[10,5, \"20\"]").empty());
  EXPECT_TRUE(study_text_doubts("{", "x.json").empty());
}

TEST(LevelDoubts, ShippedStudiesGiveNone) {
  for (const auto& entry :
       std::filesystem::directory_iterator(test_support::source_folder() / "protocols")) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".json" || file.string().ends_with(".schema.json")) continue;
    EXPECT_TRUE(study_doubts(file).empty()) << file;
  }
}

}  // namespace level_doubts_test
}  // namespace jnd::experiments
