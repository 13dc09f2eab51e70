#include "analysis/report/recording_conditions.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace recording_conditions_test {

std::string title_of(const std::string& medium, double intensity) {
  const StudyData data;
  const StudyResults results;
  const StudyTitles titles;
  ConditionMovement condition;
  condition.medium = medium;
  condition.intensity = intensity;
  return shown_condition({.data = data, .results = results, .titles = titles}, condition).title;
}

TEST(RecordingConditions, EveryMediumThatWasExploredHasItsUnit) {
  EXPECT_EQ(title_of("viscous", 10.0), "viscous, 10 Pa s");
  EXPECT_EQ(title_of("viscous_stokes", 10.0), "viscous stokes, 10 Pa s");
  EXPECT_EQ(title_of("viscous_schiller_naumann", 10.0), "viscous schiller naumann, 10 Pa s");
  EXPECT_EQ(title_of("viscous_ellipsoid", 10.0), "viscous ellipsoid, 10 Pa s");
  EXPECT_EQ(title_of("solid", 900.0), "solid, 900 N/m");
  EXPECT_EQ(title_of("water", 2.0), "water, scale 2");
  EXPECT_EQ(title_of("water_map", 2.0), "water map, scale 2");
  EXPECT_EQ(title_of("free_space", 0.0), "free space");
}

}  // namespace recording_conditions_test
}  // namespace jnd::analysis
