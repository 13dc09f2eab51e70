#include "app/operator/column_roles.h"

#include <gtest/gtest.h>

namespace jnd::app {
namespace column_roles_test {

DataPreview some_preview() {
  DataPreview preview;
  preview.columns = {{.name = "x", .cells = {"1", "2"}},
                     {.name = "key", .cells = {"left", "right"}, .is_yes_or_no = false},
                     {.name = "n", .cells = {"10"}}};
  return preview;
}

TEST(ColumnRoles, AColumnHasOneRole) {
  CurveRequest request;
  request.intensity = "x";
  request.group_by = {"key"};
  EXPECT_EQ(role_of(request, "x"), ColumnRole::kIntensity);
  EXPECT_EQ(role_of(request, "key"), ColumnRole::kGroup);
  EXPECT_EQ(role_of(request, ""), ColumnRole::kNone);
  request = with_role(request, some_preview(), "key", ColumnRole::kYes);
  EXPECT_EQ(request.yes, "key");
  EXPECT_TRUE(request.group_by.empty());
  request.trials = "n";
  request = with_role(request, some_preview(), "n", ColumnRole::kIntensity);
  EXPECT_EQ(request.intensity, "n");
  EXPECT_EQ(request.trials, "");
  request = with_role(request, some_preview(), "n", ColumnRole::kNone);
  EXPECT_EQ(request.intensity, "");
}

TEST(ColumnRoles, TheCellThatIsAYesIsGuessedWhereTheAnswersAreOthers) {
  CurveRequest request;
  request.yes = "x";
  request = with_role(request, some_preview(), "key", ColumnRole::kYes);
  EXPECT_EQ(request.yes_value, "right");
  // A column of counts has no value that means yes.
  request = with_role(request, some_preview(), "n", ColumnRole::kTrials);
  EXPECT_EQ(request.yes_value, "");
  // A value that somebody chose stays.
  request.yes_value = "left";
  request = with_role(request, some_preview(), "x", ColumnRole::kIntensity);
  EXPECT_EQ(request.yes_value, "left");
}

TEST(ColumnRoles, ACellOfAColumnTakesThePlaceOfAnother) {
  CurveRequest request = with_filter({}, {"block", "1"});
  request = with_filter(request, {"who", "A=B"});
  request = with_filter(request, {"block", "2"});
  EXPECT_EQ(request.where, (std::vector<std::string>{"who=A=B", "block=2"}));
  EXPECT_EQ(filter_of(request.where[0]).cell, "A=B");
  EXPECT_EQ(without_filter(request, "who").where, std::vector<std::string>{"block=2"});
}

}  // namespace column_roles_test
}  // namespace jnd::app
