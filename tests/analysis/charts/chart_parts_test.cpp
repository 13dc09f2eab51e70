#include "analysis/charts/chart_parts.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace chart_parts_test {

TEST(ChartParts, ASpreadIsTheMiddleNinetyPercentWithTheMedian) {
  std::map<double, std::vector<double>> values;
  for (int i = 20; i >= 0; --i) values[2.0].push_back(i);
  values[3.0] = {4.0, 8.0};
  values[5.0] = {7.0};
  const FigureTable table = spread_table("spread", "intensity", values);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"intensity", "median", "low", "high"}));
  ASSERT_EQ(table.rows.size(), 2U) << "one person has no spread";
  // Of the values from 0 to 20, a twentieth lies below 1 and a twentieth above 19.
  EXPECT_EQ(table.rows[0][0].number, 2.0);
  EXPECT_DOUBLE_EQ(table.rows[0][1].number.value(), 10.0);
  EXPECT_DOUBLE_EQ(table.rows[0][2].number.value(), 1.0);
  EXPECT_DOUBLE_EQ(table.rows[0][3].number.value(), 19.0);
  EXPECT_DOUBLE_EQ(table.rows[1][1].number.value(), 6.0);
  EXPECT_DOUBLE_EQ(table.rows[1][2].number.value(), 4.2);
  EXPECT_DOUBLE_EQ(table.rows[1][3].number.value(), 7.8);
}

TEST(ChartParts, ValuesStandByTheirPlace) {
  const FigureTable table{.name = "t",
                          .columns = {"who", "x", "y"},
                          .rows = {{"P01", 1.0, 5.0}, {"P02", 1.0, 6.0}, {"P03", 2.0, {}}}};
  const auto values = values_by(table, "x", "y");
  ASSERT_EQ(values.size(), 1U) << "a row without a value is nobody's";
  EXPECT_EQ(values.at(1.0), (std::vector<double>{5.0, 6.0}));
}

}  // namespace chart_parts_test
}  // namespace jnd::analysis
