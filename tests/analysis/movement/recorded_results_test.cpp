#include "analysis/movement/recorded_results.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/found_results.h"
#include "analysis/movement/recorded_study.h"

namespace jnd::analysis {
namespace recorded_results_test {

ParticipantMovement person(const std::string& name, double body_height_m, double width_m,
                           double duration_s) {
  ParticipantMovement one{.participant = name, .body_height_m = body_height_m};
  for (const std::string block : {"d", "e"}) {
    const double seconds = block == "d" ? duration_s : duration_s + 1.0;
    one.conditions.push_back({.block = block,
                              .num_presentations = 4,
                              .num_marked = block == "d" ? 1 : 0,
                              .strokes = {.num_strokes = 3,
                                          .stroke_width_m = width_m,
                                          .max_speed_m_per_s = 2.0 * width_m,
                                          .stroke_duration_s = seconds}});
  }
  return one;
}

const Comparison* comparison(const ResultsSection& section, const std::string& name) {
  const auto found = std::ranges::find(section.comparisons, name, &NamedComparison::name);
  return found == section.comparisons.end() ? nullptr : &found->comparison;
}

TEST(RecordedResults, AreMeansOverParticipantsByBlockWithTheirDifference) {
  const MovementAnalysis movement{
      .participants = {person("P01", 1.6, 0.2, 2.0),
                       person("P02", 1.7, 0.3, 3.0),
                       person("P03", 1.8, 0.4, 4.5),
                       {.participant = "P04", .reason = "the recording is missing"}}};
  const ResultsSection section = recorded_results(movement);
  ASSERT_NE(find_estimate(section, "stroke_duration_s.d"), nullptr);
  EXPECT_NEAR(*find_estimate(section, "stroke_duration_s.d")->value, 9.5 / 3.0, 1e-12);
  EXPECT_EQ(find_estimate(section, "stroke_duration_s.e")->n, 3);
  EXPECT_NEAR(*find_estimate(section, "marked_ratio.d")->value, 0.25, 1e-12);
  EXPECT_EQ(find_estimate(section, "pause_s.d"), nullptr) << "nobody's is known";
  const Comparison* difference = comparison(section, "d - e: stroke_duration_s, paired");
  ASSERT_NE(difference, nullptr);
  EXPECT_NEAR(*difference->estimate, -1.0, 1e-12);
  ASSERT_EQ(section.excluded.size(), 1U);
  EXPECT_EQ(section.excluded[0].reason, "the recording is missing");
}

TEST(RecordedResults, TellWhetherTallPeopleStrokeOtherwise) {
  MovementAnalysis movement{
      .participants = {person("P01", 1.6, 0.3, 2.0), person("P02", 1.7, 0.2, 3.0),
                       person("P03", 1.8, 0.4, 4.0), person("P04", 1.9, 0.5, 4.0),
                       person("P05", 2.0, 0.0, 4.0)}};
  movement.participants.back().body_height_m.reset();
  const ResultsSection section = recorded_results(movement);
  // The ranks are 2 1 3 4 and 1 2 3 4, both evenly spaced, so r = 1 - 6 * 2 / (4 * 15).
  const Comparison* width =
      comparison(section, "d: stroke_width_m with body_height_m, Pearson");
  ASSERT_NE(width, nullptr);
  EXPECT_NEAR(*width->estimate, 0.8, 1e-12);
  EXPECT_EQ(width->num_a, 4);
  EXPECT_NE(comparison(section, "e: max_speed_m_per_s with body_height_m, Pearson"), nullptr);
}

TEST(RecordedResults, TakeDeliveredOverCommandedForceFromTheBlocksOwnStimuli) {
  ParticipantMovement one = person("P01", 1.7, 0.3, 2.0);
  const auto presented = [&one](const std::string& block, const std::string& interval,
                                double ratio) {
    PresentationMovement presentation{.block = block, .interval = interval};
    presentation.force.delivered_ratio = ratio;
    one.presentations.push_back(presentation);
  };
  presented("d", "reference", 0.9);
  presented("d", "test", 0.8);
  presented("d", "free_space", 0.1);
  presented("e", "test", 0.5);
  const ResultsSection section = recorded_results({.participants = {one}});
  EXPECT_NEAR(*find_estimate(section, "delivered_ratio.d")->value, 0.85, 1e-12);
  EXPECT_NEAR(*find_estimate(section, "delivered_ratio.e")->value, 0.5, 1e-12);
}

TEST(RecordedResults, OfAStudyHoldWhatItsRecordingSays) {
  RecordedStudy study(0.8);
  study.add("P01");
  study.answer_height("2.0");
  study.present({});
  study.add("P02");
  study.answer_height("tall");
  study.present({});
  study.finish();
  const ResultsSection section = recorded_results(analyse_movement(study.store()));
  EXPECT_NEAR(*find_estimate(section, "delivered_ratio.group_d")->value, 0.8, 2e-3);
  EXPECT_EQ(find_estimate(section, "delivered_ratio.group_d")->n, 2);
  EXPECT_NEAR(*find_estimate(section, "hand_height_ratio.group_d")->value, 0.5, 1e-6);
  EXPECT_EQ(find_estimate(section, "hand_height_ratio.group_d")->n, 1);
  EXPECT_NEAR(*find_estimate(section, "mean_speed_m_per_s.group_d")->value, 0.8, 1e-3);
}

TEST(RecordedResults, OfNoRecordingAreEmptyButForTheReasons) {
  const MovementAnalysis movement{.participants = {{.participant = "P01", .reason = "none"}}};
  const ResultsSection section = recorded_results(movement);
  EXPECT_TRUE(section.estimates.empty());
  EXPECT_TRUE(section.comparisons.empty());
  EXPECT_EQ(section.excluded.size(), 1U);
}

}  // namespace recorded_results_test
}  // namespace jnd::analysis
