#include "app/curves/curve_request.h"

#include <gtest/gtest.h>

#include "analysis/export/study_tables.h"
#include "app/command_line/command.h"
#include "app/curves/curve_analysis.h"
#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace curve_request_test {

TEST(CurveRequest, TheCommandLeavesOutWhatIsADefault) {
  CurveRequest request;
  request.csv = "order.csv";
  request.yes = "k";
  EXPECT_EQ(command_of(request), "jnd fit psychometric --csv order.csv --yes k");
  request.intensity = "soa";
  request.trials = "n";
  request.group_by = {"condition", "block"};
  request.family = "logistic";
  request.axis = "log";
  request.task = "mafc:2";
  request.lapse = "free";
  request.at = {0.5, 0.75};
  request.compare = true;
  EXPECT_EQ(command_of(request),
            "jnd fit psychometric --csv order.csv --intensity soa --yes k --trials n "
            "--group-by condition,block --family logistic --axis log --task mafc:2 --lapse "
            "free --at 0.5,0.75 --compare");
}

TEST(CurveRequest, TheCommandHasQuotesWhereAShellNeedsThem) {
  CurveRequest request;
  request.csv = "/my data/it's.csv";
  request.yes = "said yes";
  request.where = {"block=2", "who=A & B"};
  EXPECT_EQ(command_of(request),
            "jnd fit psychometric --csv '/my data/it'\\''s.csv' --yes 'said yes' --where "
            "block=2 --where 'who=A & B'");
}

TEST(CurveRequest, WhatDoesNotGoTogetherIsRefused) {
  CurveRequest request;
  request.at = {1.0};
  EXPECT_THROW(require_request(request), UsageError);
  request = {};
  request.compare = true;
  EXPECT_THROW(require_request(request), UsageError);
  request = {};
  request.task = "mafc:1";
  EXPECT_THROW((void)options_of(request), UsageError);
  request.task = "mafc:2";
  EXPECT_DOUBLE_EQ(options_of(request).model.guess_rate, 0.5);
  request.lapse = "0.5";
  EXPECT_THROW((void)options_of(request), UsageError);
}

TEST(CurveRequest, AProportionAsAnsweredIsALevelOfACurveWhoseRatesAreKnown) {
  CurveRequest request;
  request.task = "mafc:2";
  request.at = {0.5};
  request.at_proportion = {0.75, 0.875};
  // 0.75 is half way from 0.5 to 1, which `at` asks for already, and 0.875 is three quarters of
  // the way.
  analysis::CurveOptions options = options_of(request);
  ASSERT_EQ(options.at.size(), 2U);
  EXPECT_DOUBLE_EQ(options.at[1], 0.75);
  EXPECT_TRUE(options.at_proportion.empty());
  request.at = {};
  request.lapse = "0.1";
  options = options_of(request);  // 0.75 is 0.25 of the 0.4 from 0.5 to 0.9.
  EXPECT_NEAR(options.at.at(0), 0.625, 1e-15);
  request.task = "yes-no";
  request.symmetric = true;
  options = options_of(request);  // 0.75 is 0.65 of the 0.8 from 0.1 to 0.9.
  EXPECT_NEAR(options.at.at(0), 0.8125, 1e-15);
  request.symmetric = false;
  request.lapse = "free";
  options = options_of(request);
  EXPECT_TRUE(options.at.empty());
  EXPECT_EQ(options.at_proportion, (std::vector<double>{0.75, 0.875}));
}

TEST(CurveRequest, AProportionBeyondTheEndsOfTheCurveIsRefusedWithThem) {
  const auto problem_of = [](const CurveRequest& request) -> std::string {
    try {
      require_request(request);
      (void)options_of(request);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  CurveRequest request;
  request.task = "mafc:2";
  request.lapse = "0.02";
  request.at_proportion = {0.4};
  EXPECT_EQ(problem_of(request),
            "--at-proportion: expected proportions as answered between 0.5, the lower end of "
            "the curve, and 0.98, its upper end, found 0.4; --at takes levels from 0 to 1 "
            "between these ends");
  request.at_proportion = {0.99};
  EXPECT_NE(problem_of(request), "");
  request.at_proportion = {0.5};
  EXPECT_NE(problem_of(request), "");
  request.at_proportion = {0.97};
  EXPECT_EQ(problem_of(request), "");
  request.at_proportion = {75.0};
  EXPECT_EQ(problem_of(request),
            "--at-proportion: expected numbers between 0 and 1, such as 0.75, found 75");
  request.at_proportion = {0.75};
  request.lapse = "free";
  request.compare = true;
  request.group_by = {"who"};
  EXPECT_NE(problem_of(request).find("expected known rates beside --compare"),
            std::string::npos);
}

TEST(CurveRequest, TheCommandSaysLevelsBesideProportions) {
  CurveRequest request;
  request.csv = "a.csv";
  request.at_proportion = {0.75};
  EXPECT_EQ(command_of(request),
            "jnd fit psychometric --csv a.csv --at 0.5 --at-proportion 0.75");
  request.at = {};
  EXPECT_EQ(command_of(request), "jnd fit psychometric --csv a.csv --at-proportion 0.75");
}

TEST(CurveRequest, ATableIsWrittenIntoNoFileThatIsThere) {
  const test_support::TemporaryFolder folder;
  test_support::write_file(folder.path() / "a.csv",
                           "intensity,num_yes,num_trials\n0,10,40\n10,30,40\n");
  CurveRequest request;
  request.csv = (folder.path() / "a.csv").string();
  CurveAnalysis curves = read_curves(request);
  fit_curves(curves);
  EXPECT_THROW(save_table(curves, request.csv), core::Error);
  EXPECT_EQ(test_support::read_file(request.csv),
            "intensity,num_yes,num_trials\n0,10,40\n10,30,40\n");
  save_table(curves, folder.path() / "fits.csv");
  EXPECT_TRUE(test_support::read_file(folder.path() / "fits.csv")
                  .starts_with("status,reason,num_trials,location,"));
}

TEST(CurveAnalysis, TrialsOfTheProgramAreKnownByTheColumnsThatItExports) {
  std::vector<std::string> columns;
  for (const analysis::CsvColumn& column : analysis::trial_columns()) {
    columns.emplace_back(column.name);
  }
  for (const char* yes : {"is_test_chosen", "is_felt", "is_called_different"}) {
    EXPECT_EQ(exported_answers(columns, yes), ExportedAnswers::kYesNo) << yes;
    EXPECT_EQ(exported_answers({"intensity", yes}, yes), ExportedAnswers::kNone) << yes;
  }
  EXPECT_EQ(exported_answers(columns, "is_right"), ExportedAnswers::kRight);
  EXPECT_EQ(exported_answers(columns, "response"), ExportedAnswers::kVaried);
  EXPECT_EQ(exported_answers(columns, "is_catch"), ExportedAnswers::kNone);
}

}  // namespace curve_request_test
}  // namespace jnd::app
