#include "core/streams/session_markers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/sample_table.h"
#include "core/streams/sample_stream.h"

namespace jnd::core {
namespace session_markers_test {

EventRow presentation(const char* kind, std::int64_t trial, std::int64_t attempt) {
  return {.session = 12,
          .sequence = 345,
          .kind = kind,
          .trial = trial,
          .attempt = attempt,
          .intensity = 7.5,
          .data = R"({"interval":"test"})"};
}

TEST(SessionMarkers, SayWhatHappenedInNumbers) {
  SessionMarkers markers;
  EXPECT_EQ(markers.marker_of(presentation("presentation_started", 7, 1)),
            R"({"what":"presentation_started","session":12,"event":345,"trial":7,"attempt":1,)"
            R"("presentation":1})");
  EXPECT_EQ(
      markers.marker_of({.session = 12, .sequence = 3, .kind = "stage_entered", .stage = 2}),
      R"({"what":"stage_entered","session":12,"event":3,"stage":2})");
}

TEST(SessionMarkers, PresentationsAreCountedWithinAnAttempt) {
  SessionMarkers markers;
  std::string numbers;
  const auto tell = [&](const char* kind, std::int64_t trial, std::int64_t attempt) {
    const std::string marker = *markers.marker_of(presentation(kind, trial, attempt));
    numbers += marker.substr(marker.rfind(':') + 1, 1);
  };
  for (const auto& [trial, attempt] :
       std::vector<std::pair<int, int>>{{1, 1}, {1, 1}, {1, 2}, {2, 1}}) {
    tell("presentation_started", trial, attempt);
    tell("presentation_ended", trial, attempt);
  }
  EXPECT_EQ(numbers, "11221111");
}

TEST(SessionMarkers, WhatIsNobodyElsesBusinessIsNone) {
  SessionMarkers markers;
  for (const char* kind :
       {"trials_drawn", "note_added", "item_answered", "intensity_adjusted", "unblinded",
        "stream_opened", "loop_measured", "turn_taken", "exposure_told", "something_new"}) {
    EXPECT_FALSE(markers.marker_of({.session = 1, .sequence = 1, .kind = kind})) << kind;
  }
}

std::vector<float> values_of(const StreamSample& sample) {
  std::vector<float> values(sample.values.size() / sizeof(float));
  std::memcpy(values.data(), sample.values.data(), sample.values.size());
  return values;
}

/// Returns a sample of a pincer, which has two of the five points.
Sample pincer() {
  Sample sample{.tick = 9, .command_sequence = 4, .attached_bits = 0b01100};
  sample.tip_position_m[2] = {0.1, 0.2, 0.3};
  sample.tip_position_m[3] = {0.3, 0.2, 0.1};
  sample.tip_velocity_m_per_s[2] = {1.0, 0.0, 0.0};
  sample.tip_force_n[2] = {0.5, 0.0, -1.0};
  sample.tip_force_n[3] = {0.25, 0.0, -1.0};
  return sample;
}

TEST(SampleStream, TheUsualChannelsAreThoseOfTheHand) {
  const SampleStream stream({});
  const StreamSample sample = stream.sample(pincer(), 12.5);
  EXPECT_EQ(sample.time_s, 12.5);
  EXPECT_EQ(values_of(sample),
            (std::vector<float>{0.2F, 0.2F, 0.2F, 0.5F, 0.0F, 0.0F, 0.75F, 0.0F, -2.0F, 4.0F}));
  const StreamInfo info = stream.info({.study_id = "s", .study = "x", .session = 3}, 1000.0);
  EXPECT_EQ(info.channel_count, 10);
  EXPECT_EQ(info.channels[3].unit, "m/s");
  EXPECT_EQ(info.channels[6].type, "Force");
  EXPECT_EQ(info.channels[9].unit, "");
  EXPECT_EQ(info.source_id, "jnd-samples-s-3");
}

/// Force sensors count more than what was sent to the motors.
TEST(SampleStream, TheForceIsTheOneThatWasDelivered) {
  Sample sample = pincer();
  sample.channels.bits = kMeasuredForce;
  sample.channels.force_n[2] = {0.0, 3.0, 0.0};
  EXPECT_EQ(values_of(SampleStream({"hand_force_y_n"}).sample(sample, 0.0)),
            std::vector<float>{3.0F});
}

TEST(SampleStream, AnyColumnOrArrayOfARecordingCanBeChosen) {
  const SampleStream stream({"index_position_x_m", "force_n", "command", "fault"});
  const std::vector<float> values = values_of(stream.sample(pincer(), 0.0));
  ASSERT_EQ(values.size(), 1U + 15U + 2U);
  EXPECT_EQ(values[0], 0.3F);
  EXPECT_EQ(values[1 + 6 + 2], -1.0F) << "thumb, along z";
  EXPECT_EQ(values[16], 4.0F);
  const StreamInfo info = stream.info({}, 1000.0);
  EXPECT_EQ(info.channels[1 + 6 + 2].label, "thumb_force_z_n");
  EXPECT_EQ(info.channels[0].unit, "m");
}

TEST(SampleStream, EveryColumnHasItsUnit) {
  for (const auto& [name, unit] : std::vector<std::pair<std::string, std::string>>{
           {"end_effector_torque_x_n_m", "N m"},
           {"end_effector_position_x_m", "m"},
           {"gripper_m", "m"},
           {"buttons", ""},
           {"palm_inner_measured_force_x_n", "N"}}) {
    EXPECT_EQ(SampleStream({name}).info({}, 1.0).channels[0].unit, unit) << name;
  }
}

TEST(SampleStream, ANameThatIsNoneIsToldWithThoseThereAre) {
  try {
    (void)SampleStream({"hand_forces"});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("hand_force_z_n"), std::string::npos);
  }
}

}  // namespace session_markers_test
}  // namespace jnd::core
