#include <gtest/gtest.h>

#include "analysis/felt_study.h"
#include "app/operator/results_model.h"

namespace jnd::app {
namespace results_table_test {

using namespace results;

/// P01 felt 2, 5 and 8 of 10 at 0.1, 0.2 and 0.4 Pa s; P02 is degenerate.
class ResultsTableTest : public ::testing::Test {
 protected:
  ResultsTableTest() : study_(analysis::kFeltProtocol) {
    analysis::add_felt_answers(study_);
    data_ = analysis::load_study(study_.store());
    data_.runs.clear();  // By hand instead.
    data_.runs.push_back({.participant = "P01",
                          .block = "felt",
                          .procedure = "staircase",
                          .is_logarithmic = true,
                          .rule = "1 up, 2 down; Levitt 1971",
                          .target_probability = 0.70711,
                          .tracks = {{.series = 1,
                                      .points = {{1, 0.4, true}, {2, 0.2, false, true, true}},
                                      .threshold = 0.25,
                                      .num_reversals = 2}},
                          .threshold = 0.25});
    results_ = analysis::results_of(data_, {}, {.num_resamples = 50});
  }
  [[nodiscard]] ResultsSource source() const { return {data_, results_, {{"felt", "Felt"}}}; }

  analysis::HandMadeStudy study_;
  analysis::StudyData data_;
  analysis::StudyResults results_;
};

TEST_F(ResultsTableTest, TheTableHasAColumnOfThresholds) {
  ResultsModel model;
  add_table(source(), model);
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
  EXPECT_NEAR(figures[0].boxes[1].median, 16.0, 1e-9);
  ResultsModel model;
  add_table(source, model);
  EXPECT_EQ(model.columns.front().title, "ratio Match it");
  EXPECT_NEAR(model.rows[1].values[0].value(), 1.5, 1e-9);
}

}  // namespace results_table_test
}  // namespace jnd::app
