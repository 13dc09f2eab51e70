#include <gtest/gtest.h>

#include "analysis/felt_study.h"
#include "app/operator/results_model.h"

namespace jnd::app {
namespace results_table_test {

using namespace results;

TEST(ResultsTable, HasAColumnOfThresholds) {
  analysis::HandMadeStudy study(analysis::kFeltProtocol);
  analysis::add_felt_answers(study);  // P01 has a threshold of 0.2 Pa s, and P02 is degenerate.
  const analysis::StudyData data = analysis::load_study(study.store());
  const analysis::StudyResults results = analysis::results_of(data, {}, {.num_resamples = 50});
  const ResultsSource source{data, results, {{"felt", "Felt"}}};
  ResultsModel model;
  add_table(source, model);
  EXPECT_EQ(model.columns.front().title, "Felt");
  EXPECT_EQ(model.columns.front().unit, "Pa s");
  EXPECT_NEAR(model.rows[0].values[0].value(), 0.2, 1e-9);
  EXPECT_FALSE(model.rows[1].values[0].has_value());
}

TEST(ResultsBoxes, OfMatchesStandByTheirStandardsFromTheLeast) {
  analysis::HandMadeStudy study(R"({"name": "by_hand", "stages": [{"kind": "block",
    "name": "match", "procedure": "matching", "standard_medium": "viscous", "standard_viscosity_pa_s": [16, 2]}]})");
  for (const char* person : {"P01", "P02", "P03"}) {
    study.add(person);
    for (const double standard : {16.0, 2.0}) {
      study.match(standard, 1.0, standard * (std::string(person) == "P02" ? 1.5 : 1.0));
    }
  }
  const analysis::StudyData data = analysis::load_study(study.store());
  const analysis::StudyResults results = analysis::results_of(data, {}, {.num_resamples = 50});
  const ResultsSource source{data, results, {{"match", "Match it"}}};
  const std::vector<BoxFigure> figures = boxes_of(source);
  ASSERT_FALSE(figures.empty());
  EXPECT_EQ(figures[0].name, "match");
  EXPECT_EQ(figures[0].unit, "Pa s");
  ASSERT_EQ(figures[0].boxes.size(), 2U);
  EXPECT_EQ(figures[0].boxes[0].label, "to 2");
  EXPECT_EQ(figures[0].boxes[1].label, "to 16");
  EXPECT_NEAR(figures[0].boxes[1].plot.median, 16.0, 1e-9);
  ResultsModel model;
  add_table(source, model);
  EXPECT_EQ(model.columns.front().title, "ratio Match it");
  EXPECT_NEAR(model.rows[1].values[0].value(), 1.5, 1e-9);
}

}  // namespace results_table_test
}  // namespace jnd::app
