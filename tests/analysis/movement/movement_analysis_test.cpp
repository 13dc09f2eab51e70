#include "analysis/movement/movement_analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "analysis/movement/recorded_study.h"
#include "core/error.h"

namespace jnd::analysis {
namespace movement_analysis_test {

TEST(MovementAnalysis, MeasuresEveryPresentationTrialAndCondition) {
  RecordedStudy study;
  study.add("P01");
  study.answer_height("1.80");
  study.present({.intensity = 2.0});
  study.present({.intensity = 4.0, .repetition = 2});
  study.finish();
  const MovementAnalysis found = analyse_movement(study.store());
  EXPECT_TRUE(found.simulated);
  EXPECT_TRUE(found.any());
  ASSERT_EQ(found.participants.size(), 1U);
  const ParticipantMovement& person = found.participants[0];
  EXPECT_EQ(person.participant, "P01");
  EXPECT_EQ(person.reason, "");
  EXPECT_EQ(person.num_samples, 4 * 5600);
  EXPECT_EQ(person.missing_ticks, 1000) << "the rest between two trials was not recorded";
  EXPECT_EQ(*person.body_height_m, 1.80);
  EXPECT_EQ(*person.surface_height_m, 1.5);

  ASSERT_EQ(person.presentations.size(), 4U);
  const PresentationMovement& reference = person.presentations[0];
  EXPECT_EQ(reference.interval, "reference");
  EXPECT_EQ(reference.block, "group_d");
  EXPECT_EQ(reference.medium, "viscous");
  EXPECT_FALSE(reference.marks.any());
  EXPECT_EQ(reference.strokes.num_strokes, 5);
  EXPECT_NEAR(*reference.strokes.stroke_width_m, 0.4, 1e-6);
  EXPECT_NEAR(*reference.strokes.max_speed_m_per_s, 0.4 * M_PI, 1e-4);
  EXPECT_NEAR(*reference.strokes.mean_speed_m_per_s, 0.8, 1e-4);
  EXPECT_NEAR(*reference.mean_height_m, -0.5, 1e-6);
  EXPECT_NEAR(*reference.force.delivered_ratio, 0.9, 1e-3);
  EXPECT_NEAR(*reference.force.delivered_damping_n_s_per_m, 0.9 * 1.776, 2e-3);
  // Power is damping speed^2, so over a stroke the mean is 1.776 * 0.9 * (0.4 pi)^2 / 2.
  EXPECT_NEAR(*reference.strokes.stroke_energy_j, 0.9 * 1.776 * 0.16 * M_PI * M_PI / 2.0, 2e-3);

  ASSERT_EQ(person.trials.size(), 2U);
  EXPECT_EQ(person.trials[1].trial, 2);
  EXPECT_EQ(person.trials[1].repetition, 2);
  EXPECT_EQ(person.trials[1].strokes.num_strokes, 10);

  const ConditionMovement* whole = person.find("group_d");
  ASSERT_NE(whole, nullptr);
  EXPECT_EQ(whole->num_presentations, 4);
  EXPECT_EQ(whole->strokes.num_strokes, 20);
  EXPECT_EQ(whole->curves.num_strokes, 16);
  EXPECT_NEAR(*whole->hand_height_ratio, (1.5 - 0.5) / 1.8, 1e-6);
  ASSERT_NE(person.find("group_d", 4.0), nullptr);
  EXPECT_EQ(person.find("group_d", 4.0)->strokes.num_strokes, 5);
  EXPECT_EQ(person.find("group_d", 1.0)->num_presentations, 2);
  EXPECT_EQ(person.find("group_d", 3.0), nullptr);
}

TEST(MovementAnalysis, TellsDeliveredFromCommandedForceAtEverySpeed) {
  RecordedStudy study(0.8);
  study.add("P01");
  study.present({.intensity = 10.0, .reference = std::nullopt});
  study.finish();
  const MovementAnalysis found = analyse_movement(study.store());
  const ForceBySpeed& force = found.participants[0].find("group_d", 10.0)->force;
  ASSERT_GT(force.speed_m_per_s.size(), 20U);
  ASSERT_EQ(force.commanded_n.size(), force.speed_m_per_s.size());
  for (std::size_t i = 0; i < force.speed_m_per_s.size(); ++i) {
    EXPECT_NEAR(force.commanded_n[i], 17.76 * force.speed_m_per_s[i], 1e-9);
    EXPECT_NEAR(force.delivered_n[i], 0.8 * 17.76 * force.speed_m_per_s[i], 5e-3);
  }
}

TEST(MovementAnalysis, LeavesOutTrialsThatWereSetAsidePilotsAndOnRequestWhatWasExplored) {
  RecordedStudy study;
  study.add("P01");
  study.explore("water", 1.0, 2600);
  study.present({});
  study.present({});
  study.exclude(1);
  study.add("P02", /*pilot=*/true);
  study.present({});
  study.finish();
  const MovementAnalysis found = analyse_movement(study.store());
  ASSERT_EQ(found.participants.size(), 1U);
  const ParticipantMovement& person = found.participants[0];
  ASSERT_EQ(person.trials.size(), 1U);
  EXPECT_EQ(person.trials[0].trial, 2);
  const ConditionMovement& explored = person.conditions.back();
  EXPECT_EQ(explored.block, "");
  EXPECT_EQ(explored.medium, "water");
  EXPECT_EQ(*explored.intensity, 1.0);
  EXPECT_EQ(explored.strokes.num_strokes, 2);
  const MovementAnalysis all =
      analyse_movement(study.store(), {.pilot = true, .explored = false});
  ASSERT_EQ(all.participants.size(), 2U);
  for (const ConditionMovement& one : all.participants[0].conditions) EXPECT_NE(one.block, "");
}

TEST(MovementAnalysis, MarksTheTrialsOfARecordingWithGapsAndInventsNothing) {
  RecordedStudy study;
  study.add("P01");
  study.present({}, [](core::Sample& sample) { return sample.tick % 5600 != 3000; });
  study.present({});
  study.finish();
  const ParticipantMovement person = analyse_movement(study.store()).participants.at(0);
  EXPECT_EQ(person.trials[0].marks.missing_ticks, 2);
  EXPECT_FALSE(person.trials[1].marks.any());
  EXPECT_EQ(person.find("group_d")->num_marked, 2);
  EXPECT_EQ(person.num_samples, 4 * 5600 - 2);
  EXPECT_LT(person.trials[0].strokes.num_strokes, person.trials[1].strokes.num_strokes);
}

TEST(MovementAnalysis, SaysWhoHasNoRecordingAndWhy) {
  RecordedStudy study;
  study.add("P01", /*pilot=*/false, /*recorded=*/false);
  study.present({});
  const std::int64_t lost = study.add("P02");
  study.present({});
  study.add("P03");
  study.present({});
  const std::int64_t damaged = study.add("P04");
  study.present({});
  study.finish();
  std::filesystem::remove(study.store().recording_file(lost));
  std::ofstream(study.store().recording_file(damaged), std::ios::trunc) << "no database";
  const MovementAnalysis found = analyse_movement(study.store());
  ASSERT_EQ(found.participants.size(), 4U);
  EXPECT_EQ(found.participants[0].reason, "no samples were kept, only summaries of strokes");
  EXPECT_EQ(found.participants[1].reason, "the recording is missing");
  EXPECT_EQ(found.participants[2].reason, "");
  EXPECT_GT(found.participants[2].num_samples, 0);
  EXPECT_NE(found.participants[3].reason, "");
  EXPECT_TRUE(found.participants[3].presentations.empty());
}

TEST(MovementAnalysis, PresentationsBeyondTheRecordingAreMissingAsAWhole) {
  RecordedStudy study;
  study.add("P01");
  study.present({.reference = std::nullopt});
  study.present({.reference = std::nullopt}, [](core::Sample&) { return false; });
  study.finish();
  const ParticipantMovement person = analyse_movement(study.store()).participants.at(0);
  ASSERT_EQ(person.presentations.size(), 2U);
  EXPECT_EQ(person.presentations[1].marks.missing_ticks, 5600);
  EXPECT_EQ(person.presentations[1].strokes.num_strokes, 0);
  EXPECT_FALSE(person.presentations[1].mean_height_m.has_value());
  EXPECT_FALSE(person.presentations[1].force.delivered_n.has_value());
}

TEST(MovementAnalysis, DrawsTheHandsWayWithoutGaps) {
  RecordedStudy study;
  study.add("P01");
  study.present({.reference = std::nullopt},
                [](core::Sample& sample) { return sample.tick % 5600 != 3333; });
  study.finish();
  const ParticipantMovement person = analyse_movement(study.store()).participants.at(0);
  ASSERT_EQ(person.trajectories.size(), 1U);
  const Trajectory& way = person.trajectories[0];
  EXPECT_EQ(way.block, "group_d");
  ASSERT_EQ(way.hand.size(), 2U);
  ASSERT_EQ(way.end_effector.size(), 2U);
  EXPECT_NEAR(static_cast<double>(way.hand[0].x_m.size() + way.hand[1].x_m.size()), 280.0, 2.0);
  EXPECT_NEAR(way.hand[0].x_m[5], 0.2 * std::sin(2.0 * M_PI * 0.1), 1e-6);
  EXPECT_NEAR(way.hand[0].y_m[5], 0.02, 1e-6);
  EXPECT_NEAR(way.end_effector[0].y_m[5], -0.3, 1e-6);
}

TEST(MovementAnalysis, ForwardIsToTheSideOfTheEndEffectorUnlessSaid) {
  const auto height_in_mid_forward_m = [](double end_effector_aside_m,
                                          const MovementOptions& options) {
    RecordedStudy study;
    study.add("P01");
    // The hand is 2 cm lower wherever it moves along +x.
    study.present({.reference = std::nullopt}, [&](core::Sample& sample) {
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        if (sample.tip_velocity_m_per_s[point][0] > 0) sample.tip_position_m[point][2] -= 0.02;
      }
      sample.end_effector_position_m[0] += end_effector_aside_m;
      return true;
    });
    study.finish();
    const MovementAnalysis found = analyse_movement(study.store(), options);
    return found.participants.at(0).find("group_d")->curves.height_m.mean.at(50);
  };
  EXPECT_NEAR(height_in_mid_forward_m(0.0, {}), -0.52, 1e-6);
  EXPECT_NEAR(height_in_mid_forward_m(0.1, {}), -0.52, 1e-6);
  EXPECT_NEAR(height_in_mid_forward_m(-0.1, {}), -0.50, 1e-6);
  EXPECT_NEAR(height_in_mid_forward_m(-0.1, {.forward = std::array{2.0, 0.5}}), -0.52, 1e-6);
}

TEST(MovementAnalysis, IsTheSameForAnyNumberOfJobs) {
  RecordedStudy study;
  for (const char* name : {"P03", "P01", "P02"}) {
    study.add(name);
    study.present({.num_ticks = 2600});
  }
  study.finish();
  const MovementAnalysis one = analyse_movement(study.store());
  const MovementAnalysis three = analyse_movement(study.store(), {.jobs = 3});
  ASSERT_EQ(one.participants.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(one.participants[i].participant, three.participants[i].participant);
    EXPECT_EQ(*one.participants[i].trials[0].strokes.stroke_width_m,
              *three.participants[i].trials[0].strokes.stroke_width_m);
  }
  EXPECT_EQ(one.participants[0].participant, "P01");
}

TEST(MovementAnalysis, NamesTheOptionItRejects) {
  const RecordedStudy study;
  EXPECT_THROW((void)analyse_movement(study.store(), {.hysteresis_m = 0.0}), core::Error);
  EXPECT_THROW((void)analyse_movement(study.store(), {.forward = std::array{0.0, 0.0}}),
               core::Error);
  EXPECT_THROW((void)analyse_movement(study.store(), {.rest_speed_m_per_s = std::nan("")}),
               core::Error);
  EXPECT_THROW((void)analyse_movement(study.store(), {.jobs = 0}), core::Error);
}

}  // namespace movement_analysis_test
}  // namespace jnd::analysis
