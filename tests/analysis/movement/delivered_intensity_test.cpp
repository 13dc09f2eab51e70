#include "analysis/movement/delivered_intensity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/movement/recorded_study.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace delivered_intensity_test {

core::TrialRow comparison(std::int64_t trial, double intensity, bool thicker) {
  return {.session = 1,
          .trial = trial,
          .block = "d",
          .procedure = "constant_stimuli",
          .intensity = intensity,
          .reference_intensity = 2.0,
          .response = thicker ? 1.0 : 0.0};
}

core::PresentationRow felt(std::int64_t trial, const char* interval, double intensity,
                           double delivered_ratio) {
  return {.session = 1,
          .trial = trial,
          .interval = interval,
          .intensity = intensity,
          .measures = {.delivered_damping_n_s_per_m = delivered_ratio * 1.5 * intensity,
                       .commanded_damping_n_s_per_m = 1.5 * intensity}};
}

StudyData one_person(std::vector<core::TrialRow> trials,
                     std::vector<core::PresentationRow> presentations) {
  StudyData data;
  data.participants.push_back({.participant = "P01", .trials = std::move(trials)});
  data.participants[0].presentations["d"] = std::move(presentations);
  return data;
}

TEST(DeliveredIntensity, IsCommandedIntensityTimesDeliveredOverCommandedForce) {
  const StudyData data = one_person(
      {comparison(1, 4.0, true)}, {felt(1, "reference", 2.0, 0.9), felt(1, "test", 4.0, 0.8),
                                   felt(1, "reference", 2.0, 0.7), felt(1, "test", 4.0, 0.6)});
  const DeliveredTrial trial = delivered_intensities(data).at({1, 1});
  EXPECT_NEAR(*trial.test, 4.0 * 0.7, 1e-12);
  EXPECT_NEAR(*trial.reference, 2.0 * 0.8, 1e-12);
}

TEST(DeliveredIntensity, ATestGetsItsLevelsMeanInUnitsOfTheReferenceAsDelivered) {
  const StudyData data = one_person(
      {comparison(1, 4.0, true), comparison(2, 4.0, false), comparison(3, 1.0, false)},
      {felt(1, "reference", 2.0, 0.9), felt(1, "test", 4.0, 0.6),
       felt(2, "reference", 2.0, 0.7), felt(2, "test", 4.0, 0.8),
       felt(3, "reference", 2.0, 0.8), felt(3, "test", 1.0, 1.0)});
  const DeliveredStudy study = with_delivered(data, delivered_intensities(data));
  EXPECT_EQ(study.num_replaced, 3);
  EXPECT_EQ(study.num_left_out, 0);
  const std::vector<core::TrialRow>& trials = study.data.participants[0].trials;
  EXPECT_NEAR(*trials[0].intensity, 4.0 * 0.7 / 0.8, 1e-12);
  EXPECT_EQ(*trials[0].intensity, *trials[1].intensity) << "levels stay levels";
  EXPECT_NEAR(*trials[2].intensity, 1.0 / 0.8, 1e-12);
  EXPECT_EQ(*trials[2].reference_intensity, 2.0);
}

TEST(DeliveredIntensity, AnEstimateRestsOnWhatWasDeliveredAndZeroStaysZero) {
  StudyData data = one_person({{.session = 1, .trial = 1, .block = "d", .intensity = 0.5},
                               {.session = 1, .trial = 2, .block = "d", .intensity = 0.0}},
                              {felt(1, "test", 0.5, 0.9)});
  const DeliveredStudy study = with_delivered(data, delivered_intensities(data));
  EXPECT_NEAR(*study.data.participants[0].trials[0].intensity, 0.45, 1e-12);
  EXPECT_EQ(*study.data.participants[0].trials[1].intensity, 0.0);
}

TEST(DeliveredIntensity, OfAProductionIsThatOfTheValueSet) {
  const core::TrialRow production = {.session = 1,
                                     .trial = 1,
                                     .block = "d",
                                     .procedure = "magnitude_production",
                                     .intensity = 1.2,
                                     .target_percent = 100.0,
                                     .response = 1.2};
  const StudyData data = one_person(
      {production},
      {felt(1, "test", 3.0, 0.5), felt(1, "test", 2.0, 0.6), felt(1, "test", 1.2, 0.9)});
  const DeliveredStudy study = with_delivered(data, delivered_intensities(data));
  EXPECT_NEAR(*study.data.participants[0].trials[0].intensity, 1.08, 1e-12);
  EXPECT_NEAR(*study.data.participants[0].trials[0].response, 1.08, 1e-12);
}

TEST(DeliveredIntensity, WhatNobodyMeasuredIsLeftOutAndCounted) {
  core::PresentationRow nothing = felt(2, "test", 1.0, 1.0);
  nothing.measures.delivered_damping_n_s_per_m = std::nan("");
  const StudyData data =
      one_person({comparison(1, 4.0, true), comparison(2, 1.0, false)},
                 {felt(1, "reference", 2.0, 1.0), felt(1, "test", 4.0, 1.0), nothing});
  const DeliveredStudy study = with_delivered(data, delivered_intensities(data));
  EXPECT_EQ(study.num_replaced, 1);
  EXPECT_EQ(study.num_left_out, 1);
  ASSERT_EQ(study.data.participants[0].trials.size(), 1U);
  EXPECT_EQ(study.data.participants[0].trials[0].trial, 1);
}

TEST(DeliveredIntensity, WhereTheDatabaseIsSilentTheRecordingSays) {
  RecordedStudy study(0.75);
  study.add("P01");
  study.present({.intensity = 4.0, .reference = std::nullopt});
  study.finish();
  StudyData data = load_study(study.store());
  for (auto& [block, rows] : data.participants[0].presentations) {
    for (core::PresentationRow& row : rows) row.measures.commanded_damping_n_s_per_m.reset();
  }
  EXPECT_TRUE(delivered_intensities(data).empty());
  const DeliveredStudy found = with_delivered(data, study.store());
  EXPECT_EQ(found.num_left_out, 0);
  EXPECT_NEAR(*found.data.participants[0].trials.at(0).intensity, 3.0, 2e-3);
}

TEST(DeliveredIntensity, WhatTheDeviceMakesOfItIsInIt) {
  const StudyData data = one_person(
      {comparison(1, 4.0, true)}, {felt(1, "reference", 2.0, 1.0), felt(1, "test", 4.0, 1.0)});
  // 6 and 3 N s/m were commanded. A gain of 0.8 and the device's own 2.4 N s/m make 7.2 and 4.8
  // N s/m.
  const DeviceParts devices = {{1, {.gain = 0.8, .damping_n_s_per_m = 2.4}}};
  const DeliveredIntensities delivered = delivered_intensities(data, devices);
  EXPECT_NEAR(*delivered.at({1, 1}).test, 4.0 * 7.2 / 6.0, 1e-12);
  EXPECT_NEAR(*delivered.at({1, 1}).reference, 2.0 * 4.8 / 3.0, 1e-12);
  const DeliveredStudy study = with_delivered(data, delivered);
  EXPECT_NEAR(*study.data.participants[0].trials[0].intensity, 2.0 * 7.2 / 4.8, 1e-12);
  // A device without measurements changes nothing.
  const DeviceParts other = {{2, {.gain = 0.8, .damping_n_s_per_m = 2.4}}};
  EXPECT_NEAR(*delivered_intensities(data, other).at({1, 1}).test, 4.0, 1e-12);
}

TEST(DeliveredIntensity, ADeviceThatDeliversTheSameShareOfEverythingChangesNoWeberFraction) {
  std::vector<core::TrialRow> trials;
  std::vector<core::PresentationRow> presentations;
  std::int64_t number = 0;
  for (const double intensity : {1.0, 1.5, 2.5, 4.0}) {
    for (int i = 0; i < 10; ++i) {
      const bool thicker = i < static_cast<int>(1.0 + 2.0 * intensity);
      trials.push_back(comparison(++number, intensity, thicker));
      presentations.push_back(felt(number, "reference", 2.0, 0.7));
      presentations.push_back(felt(number, "test", intensity, 0.7));
    }
  }
  StudyData data = one_person(trials, presentations);
  data.blocks = {{.block = "d", .procedure = "constant_stimuli", .reference_intensity = 2.0}};
  const auto weber_fraction = [](const StudyData& study) {
    return results_of(study, {}, {.num_resamples = 100}).find("d.weber_fraction")->value;
  };
  const DeliveredStudy delivered = with_delivered(data, delivered_intensities(data));
  ASSERT_TRUE(weber_fraction(data).has_value());
  EXPECT_NEAR(*weber_fraction(delivered.data), *weber_fraction(data), 1e-9);
}

}  // namespace delivered_intensity_test
}  // namespace jnd::analysis
