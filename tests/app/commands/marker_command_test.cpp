#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/pseudo_terminal.h"

namespace jnd::app {
namespace marker_command_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::ProgramOutcome;
using test_support::PseudoTerminal;
using ::testing::ElementsAreArray;

/// There is only one trial, because the machine has to keep up with a loop in real time.
constexpr char kPulsedStudy[] = R"json({
  "format": 1, "name": "pulsed", "languages": ["en"], "title": {"en": "Pulsed"},
  "authors": ["A. Author"], "blinding": "double",
  "markers": {"presentation": 10, "answer": 20},
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "water", "scale": [1.625], "repetitions": 1, "free_space_between_s": 0,
     "instruction": {"en": "Say."}, "question": {"en": "How strong?"}, "expected_trial_s": 5}]
})json";

class MarkerCommandTest : public CommandTest {
 protected:
  MarkerCommandTest() { write_file(path("pulsed.json"), kPulsedStudy); }
  [[nodiscard]] static std::vector<std::string> words(std::vector<std::string> more) {
    std::vector<std::string> all = {"run",           "pulsed.json", "--study",   "a.study",
                                    "--participant", "P01",         "--headless"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_F(MarkerCommandTest, ASessionSendsItsPulsesAndTheirTimesAreExported) {
  const PseudoTerminal terminal;
  const ProgramOutcome outcome =
      jnd(words({"--realtime", "--marker-port", terminal.path(), "--marker-width-ms", "2"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("jnd: markers: " + terminal.path() + ", bytes, pulses of 2 ms"),
            std::string::npos)
      << outcome.err;
  // Each code is followed by its end.
  const std::vector<unsigned char> bytes = terminal.received(1000, 200);
  std::vector<int> codes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i % 2 == 1) {
      EXPECT_EQ(bytes[i], 0) << i;
    } else {
      codes.push_back(bytes[i]);
    }
  }
  // A stimulus is presented again when the machine pauses for too long.
  const int num_presentations = num_events("a.study", 1, "presentation_started");
  ASSERT_GE(num_presentations, 1);
  std::vector<int> expected = {1, 2};
  expected.insert(expected.end(), static_cast<std::size_t>(num_presentations), 10);
  expected.insert(expected.end(), {20, 32});
  EXPECT_THAT(codes, ElementsAreArray(expected));

  ASSERT_EQ(jnd({"unblind", "a.study", "--reason", "a test"}).exit_code, 0);
  ASSERT_EQ(jnd({"export", "csv", "a.study", "--out", "csv"}).exit_code, 0);
  const std::string markers = test_support::read_file(path("csv/markers.csv"));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(markers, '\n')), codes.size() + 1);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(MarkerCommandTest, APortThatIsNotThereIsToldAndTheSessionGoesOn) {
  const ProgramOutcome outcome =
      jnd(words({"--realtime", "--marker-port", "/dev/ttyUSB_none"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("/dev/ttyUSB_none: expected a port that can be opened"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("the session goes on without them"), std::string::npos);
  EXPECT_TRUE(opened("a.study").completed(1));
}

TEST_F(MarkerCommandTest, WhatCannotBeIsToldBeforeAnythingBegins) {
  const auto expect_refused = [this](const std::vector<std::string>& more,
                                     const std::string& words_of_it) {
    const ProgramOutcome outcome = jnd(words(more));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(words_of_it), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(path("a.study")));
  };
  expect_refused({"--marker-port", "/dev/ttyUSB0"}, "add --realtime");
  expect_refused({"--realtime", "--marker-line", "rts"}, "--marker-port");
  expect_refused({"--realtime", "--marker-port", "x", "--marker-line", "cts"}, "bytes, rts");
  expect_refused({"--realtime", "--marker-port", "x", "--marker-width-ms", "1000"}, "100");
  expect_refused({"--realtime", "--marker-port", "x", "--marker-baud", "1"}, "9600");
  expect_refused({"--realtime", "--answer-port", "x"}, "leave out --headless");
}

}  // namespace marker_command_test
}  // namespace jnd::app
