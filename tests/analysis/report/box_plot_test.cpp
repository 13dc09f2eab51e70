#include "analysis/charts/box_plot.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace box_plot_test {

// R 4.2: quantile(c(1,2,3,4,5,6,7,8,40), c(.25,.5,.75)) is 3, 5, 7, and boxplot.stats gives the
// whiskers 1 and 8.
TEST(BoxPlot, WhiskersEndAtTheLastValueWithinReach) {
  const BoxPlot box = box_plot_of({40, 3, 2, 1, 5, 4, 8, 7, 6});
  EXPECT_DOUBLE_EQ(box.lower_quartile, 3.0);
  EXPECT_DOUBLE_EQ(box.median, 5.0);
  EXPECT_DOUBLE_EQ(box.upper_quartile, 7.0);
  EXPECT_DOUBLE_EQ(box.lower_whisker, 1.0);
  EXPECT_DOUBLE_EQ(box.upper_whisker, 8.0);
}

TEST(BoxPlot, OneValueIsABoxWithoutWidth) {
  const BoxPlot box = box_plot_of({2.5});
  EXPECT_DOUBLE_EQ(box.lower_whisker, 2.5);
  EXPECT_DOUBLE_EQ(box.upper_whisker, 2.5);
}

TEST(BoxPlot, TablesLeaveOutEmptyGroupsAndKeepEveryValue) {
  const std::vector<BoxGroup> groups = {
      {.label = "a", .position = 1.0, .values = {{"P01", 1.0}, {"P02", 3.0}}},
      {.label = "b", .position = 2.0}};
  EXPECT_EQ(box_table("t", groups).rows.size(), 1U);
  EXPECT_EQ(box_values_table("v", groups).rows.size(), 2U);
}

}  // namespace box_plot_test
}  // namespace jnd::analysis
