#include "app/operator/curve_choices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "app/environment.h"

namespace jnd::app {
namespace curve_choices_test {

TEST(CurveChoices, EveryFamilyOfTheCommandCanBeChosen) {
  CurveRequest request;
  for (const CurveChoice& choice : family_choices(request)) {
    EXPECT_EQ(choice.is_chosen(request), choice.label == "normal") << choice.label;
    EXPECT_NO_THROW((void)options_of(choice.choose(request))) << choice.label;
    EXPECT_TRUE(choice.is_chosen(choice.choose(request)));
  }
  EXPECT_EQ(family_choices(request).size(), analysis::curve_families().size());
}

TEST(CurveChoices, ATaskTakesThePlaceOfAGuessRateAndTheOtherWayRound) {
  CurveRequest request = with_typed_guess({}, " 1/4 ").request;
  EXPECT_EQ(request.guess, "0.25");
  request = with_task(request, "mafc:3");
  EXPECT_EQ(request.guess, "");
  EXPECT_NO_THROW((void)options_of(request));
  EXPECT_EQ(with_typed_guess(request, "0.1").request.task, "");
  const auto tasks = task_choices();
  EXPECT_EQ(std::ranges::count_if(
                tasks, [](const CurveChoice& task) { return task.is_chosen(CurveRequest()); }),
            1);
}

TEST(CurveChoices, WhatIsNoRateAndNoLevelIsToldInASentence) {
  for (const char* wrong : {"1", "-0.1", "much", "", "1/0"}) {
    EXPECT_NE(with_typed_lapse({}, wrong).problem.find("expected a rate"), std::string::npos)
        << wrong;
  }
  EXPECT_EQ(with_typed_lapse({}, "0.02").request.lapse, "0.02");
  for (const char* wrong : {"0.5, 1", "half", "", " , "}) {
    EXPECT_NE(with_typed_levels({}, wrong).problem.find("expected numbers between 0 and 1"),
              std::string::npos)
        << wrong;
  }
  EXPECT_EQ(with_typed_levels({}, "0.25;0.5, 0.75 0.5").request.at,
            (std::vector{0.25, 0.5, 0.75}));
}

TEST(CurveChoices, WhereHalfIsWrittenWithACommaItIsUnderstood) {
  const EnvironmentVariable all("LC_ALL", "de_DE.UTF-8");
  EXPECT_EQ(with_typed_guess({}, "0,25").request.guess, "0.25");
  EXPECT_EQ(with_typed_lapse({}, "0,02").request.lapse, "0.02");
  EXPECT_EQ(with_typed_lapse({}, "0.02").request.lapse, "0.02");
  EXPECT_EQ(with_typed_lapse({}, "1/50").request.lapse, "0.02");
  const std::vector<double> levels = {0.25, 0.5, 0.75};
  for (const char* typed : {"0,25; 0,5; 0,75", "0,25, 0,5, 0,75", "0,25 0,5 0,75",
                            "0.25, 0.5, 0.75", "0.25,0.5,0.75"}) {
    EXPECT_EQ(with_typed_levels({}, typed).request.at, levels) << typed;
  }
}

}  // namespace curve_choices_test
}  // namespace jnd::app
