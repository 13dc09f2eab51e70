#include "app/commands/fit_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/fit_fixture.h"
#include "support/program.h"

namespace jnd::app {
namespace fit_figures_test {

using analysis::DrawnCurve;
using analysis::FitStatus;

const std::vector<analysis::AnswerCount> kRows = {
    {.intensity = 4.0, .num_yes = 9, .num_trials = 10},
    {.intensity = 1.0, .num_yes = 1, .num_trials = 10},
    {.intensity = 4.0, .num_yes = 8, .num_trials = 10}};

TEST(FitFigures, AddUpTheAnswersAtAnIntensity) {
  const auto points = points_of(kRows);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].intensity, 1.0);
  EXPECT_EQ(points[1].num_yes, 17.0);
  EXPECT_EQ(points[1].num_trials, 20.0);
}

// By hand: half way at the pse, and Phi(1) at pse (1 + w), between the ends that lapses leave.
TEST(FitFigures, DrawTheWeberCurveBetweenItsEnds) {
  analysis::PsychometricFit fit{.status = FitStatus::kOk, .weber_fraction = 0.5};
  fit.pse = 2.0;
  fit.lapse_rate = 0.1;
  const DrawnCurve both = drawn_curve("", kRows, fit);
  EXPECT_DOUBLE_EQ(both.probability(2.0), 0.5);
  EXPECT_NEAR(both.probability(3.0), 0.1 + 0.8 * 0.84134474606854293, 1e-12);
  EXPECT_DOUBLE_EQ(both.probability(0.0), 0.1);
  EXPECT_TRUE(both.thresholds.empty());  // The caller gave the pse, so no threshold is drawn.
  fit.guess_rate = 0.5;
  fit.symmetric_lapse = false;
  fit.pse_ci95 = analysis::Interval{1.5, 2.5};
  const DrawnCurve upper = drawn_curve("", kRows, fit);
  EXPECT_DOUBLE_EQ(upper.probability(2.0), 0.7);
  ASSERT_EQ(upper.thresholds.size(), 1U);
  EXPECT_DOUBLE_EQ(upper.thresholds[0].proportion, 0.7);
}

TEST(FitFigures, DrawDetectionFromFalseAlarmsUp) {
  analysis::DetectionFit fit{.status = FitStatus::kOk, .threshold = 2.0, .spread_ln = 0.5};
  fit.false_alarm_rate = 0.2;
  const DrawnCurve curve = drawn_curve("", kRows, fit);
  EXPECT_DOUBLE_EQ(curve.probability(0.0), 0.2);
  EXPECT_DOUBLE_EQ(curve.probability(2.0), 0.6);
  EXPECT_FALSE(drawn_curve("", kRows, analysis::DetectionFit{}).probability);
}

class FigureCommands : public FitFixture {
 protected:
  void SetUp() override {
    FitFixture::SetUp();
    if (test_support::installed_program("gnuplot").empty())
      GTEST_SKIP() << "gnuplot is not installed";
    table("answers.csv",
          "participant,condition,intensity,num_yes,num_trials\n"
          "A,x,1,1,20\nA,x,2,7,20\nA,x,4,14,20\nA,x,8,19,20\n"
          "B,x,1,2,20\nB,x,2,5,20\nB,x,4,12,20\nB,x,8,18,20\n"
          "C,x,1,1,20\nC,x,2,6,20\nC,x,4,15,20\nC,x,8,20,20\n");
    table("catch.csv",
          "intensity,num_yes,num_trials\n0,2,40\n1,5,20\n2,9,20\n4,15,20\n8,19,20\n");
    table("pairs.csv",
          "intensity,num_yes,num_trials\n2,4,40\n2.4,5,20\n3,11,20\n4,17,20\n8,20,20\n");
    table("magnitudes.csv",
          "who,intensity,magnitude\nA,1,1\nA,2,1.6\nA,4,2.4\nA,8,4.1\n"
          "B,1,2\nB,2,2.6\nB,4,4.4\nB,8,6.1\n");
    table("long.csv",
          "who,condition,value\nA,x,1\nA,y,2\nA,z,2.5\nB,x,2\nB,y,2.2\nB,z,3\n"
          "C,x,1.5\nC,y,3\nC,z,2.9\n");
    table("two.csv", "a,b\n1,2\n2,2.5\n3,5\n4,4.5\n");
  }
  /// Draws, and returns the size of what was written.
  std::uintmax_t drawn(std::vector<std::string> arguments, int exit_code = 0) {
    const std::string name = "figure" + std::to_string(++num_figures_) + ".svg";
    arguments.insert(arguments.end(), {"--figure", name});
    const test_support::ProgramOutcome outcome = jnd(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    std::error_code none;
    return std::filesystem::file_size(path(name), none);
  }
  int num_figures_ = 0;
};

TEST_F(FigureCommands, EveryFitAndComparisonDrawsOne) {
  const std::vector<std::vector<std::string>> commands = {
      {"fit", "weber", "--csv", "answers.csv", "--reference", "3", "--free", "pse",
       "--group-by", "participant"},
      {"fit", "weber", "--csv", "catch.csv", "--reference", "3", "--family", "gauss"},
      {"fit", "hierarchical", "--csv", "answers.csv", "--reference", "3"},
      {"fit", "glmm", "--csv", "answers.csv", "--fixed", "log(intensity)", "--random",
       "1 | participant", "--stimulus", "intensity"},
      {"fit", "detection", "--csv", "catch.csv"},
      {"fit", "same-different", "--csv", "pairs.csv", "--reference", "2"},
      {"fit", "power", "--csv", "magnitudes.csv", "--group-by", "who"},
      {"fit", "power", "--csv", "magnitudes.csv", "--shift", "none"},
      {"compare", "--csv", "two.csv", "--test", "paired"},
      {"compare", "--csv", "two.csv", "--test", "welch"},
      {"compare", "--csv", "two.csv", "--test", "pearson"},
      {"compare", "--csv", "two.csv", "--test", "kendall"},
      {"compare", "--csv", "long.csv", "--test", "wilcoxon", "--value", "value", "--by",
       "condition", "--pair", "who", "--levels", "x,y"},
      {"compare", "--csv", "long.csv", "--test", "anova", "--value", "value", "--by",
       "condition", "--pair", "who"},
  };
  for (const std::vector<std::string>& one : commands) {
    EXPECT_GT(drawn(one), 3000U) << one[0] << " " << one[1] << " " << one[3];
  }
}

TEST_F(FigureCommands, RefuseWhatCannotBeDrawnBeforeAnythingIsComputed) {
  for (const std::vector<std::string>& one : std::vector<std::vector<std::string>>{
           {"fit", "power", "--csv", "no_such.csv"},
           {"fit", "weber", "--csv", "no_such.csv", "--reference", "3"},
           {"compare", "--csv", "no_such.csv", "--test", "paired"}}) {
    std::vector<std::string> arguments = one;
    arguments.insert(arguments.end(), {"--figure", "a.doc"});
    const auto outcome = jnd(arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(".svg, .pdf or .png"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(jnd({"fit", "glmm", "--csv", "answers.csv", "--fixed", "intensity", "--random",
                 "1 | participant", "--figure", "a.svg"})
                .exit_code,
            2);
}

}  // namespace fit_figures_test
}  // namespace jnd::app
