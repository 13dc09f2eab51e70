#include "app/operator/open_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/curves/fit_words.h"
#include "app/operator/curve_choices.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace open_data_test {

/// Each group has two proportions, and the curve has two parameters, so it goes through both
/// points. A quarter at 0 and three quarters at 10 give a location of 5 and a scale of 5 /
/// 0.67449.
constexpr char kQuarters[] =
    "condition,x,k,n\nlow,0,10,40\nlow,10,30,40\nhigh,20,10,40\nhigh,30,30,40\n";

class OpenDataTest : public ::testing::Test {
 protected:
  const DataView& open(const std::string& text, const char* name = "a.csv") {
    test_support::write_file(path(name), text);
    data_.open(path(name));
    data_.wait();
    return data_.view();
  }
  const DataView& ask(const CurveRequest& request) {
    data_.ask(request);
    data_.wait();
    return data_.view();
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }

  test_support::TemporaryFolder folder_;
  OpenData data_;
};

TEST_F(OpenDataTest, AFileIsReadGuessedAndFittedAtOnce) {
  const DataView& view = open(kQuarters);
  EXPECT_EQ(view.problem + view.fit_problem, "");
  ASSERT_TRUE(view.preview.has_value());
  ASSERT_NE(view.results, nullptr);
  ASSERT_EQ(view.results->groups.size(), 2U);
  const DataGroup& low = view.results->groups[0];
  EXPECT_EQ(low.name, "condition low");
  EXPECT_EQ(low.num_trials, 80);
  EXPECT_EQ(low.location.value, "5");
  EXPECT_EQ(low.pse.value, "5");
  EXPECT_EQ(low.scale.value, number(5.0 / 0.6744897501960817));
  EXPECT_EQ(low.jnd.value, number(5.0 / 0.6744897501960817));
  EXPECT_EQ(view.results->groups[1].pse.value, "25");
  EXPECT_NE(low.pse.interval.find(" to "), std::string::npos);
  EXPECT_TRUE(view.results->formula.starts_with("rising curve "));
}

TEST_F(OpenDataTest, TwoGroupsAreComparedWithoutBeingAsked) {
  const DataView& view = open(kQuarters);
  ASSERT_NE(view.comparison, nullptr) << view.compare_problem;
  ASSERT_EQ(view.comparison->contrasts.size(), 1U);
  const DataContrast& contrast = view.comparison->contrasts[0];
  EXPECT_EQ(contrast.difference.value, "20");
  EXPECT_EQ(contrast.ratio.value, "5");
  EXPECT_TRUE(contrast.differs);
  ASSERT_EQ(view.comparison->verdicts.size(), 3U);
  const auto& verdicts = view.comparison->verdicts;
  EXPECT_TRUE(verdicts[0].sentence.starts_with("The scale is not seen to differ"));
  EXPECT_TRUE(verdicts[1].sentence.starts_with("The location differs: chi-squared "));
  EXPECT_TRUE(verdicts[2].sentence.starts_with("The curves differ: "));
  EXPECT_TRUE(view.command.ends_with(" --group-by condition --compare")) << view.command;
}

TEST_F(OpenDataTest, ManyGroupsAreComparedWhenAsked) {
  std::string text = "condition,x,k,n\n";
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h", "i"}) {
    text += std::string(name) + ",0,10,40\n" + name + ",10,30,40\n";
  }
  EXPECT_EQ(open(text).comparison, nullptr);
  EXPECT_TRUE(data_.view().can_compare);
  data_.compare();
  data_.wait();
  ASSERT_NE(data_.view().comparison, nullptr) << data_.view().compare_problem;
  EXPECT_EQ(data_.view().comparison->contrasts.size(), 36U);
}

TEST_F(OpenDataTest, AFileThatIsNoTableSaysWhyInTheReadersWords) {
  const DataView& view = open("x,k\n1,2,3\n");
  EXPECT_NE(view.problem.find("a.csv:2: expected 2 cells, found 3"), std::string::npos)
      << view.problem;
  EXPECT_FALSE(view.preview.has_value());
  data_.open(path("gone.csv"));
  data_.wait();
  EXPECT_NE(view.problem.find("found no such file"), std::string::npos) << view.problem;
  // The next file opens as if there had been no error before.
  EXPECT_EQ(open(kQuarters).problem, "");
}

TEST_F(OpenDataTest, CellsThatAreNoAnswersAreToldInTheReadersWords) {
  CurveRequest request = open("x,k,who\n0,1,A\n1,0,A\n2,1,A\n").request;
  request.yes = "who";
  const DataView& view = ask(request);
  EXPECT_EQ(view.results, nullptr);
  EXPECT_NE(view.fit_problem.find("a.csv:2: who: expected 0 or 1"), std::string::npos)
      << view.fit_problem;
  request.yes = "";
  EXPECT_EQ(ask(request).fit_problem, "");
  EXPECT_EQ(view.command, "");
}

TEST_F(OpenDataTest, RowsOfOneCellAloneAreFitted) {
  CurveRequest request = open(kQuarters).request;
  request.where = {"condition=high"};
  request.group_by.clear();
  const DataView& view = ask(request);
  ASSERT_EQ(view.results->groups.size(), 1U);
  EXPECT_EQ(view.results->groups[0].name, "all rows");
  EXPECT_EQ(view.results->groups[0].pse.value, "25");
  ASSERT_EQ(view.results->notes.size(), 1U);
  EXPECT_TRUE(view.results->notes[0].starts_with("2 of 4 rows are left out"));
  EXPECT_FALSE(view.can_compare);
  EXPECT_TRUE(view.command.find("--compare") == std::string::npos) << view.command;
}

TEST_F(OpenDataTest, WhatLooksLikeRightAnswersIsAskedBeforeItIsFitted) {
  CurveRequest request =
      open("intensity,num_yes,num_trials\n1,52,100\n2,58,100\n3,75,100\n4,92,100\n5,99,100\n")
          .request;
  ASSERT_NE(data_.view().results, nullptr);
  EXPECT_EQ(data_.view().results->suspected_alternatives, 2);
  EXPECT_TRUE(data_.view().results->groups.empty());
  request.task = "mafc:2";
  const DataView& view = ask(request);
  EXPECT_FALSE(view.results->suspected_alternatives.has_value());
  EXPECT_EQ(view.results->chance, 0.5);
  EXPECT_EQ(view.results->groups.size(), 1U);
}

TEST_F(OpenDataTest, TheIntervalsThatAreChosenAreShownAndSaidInTheCommand) {
  CurveRequest request = open("x,k,n\n0,4,40\n5,13,40\n10,26,40\n15,37,40\n").request;
  const std::string plain = data_.view().results->groups[0].pse.interval;
  const std::string value = data_.view().results->groups[0].pse.value;
  EXPECT_EQ(data_.view().results->title, "Fits, with 95 % by the likelihood ratio");
  const auto choose = [&](std::size_t place) {
    return ask(interval_choices().at(place).choose(request));
  };
  const auto remark_of = [](const DataView& view, const std::string& name) {
    const auto& numbers = view.results->groups[0].numbers;
    const auto found = std::ranges::find(numbers, name, &DataNumber::name);
    return found == numbers.end() ? "none" : found->remark;
  };
  DataView view = choose(1);
  EXPECT_EQ(view.results->title, "Fits, with 95 % by the bootstrap");
  EXPECT_TRUE(view.command.ends_with("--bootstrap 1000")) << view.command;
  EXPECT_EQ(view.results->groups[0].pse.value, value);
  EXPECT_NE(view.results->groups[0].pse.interval, plain);
  EXPECT_TRUE(remark_of(view, "location").starts_with("corrected (BCa) "));
  EXPECT_EQ(remark_of(view, "refits without optimum"), "of 1000 refits");
  view = choose(2);
  EXPECT_TRUE(view.command.ends_with("--bootstrap 1000 --bootstrap-kind nonparametric"));
  view = choose(3);
  EXPECT_EQ(view.results->title, "Fits, with 95 % of the posterior");
  EXPECT_TRUE(view.command.ends_with("--posterior")) << view.command;
  EXPECT_NE(view.results->groups[0].pse.interval, plain);
  EXPECT_TRUE(remark_of(view, "location").starts_with("median of the posterior "));
  EXPECT_TRUE(std::ranges::any_of(view.results->groups[0].cautions, [](const auto& words) {
    return words.starts_with("Priors of the posterior: ");
  }));
  view = choose(0);
  EXPECT_EQ(view.results->groups[0].pse.interval, plain);
}

TEST_F(OpenDataTest, TheGoodnessOfFitIsTestedByRedraws) {
  CurveRequest request = open("x,k,n\n0,4,40\n5,13,40\n10,26,40\n15,37,40\n").request;
  const auto p_of = [](const DataView& view) -> std::string {
    for (const DataNumber& number : view.results->groups[0].numbers) {
      if (number.name == "goodness of fit, p") return number.number.value + number.remark;
    }
    return "none";
  };
  EXPECT_EQ(p_of(data_.view()), "none");
  const DataView& view = ask(goodness_choices().at(1).choose(request));
  EXPECT_TRUE(view.command.ends_with("--goodness 1000")) << view.command;
  EXPECT_TRUE(p_of(view).ends_with("by 1000 redraws")) << p_of(view);
  // With two levels and two parameters, nothing is left to test, and the window says so.
  request = open(kQuarters).request;
  EXPECT_EQ(p_of(ask(goodness_choices().at(1).choose(request))), "none");
  EXPECT_TRUE(view.results->groups[0].cautions.back().starts_with(
      "The goodness of fit is not tested: "));
}

TEST_F(OpenDataTest, WhatIsShownIsOfTheLastRequest) {
  CurveRequest request = open(kQuarters).request;
  for (const char* family : {"logistic", "gumbel", "normal", "hyperbolic_secant"}) {
    request.family = family;
    data_.ask(request);
    EXPECT_EQ(data_.view().results, nullptr);
  }
  // Until the last result arrives, the view shows no result of the earlier requests.
  while (data_.view().results == nullptr && data_.works()) data_.collect();
  ASSERT_NE(data_.view().results, nullptr);
  EXPECT_NE(data_.view().results->formula.find("arctan"), std::string::npos);
}

TEST_F(OpenDataTest, WhatIsSavedIsNewAndTheFileStaysAsItIs) {
  (void)open(kQuarters);
  data_.save_table(path("fits.csv"));
  data_.wait();
  EXPECT_TRUE(data_.view().outcome.ok) << data_.view().outcome.sentence;
  const std::string table = test_support::read_file(path("fits.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_TRUE(table.starts_with("condition,status,"));
  for (const char* there : {"fits.csv", "a.csv"}) {
    data_.save_table(path(there));
    data_.wait();
    EXPECT_FALSE(data_.view().outcome.ok);
    EXPECT_NE(data_.view().outcome.sentence.find("there already"), std::string::npos);
  }
  EXPECT_EQ(test_support::read_file(path("a.csv")), kQuarters);
  EXPECT_EQ(free_file_beside(path("a.csv"), ".svg"), path("a-curves.svg"));
  test_support::write_file(path("a-curves.svg"), "");
  EXPECT_EQ(free_file_beside(path("a.csv"), ".svg"), path("a-curves-2.svg"));
}

TEST_F(OpenDataTest, AGroupWithoutACurveSaysWhyAndTheOthersHaveTheirs) {
  const DataView& view =
      open("condition,x,k,n\nlow,0,10,40\nlow,10,30,40\nnever,0,0,40\nnever,10,0,40\n");
  ASSERT_NE(view.results, nullptr) << view.fit_problem;
  ASSERT_EQ(view.results->groups.size(), 2U);
  EXPECT_EQ(view.results->groups[0].reason, "");
  EXPECT_NE(view.results->groups[1].reason, "");
  EXPECT_TRUE(view.results->groups[1].numbers.empty());
  ASSERT_NE(view.comparison, nullptr);
  EXPECT_NE(view.comparison->reason, "");
}

}  // namespace open_data_test
}  // namespace jnd::app
