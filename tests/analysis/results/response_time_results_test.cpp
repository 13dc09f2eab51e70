#include <gtest/gtest.h>

#include <cmath>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "analysis/results/study_sections.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace response_time_results_test {

void answer(HandMadeStudy& study, double intensity, std::optional<double> time_s) {
  (void)study.answer({.block = "estimation",
                      .procedure = "magnitude_estimation",
                      .quantity = "scale",
                      .repetition = 1,
                      .intensity = intensity,
                      .response = 100.0 * intensity,
                      .measures = {.response_time_s = time_s}});
}

TEST(ResponseTimeResults, AreTheGeometricMeanOfPeoplesMedians) {
  HandMadeStudy study;
  study.add("P01");
  for (const double time_s : {1.0, 2.0, 90.0}) answer(study, time_s, time_s);
  study.add("P02");
  for (const double time_s : {7.0, 8.0, 9.0}) answer(study, time_s, time_s);
  answer(study, 1.0, std::nullopt);
  const auto section = response_time_results(load_study(study.store()));
  ASSERT_TRUE(section);
  ASSERT_EQ(section->estimates.size(), 1U);
  const Estimate& one = section->estimates[0];
  EXPECT_EQ(one.name, "estimation.response_time_s");
  EXPECT_NEAR(one.value.value(), 4.0, 1e-12) << "of 2 s and 8 s";
  EXPECT_EQ(one.n, 2);
  const Summary logs = summary_of({std::log(2.0), std::log(8.0)});
  EXPECT_NEAR(one.ci95.low.value(), std::exp(*logs.mean_ci95.low), 1e-9);
  ASSERT_EQ(section->participants.size(), 2U);
  EXPECT_EQ(section->participants[1].value, 8.0);
}

TEST(ResponseTimeResults, AreNoSectionWithoutTimes) {
  HandMadeStudy study;
  study.add("P01");
  answer(study, 1.0, std::nullopt);
  EXPECT_FALSE(response_time_results(load_study(study.store())));
}

}  // namespace response_time_results_test
}  // namespace jnd::analysis
