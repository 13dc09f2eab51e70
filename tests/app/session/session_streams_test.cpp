#include "app/session/session_streams.h"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/storage/stream_file.h"
#include "core/streams/loopback_network.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_search.h"
#include "core/streams/stream_wire.h"
#include "experiments/session/session_in_memory.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace session_streams_test {

using core::comes_about;
using nlohmann::json;

class SessionStreamsTest : public ::testing::Test {
 protected:
  SessionStreamsTest() { session_.start(); }

  [[nodiscard]] SessionStreams::Parameters parameters(const WantedStreams& wanted) const {
    return {.wanted = wanted,
            .facts = {.study_id = network_.session_id,
                      .study = "secret study",
                      .session = 3,
                      .program_version = "0"},
            .recording = temporary_.path() / "0003.sqlite",
            .network = network_};
  }
  /// Opens our stream of this type from outside.
  [[nodiscard]] std::unique_ptr<core::StreamInlet> listen(const std::string& type) const {
    core::StreamNetwork network = network_;
    network.peers = {"127.0.0.1"};
    const auto found =
        core::find_streams(network, core::query_for(network, "type", type), 5.0, 1);
    return found.empty() ? nullptr : core::open_own_inlet(found[0], network);
  }
  static core::Sample sample(std::int64_t tick) {
    core::Sample sample{.tick = tick, .monotonic_ns = 1'000'000'000 + 1'000'000 * tick};
    sample.tip_position_m[0][0] = static_cast<double>(tick);
    return sample;
  }
  [[nodiscard]] std::vector<core::EventRow> events(const std::string& kind) const {
    std::vector<core::EventRow> found;
    for (const core::EventRow& row : log_.events) {
      if (row.kind == kind) found.push_back(row);
    }
    return found;
  }
  static core::StreamInfo amplifier(const std::string& name) {
    return {.name = name,
            .type = "EEG",
            .channel_count = 2,
            .nominal_rate_hz = 100.0,
            .format = core::ChannelFormat::kInt16,
            .source_id = name};
  }

  core::StreamNetwork network_ = core::loopback_network();
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::MemoryLog log_;
  core::SimulatedClock clock_;
  experiments::Session session_{{.session = 3}, {}, log_, clock_};
};

const WantedStreams kBoth{.markers = true, .samples = true};

TEST_F(SessionStreamsTest, SendsMarkersAndSamplesAndTellsOfThem) {
  SessionStreams streams(parameters(kBoth));
  streams.follow(session_);
  const auto opened = events("stream_opened");
  ASSERT_EQ(opened.size(), 2U);
  EXPECT_EQ(json::parse(opened[0].data)["by"], "jnd");
  EXPECT_EQ(json::parse(opened[1].data)["channel_count"], 10);
  EXPECT_GT(json::parse(opened[1].data)["monotonic_s"].get<double>(), 0.0);

  const auto markers = listen("Markers");
  const auto samples = listen("Haptics");
  ASSERT_TRUE(markers && samples);
  using State = core::StreamInlet::State;
  ASSERT_TRUE(comes_about([&] {
    return markers->state() == State::kReceiving && samples->state() == State::kReceiving;
  }));
  for (std::int64_t tick = 0; tick < 2000; ++tick) streams.take(sample(tick));
  const auto came = core::take_from(*samples, 2000);
  ASSERT_EQ(came.size(), 2000U);
  EXPECT_NEAR(came[1999].time_s, 2.999, 1e-9);
  EXPECT_EQ(came[7].values.size(), 40U);

  core::EventRow row{.session = 3,
                     .sequence = 17,
                     .kind = "presentation_started",
                     .time_ns = core::SystemClock().now_ns() - 250'000'000,
                     .trial = 4,
                     .attempt = 1};
  streams.tell(row);
  const auto marker = core::take_from(*markers, 1);
  ASSERT_EQ(marker.size(), 1U);
  EXPECT_EQ(json::parse(marker[0].texts[0])["presentation"], 1);
  EXPECT_NEAR(marker[0].time_s, core::stream_clock_s() - 0.25, 0.2) << "when it happened";

  streams.close(session_);
  const auto closed = events("stream_closed");
  ASSERT_EQ(closed.size(), 2U);
  EXPECT_EQ(json::parse(closed[0].data)["num_samples"], 1);
  EXPECT_EQ(json::parse(closed[1].data)["num_samples"], 2000);
  EXPECT_EQ(json::parse(closed[1].data)["num_dropped"], 0);
  streams.close(session_);
  EXPECT_EQ(events("stream_closed").size(), 2U) << "once";
}

TEST_F(SessionStreamsTest, RecordsEveryStreamOfAKindWithItsClock) {
  core::StreamNetwork there = network_;
  there.clock_s = [] { return core::stream_clock_s() - 500.0; };
  const auto one = core::open_own_outlet(amplifier("one"), there);
  const auto two = core::open_own_outlet(amplifier("two"), there);
  SessionStreams::Parameters wanted = parameters({.inlets = {"type=EEG"}});
  wanted.wanted.peers = {"127.0.0.1"};
  SessionStreams streams(wanted);
  ASSERT_TRUE(
      comes_about([&] { return one->num_consumers() == 1 && two->num_consumers() == 1; }));
  std::vector<core::StreamSample> sent;
  for (int i = 0; i < 300; ++i) {
    sent.push_back(core::test_sample(core::ChannelFormat::kInt16, 2, i));
    sent.back().time_s = 10.0 + 0.01 * i;
  }
  one->push(sent);
  ASSERT_TRUE(comes_about([&] {
    streams.follow(session_);
    return events("stream_opened").size() == 2;
  }));
  // One round of comparing the clocks takes half a second.
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  streams.close(session_);
  const auto opened = events("stream_opened"), closed = events("stream_closed");
  ASSERT_EQ(closed.size(), 2U);
  EXPECT_EQ(core::stream_files(temporary_.path() / "0003.sqlite").size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const json told = json::parse(closed[i].data);
    EXPECT_EQ(told["file"], json::parse(opened[i].data)["file"]);
    const core::StreamFileReader reader(temporary_.path() / told["file"].get<std::string>());
    EXPECT_TRUE(reader.problems().empty());
    EXPECT_EQ(reader.seal()->sha256, told["sha256"]);
    std::vector<core::StreamSample> kept;
    reader.read([&kept](const core::StreamSample& sample) { kept.push_back(sample); });
    EXPECT_EQ(kept, reader.info().name == "one" ? sent : std::vector<core::StreamSample>());
    ASSERT_FALSE(reader.offsets().empty());
    EXPECT_NEAR(reader.offsets()[0].offset_s, 500.0, 0.1);
  }
}

TEST_F(SessionStreamsTest, AStreamThatGoesAwayIsToldAndWhatCameIsKept) {
  auto outlet = core::open_own_outlet(amplifier("going"), network_);
  SessionStreams::Parameters wanted = parameters({.inlets = {"name=going"}});
  wanted.wanted.peers = {"127.0.0.1"};
  SessionStreams streams(wanted);
  ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; }));
  outlet->push({core::test_sample(core::ChannelFormat::kInt16, 2, 1)});
  outlet.reset();
  ASSERT_TRUE(comes_about([&] {
    streams.follow(session_);
    return !events("stream_failed").empty();
  }));
  streams.close(session_);
  const auto closed = events("stream_closed");
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_EQ(json::parse(closed[0].data)["num_samples"], 1);
}

TEST_F(SessionStreamsTest, WhatCannotBeIsToldAndTheSessionGoesOn) {
  SessionStreams streams(parameters({.markers = true,
                                     .samples = true,
                                     .channels = {"no_such_channel"},
                                     .inlets = {"nonsense"},
                                     .library = "/nowhere/liblsl.so"}));
  streams.follow(session_);
  EXPECT_EQ(events("stream_failed").size(), 3U) << "library, channel, inlet";
  EXPECT_EQ(events("stream_opened").size(), 1U) << "markers, by our own";
  streams.take(sample(1));
  streams.close(session_);
}

TEST_F(SessionStreamsTest, SamplesOfADoubleBlindStudyAreNotSent) {
  SessionStreams::Parameters blind = parameters(kBoth);
  blind.hides_levels = true;
  SessionStreams streams(blind);
  streams.follow(session_);
  ASSERT_EQ(events("stream_failed").size(), 1U);
  ASSERT_EQ(events("stream_opened").size(), 1U);
  EXPECT_NE(listen("Markers"), nullptr);
  core::StreamNetwork network = network_;
  network.peers = {"127.0.0.1"};
  EXPECT_TRUE(
      core::find_streams(network, core::query_for(network, "type", "Haptics"), 0.7).empty());
}

/// Whatever an event says about levels and answers, no byte of it is sent.
TEST_F(SessionStreamsTest, NoLevelIsInAnyByteOfTheMarkers) {
  SessionStreams streams(parameters({.markers = true}));
  const auto markers = listen("Markers");
  ASSERT_TRUE(markers);
  ASSERT_TRUE(
      comes_about([&] { return markers->state() == core::StreamInlet::State::kReceiving; }));
  constexpr double kLevel = 7.319;
  const std::vector<experiments::EventData> all = {
      experiments::TrialStarted{.trial = 1},
      experiments::PresentationStarted{
          .trial = 1, .interval = "test7.319", .intensity = kLevel, .place = 2},
      experiments::PresentationEnded{
          .trial = 1, .summary = {.measures = {.delivered_damping_n_s_per_m = kLevel}}},
      experiments::IntensityAdjusted{.trial = 1, .to_intensity = kLevel},
      experiments::TrialAnswered{.trial = 1, .response = kLevel, .feedback_right = true},
      experiments::MediumExplored{.medium = "level7.319", .intensity = kLevel},
      experiments::NoteAdded{"7.319"},
      experiments::Paused{"7.319"},
      experiments::FaultRaised{"7.319"},
      experiments::AttemptDiscarded{.trial = 1, .reason = "7.319"},
      experiments::AnswerUndone{.trial = 1, .reason = "7.319"},
      experiments::AnswerCorrected{.trial = 1, .response = kLevel, .reason = "7.319"},
      experiments::QuestionAnswered{.trial = 1, .question = "7.319", .answer = "7.319"},
      experiments::ItemAnswered{.stage_name = "7.319", .item = "7.319", .answer = "7.319"},
      experiments::TrialsDrawn{.trials = {{.intensity = kLevel}}},
      experiments::SessionEndedEarly{"7.319"}};
  std::int64_t sequence = 0;
  for (const experiments::EventData& data : all) {
    core::EventRow row = experiments::row_from_event(3, {.sequence = ++sequence, .data = data});
    row.time_ns = core::SystemClock().now_ns();
    streams.tell(row);
  }
  const auto came = core::take_from(*markers, 12);
  EXPECT_EQ(came.size(), 12U);
  std::string bytes = markers->full_xml();
  for (const core::StreamSample& sample : came) {
    core::append_sample(bytes, sample, core::ChannelFormat::kString);
  }
  for (const char* word : {"7.319", "7,319", "7319", "interval", "true", "right", "response"}) {
    EXPECT_EQ(bytes.find(word), std::string::npos) << word;
  }
}

TEST(WantedStreams, WhatIsLookedForIsSaidByAKey) {
  EXPECT_EQ(searched_for("type=EEG"), (std::pair<std::string, std::string>{"type", "EEG"}));
  EXPECT_EQ(searched_for("name=a=b").second, "a=b");
  for (const char* inlet : {"", "EEG", "type=", "uid=7", "=EEG", "type"}) {
    EXPECT_THROW((void)searched_for(inlet), core::Error) << inlet;
  }
}

TEST(WantedStreams, SamplesAndHiddenLevelsExcludeEachOther) {
  EXPECT_NO_THROW(require_possible({.markers = true}, /*hides_levels=*/true));
  EXPECT_NO_THROW(require_possible(kBoth, /*hides_levels=*/false));
  EXPECT_THROW(require_possible(kBoth, /*hides_levels=*/true), core::Error);
}

}  // namespace session_streams_test
}  // namespace jnd::app
