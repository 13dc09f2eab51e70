#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/blind_study.h"
#include "app/commands/command_fixture.h"
#include "app/tiny_study.h"
#include "core/streams/loopback_network.h"
#include "core/streams/stream_search.h"
#include "core/streams/stream_wire.h"
#include "support/pseudo_terminal.h"

namespace jnd::app {
namespace blind_session_test {

using nlohmann::json;
using test_support::ProgramOutcome;
using test_support::PseudoTerminal;
using test_support::RunningProgram;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// Everything that left the program while a session ran.
struct Outgoing {
  std::string printed;  ///< Lines of the terminal.
  /// The description of the markers' stream, and each marker on the wire.
  std::string stream_bytes;
  std::vector<std::string> markers;  ///< Their words, without numbers and names of the session.
  std::vector<unsigned char> pulses;
};

/// Runs whole double-blind sessions of the real program, with everything at once that tells
/// others about it.
class BlindSessionTest : public CommandTest {
 protected:
  BlindSessionTest() { write_file(path("blind.json"), kBlindOrderStudy); }

  Outgoing run(int session, const std::string& participant) {
    Outgoing all;
    const PseudoTerminal terminal;
    std::jthread reader([&all, &terminal](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        for (const unsigned char byte : terminal.received(1, 50)) all.pulses.push_back(byte);
      }
    });
    RunningProgram program(
        {"run", "blind.json", "--study", "a.study", "--participant", participant, "--headless",
         "--realtime", "--acknowledge", "--seed", "7", "--lsl-out", "markers", "--lsl-peer",
         "127.0.0.1", "--marker-port", terminal.path(), "--marker-width-ms", "1"},
        options_);
    std::unique_ptr<core::StreamInlet> inlet;
    while (const auto line = program.read_line()) {
      all.printed += *line + "\n";
      if (inlet == nullptr) inlet = listen(session);
    }
    const ProgramOutcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    all.printed += outcome.out + outcome.err;
    if (inlet == nullptr) {
      ADD_FAILURE() << "nobody listened";
      return all;
    }
    EXPECT_TRUE(
        core::comes_about([&] { return inlet->state() == core::StreamInlet::State::kLost; }));
    all.stream_bytes = inlet->full_xml();
    for (const core::StreamSample& sample : inlet->take_samples()) {
      core::append_sample(all.stream_bytes, sample, core::ChannelFormat::kString);
      all.markers.push_back(anonymous(sample.texts.at(0)));
    }
    return all;
  }

  static std::string anonymous(const std::string& marker) {
    json words = json::parse(marker);
    for (const char* key : {"session", "event"}) words.erase(key);
    return words.dump();
  }

 private:
  [[nodiscard]] std::unique_ptr<core::StreamInlet> listen(int session) const {
    core::StreamNetwork network = core::loopback_network();
    network.session_id = "default";
    const std::string id =
        "jnd-markers-" + opened("a.study").study_id() + "-" + std::to_string(session);
    const auto found =
        core::find_streams(network, core::query_for(network, "source_id", id), 5.0, 1);
    return found.empty() ? nullptr : core::open_own_inlet(found[0], network);
  }
};

TEST_F(BlindSessionTest, NothingThatGoesOutTellsALevelOrWhichOrderItWas) {
  const Outgoing one = run(1, "P01"), other = run(2, "P02");
  {
    const core::StudyStore store = opened("a.study");
    ASSERT_TRUE(store.completed(1) && store.completed(2));
    ASSERT_NE(store.session(1).cells, store.session(2).cells) << "each order once";
  }
  for (const Outgoing& session : {one, other}) {
    EXPECT_THAT(told_by(session.printed), IsEmpty());
    EXPECT_THAT(told_by(session.stream_bytes), IsEmpty());
    EXPECT_NE(session.printed.find("session_completed"), std::string::npos)
        << "what is searched is whole: " << session.printed;
    EXPECT_NE(session.stream_bytes.find("session_completed"), std::string::npos);
  }
  // A recorder may have come a moment late, so only what both heard is compared.
  ASSERT_GT(std::min(one.markers.size(), other.markers.size()), 20U);
  const auto heard =
      static_cast<std::ptrdiff_t>(std::min(one.markers.size(), other.markers.size()));
  // A session that was interrupted by a pause of the machine has presented a stimulus again.
  if (num_events("a.study", 1, "fault_raised") + num_events("a.study", 2, "fault_raised") ==
      0) {
    EXPECT_EQ(std::vector(one.markers.end() - heard, one.markers.end()),
              std::vector(other.markers.end() - heard, other.markers.end()));
    EXPECT_EQ(one.pulses, other.pulses);
  }
  const std::set<int> codes(one.pulses.begin(), one.pulses.end());
  EXPECT_THAT(codes, UnorderedElementsAre(0, 1, 2, 10, 20, 32));

  // Commands that somebody may type afterwards, and some that are refused.
  std::string printed;
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"verify", "a.study"},
        {"results", "a.study"},
        {"plan", "blind.json", "--study", "a.study"},
        {"look", "a.study"},
        {"export", "csv", "a.study", "--out", "csv"},
        {"export", "xdf", "a.study", "--out", "xdf"},
        {"report", "a.study", "--out", "report"},
        {"resume", "a.study"},
        {"exclude", "a.study", "--session", "1", "--trial", "1", "--reason", "a test"}}) {
    const ProgramOutcome outcome = jnd(words);
    printed += outcome.out + outcome.err;
  }
  EXPECT_THAT(told_by(printed), IsEmpty());
  EXPECT_NE(printed.find("double-blind"), std::string::npos) << printed;
  for (const char* written : {"csv", "xdf", "report"}) {
    EXPECT_FALSE(std::filesystem::exists(path(written))) << written;
  }

  // The opposite case: now these words have to appear.
  ASSERT_EQ(jnd({"unblind", "a.study", "--reason", "done"}).exit_code, 0);
  const ProgramOutcome results = jnd({"results", "a.study"});
  EXPECT_THAT(told_by(results.out + results.err), ::testing::Not(IsEmpty()));
}

}  // namespace blind_session_test
}  // namespace jnd::app
