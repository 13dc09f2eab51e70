#include <gtest/gtest.h>

#include "analysis/charts/charts.h"
#include "analysis/hand_made_study.h"
#include "analysis/report/chart_figures.h"

namespace jnd::analysis {
namespace matching_figures_test {

constexpr char kViscous[] = R"({"name": "by_hand", "stages": [{"kind": "block",
  "name": "match", "procedure": "matching", "standard_medium": "viscous", "standard_viscosity_pa_s": [2, 8]}]})";
constexpr char kWater[] = R"({"name": "by_hand", "stages": [{"kind": "block",
  "name": "match", "procedure": "matching", "standard_medium": "water", "standard_scale": [2, 8]}]})";

std::vector<Figure> figures_of(const HandMadeStudy& study) {
  const StudyData data = load_study(study.store());
  const StudyResults results = results_of(data, {}, {.num_resamples = 50});
  const StudyTitles titles;
  return chart_figures(matching_charts({.data = data, .results = results, .titles = titles}));
}

/// Adds two people who match. The geometric means are 2 and 8 for the first, and 8 and 32 for
/// the second.
void add_two_people(HandMadeStudy& study) {
  study.add("P01");
  for (const double factor : {0.5, 2.0}) {
    study.match(2.0, 1.0, 2.0 * factor);
    study.match(8.0, 1.0, 8.0 * factor);
  }
  study.add("P02");
  study.match(2.0, 1.0, 8.0);
  study.match(8.0, 1.0, 32.0);
}

TEST(MatchingFigures, ShowEverybodysGeometricMeansThoseOfTheGroupAndTheFunction) {
  HandMadeStudy study(kViscous);
  add_two_people(study);
  const std::vector<Figure> figures = figures_of(study);
  ASSERT_EQ(figures.size(), 1U);
  const Figure& figure = figures.front();
  EXPECT_EQ(figure.name, "match_matches");
  EXPECT_EQ(figure.section, "match");
  ASSERT_EQ(figure.tables.size(), 3U);
  const auto& own = figure.tables[0].rows;
  ASSERT_EQ(own.size(), 4U);
  EXPECT_EQ(own[0][1].text, "P01");
  EXPECT_NEAR(own[0][3].number.value(), 2.0, 1e-12);
  EXPECT_NEAR(own[1][3].number.value(), 8.0, 1e-12);
  EXPECT_NEAR(own[3][3].number.value(), 32.0, 1e-12);
  const auto& group = figure.tables[1].rows;
  ASSERT_EQ(group.size(), 2U);
  EXPECT_NEAR(group[0][1].number.value(), 4.0, 1e-12);
  EXPECT_LT(group[0][2].number.value(), 4.0);
  EXPECT_GT(group[0][3].number.value(), 4.0);
  // k = 2 and a = 1, so the line goes from 4 at the first standard to 16 at the last.
  const auto& function = figure.tables[2].rows;
  EXPECT_NEAR(function.front()[1].number.value(), 4.0, 1e-9);
  EXPECT_NEAR(function.back()[0].number.value(), 8.0, 1e-9);
  EXPECT_NEAR(function.back()[1].number.value(), 16.0, 1e-9);
  EXPECT_NE(figure.plot.find("set logscale x\n"), std::string::npos);
  EXPECT_NE(figure.plot.find("set logscale y\n"), std::string::npos);
  EXPECT_NE(figure.caption.find("2 participants"), std::string::npos);
}

TEST(MatchingFigures, HaveAnIdentityWhereBothAreOfOneQuantity) {
  for (const bool alike : {true, false}) {
    HandMadeStudy study(alike ? kViscous : kWater);
    add_two_people(study);
    const Figure figure = figures_of(study).at(0);
    EXPECT_EQ(figure.plot.find("'identity'") != std::string::npos, alike);
    EXPECT_EQ(figure.caption.find("identity") != std::string::npos, alike);
  }
}

TEST(MatchingFigures, OfOneStandardHaveNoFunctionAndOfNoMatchesThereIsNone) {
  HandMadeStudy study(kViscous);
  study.add("P01");
  study.match(2.0, 1.0, 3.0);
  const Figure figure = figures_of(study).at(0);
  EXPECT_EQ(figure.tables.size(), 2U);
  EXPECT_NE(figure.caption.find("no matching function"), std::string::npos);

  HandMadeStudy without(kViscous);
  without.add("P01");
  without.match(2.0, 1.0, 0.0);
  EXPECT_TRUE(figures_of(without).empty());
}

}  // namespace matching_figures_test
}  // namespace jnd::analysis
