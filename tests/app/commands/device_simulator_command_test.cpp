#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "device/registry/device_registry.h"
#include "device/simulated_hand.h"
#include "support/program.h"

namespace jnd::app {
namespace device_simulator_command_test {

using test_support::ProgramOutcome;
using test_support::RunningProgram;

/// The study has two trials, which take some ten seconds of real time.
const std::string kShortStudy = R"json({
  "format": 1,
  "name": "short",
  "languages": ["en"],
  "title": {"en": "Short"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "explore", "name": "free", "instruction": {"en": "Move."},
     "media": [{"medium": "free_space", "duration_s": 0.5}]},
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "water", "scale": [1, 2], "repetitions": 1, "free_space_between_s": 0,
     "instruction": {"en": "Say."}, "question": {"en": "How strong?"}, "expected_trial_s": 5}
  ]
})json";

class DeviceSimulatorTest : public CommandTest {
 protected:
  void SetUp() override { write_file(temporary_.path() / "short.json", kShortStudy); }

  /// Starts a simulator at this port and waits until it listens. Returns its address.
  std::string start(const std::string& port = "0", const std::string& device = "lumped",
                    const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"device-simulator", "--port", port, "--device",
                                          device};
    arguments.insert(arguments.end(), more.begin(), more.end());
    simulator_.emplace(arguments, options_);
    const std::string line = simulator_->read_line().value_or("");
    const std::string words = "listening on ";
    EXPECT_TRUE(line.starts_with(words)) << line;
    return line.size() > words.size() ? line.substr(words.size()) : "";
  }
  static std::string port_of(const std::string& place) {
    return place.substr(place.rfind(':') + 1);
  }
  static std::vector<std::string> run_words(const std::string& place) {
    return {"run",          "short.json",    "--study",
            "short.study",  "--participant", "P01",
            "--headless",   "--device",      "network:" + place + ",simulated",
            "--realtime",   "--seed",        "7",
            "--acknowledge"};
  }
  [[nodiscard]] core::StudyStore opened() const {
    return {temporary_.path() / "short.study", core::StudyStore::Mode::kReadOnly};
  }

  std::optional<RunningProgram> simulator_;
};

TEST_F(DeviceSimulatorTest, ServesTheLoopAndCountsWhatCame) {
  const std::string place = start();
  EXPECT_TRUE(place.starts_with("127.0.0.1:")) << place;
  const ProgramOutcome loop =
      jnd({"loop", "--device", "network:" + place + ",simulated", "--seconds", "1", "--json"});
  EXPECT_EQ(loop.exit_code, 0) << loop.err;
  EXPECT_GT(document(loop.out)["num_ticks"], 900);
  simulator_->send_signal(SIGTERM);
  const ProgramOutcome served = simulator_->wait();
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_NE(served.out.find("1 programs connected"), std::string::npos) << served.out;
}

TEST_F(DeviceSimulatorTest, EachProgramFindsTheDeviceAsItWasAtTheStart) {
  const std::unique_ptr<device::HapticDevice> device =
      device::make_device("network:" + start() + ",simulated", 1000.0);
  core::HapticState state;
  device->open();
  ASSERT_TRUE(device->read(state));
  const Eigen::Vector3d home_m = state.tip_position_m[0];
  device->simulated_hand()->begin_strokes({}, core::RandomStream(1, "strokes"));
  for (int i = 0; i < 10'000 && (state.tip_position_m[0] - home_m).norm() < 0.05; ++i) {
    (void)device->write(core::zero_vectors());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    (void)device->read(state);
  }
  ASSERT_GE((state.tip_position_m[0] - home_m).norm(), 0.05);
  device->close();
  device->open();
  ASSERT_TRUE(device->read(state));
  EXPECT_EQ(state.tip_position_m[0], home_m) << "it was not brought home, it starts there";
}

TEST_F(DeviceSimulatorTest, EndsByItselfWithOneJsonDocument) {
  const ProgramOutcome outcome =
      jnd({"device-simulator", "--port", "0", "--seconds", "0.2", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("listening on 127.0.0.1:"), std::string::npos);
  const auto json = document(outcome.out);
  EXPECT_GT(json["num_steps"], 50);
  EXPECT_EQ(json["num_clients"], 0);
  EXPECT_EQ(json["last_fault"], "none");
  EXPECT_EQ(keys(json["link"]), (std::set<std::string>{"received", "lost", "late", "doubled",
                                                       "reordered", "refused"}));
}

TEST_F(DeviceSimulatorTest, ItsWordThatNobodyCanBeHurtIsNotEnough) {
  const std::string place = start();
  const ProgramOutcome silent =
      jnd({"loop", "--device", "network:" + place, "--seconds", "0.2"});
  EXPECT_NE(silent.exit_code, 0);
  EXPECT_NE(silent.err.find(place + ",simulated"), std::string::npos) << silent.err;
  EXPECT_EQ(sentence_flaw(silent.err), "");
  const ProgramOutcome other =
      jnd({"loop", "--device", "network:" + place + ",quick", "--seconds", "0.2"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(sentence_flaw(other.err), "");
}

TEST_F(DeviceSimulatorTest, AKeyIsSharedByBothSides) {
  options_.environment.emplace_back("XDG_CONFIG_HOME", temporary_.path().string());
  const ProgramOutcome drawn = jnd({"device-key", "robot", "--json"});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_TRUE(std::filesystem::exists(document(drawn.out)["file"].get<std::string>()));
  const ProgramOutcome again = jnd({"device-key", "robot"});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_EQ(sentence_flaw(again.err), "");
  EXPECT_EQ(jnd({"device-key", "../robot"}).exit_code, 2);

  const std::string place = start("0", "lumped", {"--key", "robot"});
  const auto loop = [&](const std::string& with) {
    return jnd({"loop", "--device", "network:" + place + with, "--seconds", "0.5", "--json"});
  };
  EXPECT_EQ(loop(",simulated,key=robot").exit_code, 0);
  const ProgramOutcome without = loop(",simulated");
  EXPECT_NE(without.err.find("key=NAME"), std::string::npos) << without.err;
  EXPECT_NE(without.exit_code, 0);
  EXPECT_NE(loop(",simulated,key=unknown").err.find("jnd device-key unknown"),
            std::string::npos);
}

TEST_F(DeviceSimulatorTest, AnAddressThatOthersReachNeedsAKey) {
  const ProgramOutcome open =
      jnd({"device-simulator", "--port", "0", "--listen", "0.0.0.0", "--seconds", "0.1"});
  EXPECT_EQ(open.exit_code, 2);
  EXPECT_NE(open.err.find("--key NAME"), std::string::npos) << open.err;
  EXPECT_EQ(sentence_flaw(open.err), "");
}

TEST_F(DeviceSimulatorTest, AHostThatIsNotAllowedIsNotAnswered) {
  const std::string place = start("0", "lumped", {"--allow", "192.0.2.1"});
  const ProgramOutcome refused =
      jnd({"loop", "--device", "network:" + place + ",simulated", "--seconds", "0.2"});
  EXPECT_NE(refused.err.find("expected a device to answer"), std::string::npos) << refused.err;
  simulator_->send_signal(SIGTERM);
  const ProgramOutcome served = simulator_->wait();
  EXPECT_NE(served.out.find("0 programs connected"), std::string::npos) << served.out;
  EXPECT_EQ(served.out.find(" 0 from hosts that are not allowed"), std::string::npos)
      << served.out;
}

TEST_F(DeviceSimulatorTest, WrongArgumentsAreToldInOneSentence) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--port", "65536"},
                                                {"--device", "phantom"},
                                                {"--device", "unplugged:1"},
                                                {"--rate-hz", "0"},
                                                {"--rate-hz", "nan"},
                                                {"--seconds", "-1"}}) {
    std::vector<std::string> all = {"device-simulator"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramOutcome outcome = jnd(all);
    EXPECT_EQ(outcome.exit_code, 2) << words[0] << " " << words[1];
    EXPECT_EQ(sentence_flaw(outcome.err), "");
  }
}

TEST_F(DeviceSimulatorTest, APortThatIsTakenIsALackOfThisMachine) {
  const std::string place = start();
  const ProgramOutcome second = jnd({"device-simulator", "--port", port_of(place)});
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_NE(second.err.find(place), std::string::npos) << second.err;
}

TEST_F(DeviceSimulatorTest, NobodyThereIsToldInOneSentence) {
  const ProgramOutcome outcome = jnd(run_words("127.0.0.1:1"));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("expected a device to answer, found none"), std::string::npos)
      << outcome.err;
}

/// In this test of real processes, the device dies in the middle of a session and comes back,
/// and the session continues to its end.
TEST_F(DeviceSimulatorTest, ASessionSurvivesTheDevicesDeathAndRestart) {
  const std::string place = start();
  RunningProgram session(run_words(place), options_);
  int num_events = 0;
  while (const std::optional<std::string> line = session.read_line()) {
    ++num_events;
    if (line->find("presentation_started") != std::string::npos) break;
  }
  ASSERT_GT(num_events, 2);
  simulator_->send_signal(SIGKILL);
  (void)simulator_->wait();
  const ProgramOutcome ended = session.wait();
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("connection to the device"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("jnd resume"), std::string::npos) << ended.err;
  EXPECT_FALSE(opened().finished(1));
  EXPECT_EQ(jnd({"verify", "short.study"}).exit_code, 0);

  const ProgramOutcome at_once =
      jnd({"resume", "short.study", "--headless", "--realtime", "--wait-s", "0"});
  EXPECT_EQ(at_once.exit_code, 3) << at_once.err;
  EXPECT_EQ(sentence_flaw(at_once.err), "");

  RunningProgram resuming({"resume", "short.study", "--headless", "--realtime"}, options_);
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_FALSE(resuming.has_ended()) << "it waits for the device";
  EXPECT_EQ(start(port_of(place)), place);
  const ProgramOutcome resumed = resuming.wait();
  EXPECT_NE(resumed.err.find("waiting for the device"), std::string::npos) << resumed.err;
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_TRUE(opened().completed(1));
  EXPECT_EQ(jnd({"verify", "short.study"}).exit_code, 0);
}

}  // namespace device_simulator_command_test
}  // namespace jnd::app
