#include "app/session/session_pulses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/error.h"
#include "experiments/session/session_in_memory.h"
#include "support/comes_about.h"
#include "support/pseudo_terminal.h"

namespace jnd::app {
namespace session_pulses_test {

using nlohmann::json;
using test_support::comes_about;
using test_support::PseudoTerminal;
using ::testing::ElementsAre;

class SessionPulsesTest : public ::testing::Test {
 protected:
  SessionPulsesTest() { session_.start(); }

  [[nodiscard]] static core::EventRow event(std::int64_t sequence, const std::string& kind) {
    core::EventRow row;
    row.session = 3;
    row.sequence = sequence;
    row.kind = kind;
    return row;
  }
  [[nodiscard]] std::vector<json> told(const std::string& kind) const {
    std::vector<json> found;
    for (const core::EventRow& row : log_.events) {
      if (row.kind == kind) found.push_back(json::parse(row.data));
    }
    return found;
  }

  experiments::MemoryLog log_;
  core::SimulatedClock clock_;
  experiments::Session session_{{.session = 3}, {}, log_, clock_};
};

TEST_F(SessionPulsesTest, SendsTheStudysCodesAndKeepsTheTimeOfEach) {
  const PseudoTerminal terminal;
  SessionPulses pulses({.wanted = {.port = terminal.path(), .width_s = 0.001},
                        .codes = {{1, 2, 40, 80, 16, 200}}});
  const double before_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
          .count();
  pulses.tell(event(17, "presentation_started"));
  pulses.tell(event(18, "presentation_ended"));
  pulses.tell(event(19, "trial_answered"));
  EXPECT_THAT(terminal.received(4), ElementsAre(40, 0, 80, 0));
  pulses.follow(session_);
  pulses.close(session_);
  EXPECT_THAT(terminal.received(2), ElementsAre(200, 0)) << "the end";
  const auto opened = told("markers_opened");
  ASSERT_EQ(opened.size(), 1U);
  EXPECT_EQ(opened[0]["port"], terminal.path());
  EXPECT_EQ(opened[0]["way"], "bytes");
  EXPECT_EQ(opened[0]["codes"]["presentation"], 40);
  std::vector<json> all;
  for (const json& sent : told("markers_sent")) {
    for (const json& pulse : sent["pulses"]) all.push_back(pulse);
  }
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0][0], 17);
  EXPECT_EQ(all[0][1], 40);
  EXPECT_GE(all[0][2].get<double>(), before_s);
  EXPECT_LT(all[0][3].get<double>(), 1.0);
  EXPECT_EQ(all[1][0], 19);
  EXPECT_EQ(all[2][0], 0);
  EXPECT_EQ(all[2][1], 200);
  const auto closed = told("markers_closed");
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_EQ(closed[0]["num_sent"], 3);
  EXPECT_EQ(closed[0]["num_dropped"], 0);
  pulses.close(session_);
  EXPECT_EQ(told("markers_closed").size(), 1U) << "once";
  pulses.tell(event(30, "trial_answered"));
  EXPECT_TRUE(terminal.received(1, 50).empty()) << "nothing comes after the end";
}

TEST_F(SessionPulsesTest, AKindWithTheCodeNoughtHasNoPulse) {
  const PseudoTerminal terminal;
  SessionPulses pulses(
      {.wanted = {.port = terminal.path(), .width_s = 0.0}, .codes = {{0, 0, 7, 0, 0, 0}}});
  for (const char* kind : {"stage_entered", "trial_started", "presentation_started",
                           "trial_answered", "fault_raised"}) {
    pulses.tell(event(1, kind));
  }
  pulses.close(session_);
  EXPECT_THAT(terminal.received(2, 50), ElementsAre(7));
}

TEST_F(SessionPulsesTest, APortThatFailsIsToldOnceAndNeverStopsTheSession) {
  SessionPulses pulses({.wanted = {.port = "/dev/ttyUSB_none"}});
  EXPECT_EQ(pulses.problem(), "");
  ASSERT_TRUE(comes_about([&] {
    pulses.tell(event(1, "trial_started"));
    pulses.follow(session_);
    return !pulses.problem().empty();
  }));
  for (int i = 0; i < 10; ++i) {
    pulses.tell(event(2 + i, "trial_started"));
    pulses.follow(session_);
  }
  pulses.close(session_);
  const auto failed = told("markers_failed");
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0]["port"], "/dev/ttyUSB_none");
  EXPECT_NE(failed[0]["problem"].get<std::string>().find("No such file"), std::string::npos);
  EXPECT_TRUE(told("markers_opened").empty());
  EXPECT_EQ(told("markers_closed")[0]["num_sent"], 0);
  EXPECT_GE(told("markers_closed")[0]["num_dropped"], 11);
}

TEST_F(SessionPulsesTest, ACableThatIsPulledInBetweenIsTold) {
  PseudoTerminal terminal;
  SessionPulses pulses({.wanted = {.port = terminal.path(), .width_s = 0.0}});
  pulses.tell(event(1, "trial_started"));
  EXPECT_THAT(terminal.received(1), ElementsAre(2));
  terminal.unplug();
  pulses.tell(event(2, "trial_answered"));
  ASSERT_TRUE(comes_about([&] {
    pulses.follow(session_);
    return !pulses.problem().empty();
  }));
  pulses.close(session_);
  EXPECT_EQ(told("markers_sent").size(), 1U);
  EXPECT_EQ(told("markers_failed").size(), 1U);
  EXPECT_EQ(told("markers_closed")[0]["num_sent"], 1);
}

// Two sessions that differ in every stimulus and every answer send the same bytes.
TEST_F(SessionPulsesTest, TellsWhoIsBlindNothing) {
  std::vector<std::vector<unsigned char>> sent;
  for (const double level : {1.0, 1.9}) {
    const PseudoTerminal terminal;
    SessionPulses pulses({.wanted = {.port = terminal.path(), .width_s = 0.0}});
    std::int64_t sequence = 1;
    for (const char* kind : {"stage_entered", "trial_started", "presentation_started",
                             "presentation_ended", "presentation_started", "trial_answered"}) {
      core::EventRow row = event(sequence++, kind);
      row.intensity = level;
      row.data = level > 1.5 ? R"({"interval":"test","response":1.0})"
                             : R"({"interval":"reference","response":0.0})";
      pulses.tell(row);
    }
    pulses.close(session_);
    sent.push_back(terminal.received(7, 200));
  }
  EXPECT_EQ(sent[0], sent[1]);
  EXPECT_THAT(sent[0], ElementsAre(1, 2, 4, 4, 8, 32));
}

}  // namespace session_pulses_test
}  // namespace jnd::app
