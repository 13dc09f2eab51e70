#include "analysis/report/estimate_title.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace estimate_title_test {

TEST(EstimateTitle, IsInWordsWithTheTitleOfTheBlockAndWithoutTheUnit) {
  StudyTitles titles;
  titles.stages["group_d"] = "Group D: low viscosities";
  const auto title = [&](const char* name, const char* unit = "") {
    return estimate_title(titles, name, unit);
  };
  EXPECT_EQ(title("group_d.weber_fraction_median_person"),
            "Group D: Weber fraction, median person");
  EXPECT_EQ(title("max_speed_m_per_s.group_d", "m/s"), "Group D: max speed");
  EXPECT_EQ(title("group_d.pse_viscosity_pa_s", "Pa s"), "Group D: PSE viscosity");
  EXPECT_EQ(title("stroke_width_m", "m"), "Stroke width");
  EXPECT_EQ(title("group_d.response_time_s", "s"), "Group D: response time");
  EXPECT_EQ(title("weber_fraction_free_pse"), "Weber fraction, PSE free");
  EXPECT_EQ(title("median_person"), "Median person") << "no comma before the first word";
  EXPECT_EQ(title("group_d"), "Group D");
}

TEST(EstimateTitle, NamesBothBlocksOfADifference) {
  StudyTitles titles;
  titles.stages["group_d"] = "Group D: low viscosities";
  titles.stages["group_e"] = "Group E: high viscosities";
  EXPECT_EQ(estimate_title(titles, "max_speed_m_per_s.group_d_minus_group_e", "m/s"),
            "Max speed, Group D minus Group E");
  EXPECT_EQ(estimate_title(titles, "one_minus_other", ""), "One minus other");
  EXPECT_EQ(titles.titled("group_d - group_e: w, pse free"), "Group D - Group E: w, pse free");
  EXPECT_EQ(titles.titled("order: first - group_e: w"), "order: first - group_e: w");
  EXPECT_EQ(titles.titled("group_d"), "Group D");
  EXPECT_EQ(titles.titled("a - b"), "a - b");
  EXPECT_EQ(titles.titled(""), "");
}

}  // namespace estimate_title_test
}  // namespace jnd::analysis
