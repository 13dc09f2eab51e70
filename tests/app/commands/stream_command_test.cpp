#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/tiny_study.h"
#include "core/storage/stream_file.h"
#include "core/streams/loopback_network.h"
#include "core/streams/stream_outlet.h"
#include "core/streams/stream_search.h"
#include "core/streams/stream_wire.h"

namespace jnd::app {
namespace stream_command_test {

namespace fs = std::filesystem;
using core::comes_about;
using nlohmann::json;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

/// The study has three seconds of free movement and one trial.
constexpr char kShortStudy[] = R"json({
  "format": 1, "name": "short", "languages": ["en"], "title": {"en": "Short"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "explore", "name": "free", "instruction": {"en": "Move."},
     "media": [{"medium": "free_space", "duration_s": 3}]},
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "water", "scale": [1.625], "repetitions": 1, "free_space_between_s": 0,
     "instruction": {"en": "Say."}, "question": {"en": "How strong?"}, "expected_trial_s": 5}]
})json";

class StreamCommandTest : public CommandTest {
 protected:
  StreamCommandTest() { write_file(path("short.json"), kShortStudy); }
  [[nodiscard]] static std::vector<std::string> words(std::vector<std::string> more) {
    std::vector<std::string> all = {"run",           "short.json", "--study",   "a.study",
                                    "--participant", "P01",        "--headless"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] std::vector<json> events(const std::string& kind) const {
    std::vector<json> found;
    for (const core::EventRow& event : opened("a.study").events(1)) {
      if (event.kind == kind) found.push_back(json::parse(event.data));
    }
    return found;
  }
};

TEST_F(StreamCommandTest, ASessionIsInStepWithOtherRecorders) {
  core::StreamNetwork network = core::loopback_network();
  network.session_id = "default";
  const std::string name = "amplifier " + core::new_stream_uid();
  const auto amplifier = core::open_own_outlet({.name = name,
                                                .type = "EEG",
                                                .channel_count = 2,
                                                .nominal_rate_hz = 100.0,
                                                .format = core::ChannelFormat::kInt16,
                                                .source_id = name},
                                               network);
  RunningProgram child(words({"--realtime", "--acknowledge", "--lsl-out", "markers,samples",
                              "--lsl-in", "name=" + name, "--lsl-peer", "127.0.0.1"}),
                       options_);
  ASSERT_EQ(child.read_line(), "EVENT 1 session_started");
  const std::string study_id = opened("a.study").study_id();
  const auto listen = [&](const std::string& kind) {
    const auto found = core::find_streams(
        network, core::query_for(network, "source_id", "jnd-" + kind + "-" + study_id + "-1"),
        5.0, 1);
    return found.empty() ? nullptr : core::open_own_inlet(found[0], network);
  };
  const auto samples = listen("samples");
  const auto markers = listen("markers");
  ASSERT_TRUE(samples && markers);
  ASSERT_TRUE(comes_about([&] { return amplifier->num_consumers() == 1; }));
  std::vector<core::StreamSample> sent;
  for (int i = 0; i < 100; ++i) {
    sent.push_back(core::test_sample(core::ChannelFormat::kInt16, 2, i));
    sent.back().time_s = core::stream_clock_s();
  }
  amplifier->push(sent);
  std::vector<core::StreamSample> all_samples, all_markers;
  while (child.read_line()) {
    for (auto& one : samples->take_samples()) all_samples.push_back(std::move(one));
  }
  const ProgramOutcome outcome = child.wait();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("carried by jnd itself"), std::string::npos) << outcome.err;
  ASSERT_TRUE(comes_about([&] {
    for (auto& one : samples->take_samples()) all_samples.push_back(std::move(one));
    for (auto& one : markers->take_samples()) all_markers.push_back(std::move(one));
    return samples->state() == core::StreamInlet::State::kLost &&
           markers->state() == core::StreamInlet::State::kLost;
  }));

  std::vector<std::string> kinds;
  for (const core::StreamSample& one : all_markers) {
    kinds.push_back(json::parse(one.texts[0])["what"]);
    EXPECT_EQ(one.texts[0].find("1.625"), std::string::npos);
  }
  for (const char* kind : {"medium_explored", "trial_started", "presentation_started",
                           "presentation_ended", "trial_answered", "session_completed"}) {
    EXPECT_NE(std::ranges::find(kinds, kind), kinds.end()) << kind;
  }
  ASSERT_GT(all_samples.size(), 2000U);
  EXPECT_TRUE(std::ranges::is_sorted(all_samples, {}, &core::StreamSample::time_s));

  const auto closed = events("stream_closed");
  ASSERT_EQ(events("stream_opened").size(), 3U);
  ASSERT_EQ(closed.size(), 3U);
  for (const json& one : closed) EXPECT_EQ(one["num_dropped"], 0) << one;
  const json kept =
      *std::ranges::find(closed, json("in"), [](const json& one) { return one["direction"]; });
  EXPECT_EQ(kept["num_samples"], 100);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);

  const ProgramOutcome exported = jnd({"export", "xdf", "a.study", "--out", "xdf"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_TRUE(fs::exists(path("xdf/session_0001.xdf")));

  // The file that the log names exists, and it is the same.
  const fs::path file = path("a.study/recordings") / kept["file"].get<std::string>();
  fs::remove(file);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 1);
}

TEST_F(StreamCommandTest, ASessionWithoutTheOtherRecorderGoesOnAndSaysSo) {
  const ProgramOutcome outcome =
      jnd(words({"--realtime", "--lsl-in", "name=" + core::new_stream_uid()}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(opened("a.study").completed(1));
  EXPECT_TRUE(events("stream_opened").empty());
}

TEST_F(StreamCommandTest, WhatCannotBeIsToldBeforeAnythingBegins) {
  const auto expect_refused = [this](const std::vector<std::string>& more,
                                     const std::string& words_of_it) {
    const ProgramOutcome outcome = jnd(words(more));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(words_of_it), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(path("a.study")));
  };
  expect_refused({"--lsl-out", "markers"}, "--realtime");
  expect_refused({"--realtime", "--lsl-out", "levels"}, "markers");
  expect_refused({"--realtime", "--lsl-in", "EEG"}, "type=EEG");
  expect_refused({"--realtime", "--lsl-out", "samples", "--lsl-channel", "x"}, "hand_force");
  expect_refused({"--realtime", "--lsl-out", "markers", "--lsl-library", "/nowhere.so"},
                 "/nowhere.so");
  write_file(path("short.json"),
             replaced(kShortStudy, "\"authors\"", "\"blinding\": \"double\", \"authors\""));
  expect_refused({"--realtime", "--lsl-out", "markers,samples"}, "double-blind");
}

TEST_F(StreamCommandTest, AnXdfFileHoldsWholeSessions) {
  ASSERT_EQ(jnd(words({})).exit_code, 0);
  EXPECT_EQ(jnd({"export", "xdf", "a.study", "--out", "out", "--rate-hz", "100"}).exit_code, 2);
  EXPECT_EQ(jnd({"export", "xdf", "a.study", "--out", "out", "--block", "x"}).exit_code, 2);
  const ProgramOutcome outcome = jnd({"export", "xdf", "a.study", "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(path("out/session_0001.xdf"))) << "of a simulated session, too";
}

}  // namespace stream_command_test
}  // namespace jnd::app
