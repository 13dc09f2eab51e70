#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/files.h"
#include "support/places.h"
#include "support/program.h"

// Tests the devices of device/network/reference, which a laboratory takes as templates. Each is
// a separate program that was written from device/network/README.md alone.

namespace jnd::app {
namespace reference_devices_test {

namespace fs = std::filesystem;
using test_support::ProgramOptions;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

fs::path reference(const std::string& name) {
  return test_support::source_folder() / "device/network/reference" / name;
}

bool is_installed(const std::string& program) {
  try {
    return test_support::run_program({"--version"}, {.program = program}).exit_code == 0;
  } catch (const std::exception&) {
    return false;
  }
}

/// Runs a device in one of the languages, at a port of its own.
class ReferenceDevice : public CommandTest {
 protected:
  void SetUp() override {
    options_.environment.emplace_back("XDG_CONFIG_HOME", path("config").string());
    // Nothing may be written beside the sources.
    options_.environment.emplace_back("PYTHONDONTWRITEBYTECODE", "1");
    if (!is_installed("python3")) GTEST_SKIP() << "python3 is not installed here";
  }

  [[nodiscard]] ProgramOptions other(const std::string& program) const {
    ProgramOptions options = options_;
    options.program = program;
    return options;
  }
  ProgramOutcome python(const fs::path& file, std::vector<std::string> words) const {
    words.insert(words.begin(), file.string());
    return test_support::run_program(words, other("python3"));
  }

  /// Returns false if this machine lacks what it takes.
  bool start(const std::string& language, std::vector<std::string> words = {},
             const std::string& port = "0") {
    words.insert(words.begin(), {"--port", port});
    if (language == "python") {
      words.insert(words.begin(), reference("python_device.py").string());
      device_.emplace(words, other("python3"));
    } else {
      if (!is_installed("cc")) return false;
      const ProgramOutcome compiled = test_support::run_program(
          {"-std=c11", "-O2", "-Wall", "-Wextra", "-Werror", reference("c_device.c").string(),
           "-o", path("c_device").string()},
          other("cc"));
      EXPECT_EQ(compiled.exit_code, 0) << compiled.err;
      device_.emplace(words, other(path("c_device").string()));
    }
    const std::string line = device_->read_line().value_or("");
    const std::string begin = "listening on ";
    EXPECT_TRUE(line.starts_with(begin)) << line;
    place_ = line.size() > begin.size() ? line.substr(begin.size()) : "";
    return true;
  }
  /// Draws a key and returns its file.
  std::string drawn_key() {
    const ProgramOutcome drawn = jnd({"device-key", "robot", "--json"});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    return document(drawn.out)["file"].get<std::string>();
  }
  /// Returns what `jnd device-check` finds at a device that nobody uses.
  ProgramOutcome checked(const std::string& device) { return jnd({"device-check", device}); }

  /// Writes the shipped study with fewer trials, because in real time all of them take seven
  /// minutes.
  void write_short_tour() {
    nlohmann::json tour = nlohmann::json::parse(
        std::ifstream(test_support::source_folder() / "protocols/short_tour.json"));
    for (nlohmann::json& medium : tour["stages"][0]["media"]) medium["duration_s"] = 0.5;
    tour["stages"][1]["scale"] = {1};
    tour["stages"][2]["target_percent"] = {50};
    tour["stages"][2]["coarse_step_scale"] = 4;
    tour["stages"][2]["fine_step_scale"] = 2;
    tour["stages"][3]["viscosity_pa_s"] = {3, 21};
    tour["stages"][3]["repetitions"] = 1;
    test_support::write_file(path("short_tour.json"), tour.dump());
  }
  /// Resumes until the session is over. A machine that is too busy for real time interrupts a
  /// session, and may find the connection too bad to continue at once. A wrong device would
  /// never reach the end.
  ProgramOutcome resumed(ProgramOutcome ended) {
    for (int i = 0; i < 20 && (ended.exit_code == 1 || ended.exit_code == 3); ++i) {
      ended = jnd({"resume", "tour.study", "--headless", "--realtime"});
    }
    return ended;
  }

  std::optional<RunningProgram> device_;
  std::string place_;
};

class EachReferenceDevice
    : public ReferenceDevice,
      public ::testing::WithParamInterface<std::tuple<std::string, std::string>> {
 protected:
  /// Starts the device with or without a key, and sets the words that a program needs to find
  /// it, and the file.
  bool start_with_key() {
    const auto& [language, key] = GetParam();
    std::vector<std::string> words;
    if (key == "key") {
      key_file_ = drawn_key();
      words = {"--key", key_file_};
    }
    if (!start(language, words)) return false;
    words_ = words;
    at_ = "network:" + place_ + ",simulated" + (key_file_.empty() ? "" : ",key=robot");
    return true;
  }

  /// Starts the same device at the same place.
  void start_again() {
    EXPECT_TRUE(start(std::get<0>(GetParam()), words_, place_.substr(place_.rfind(':') + 1)));
  }

  std::string at_, key_file_;
  std::vector<std::string> words_;
};

std::string name_of(const ::testing::TestParamInfo<EachReferenceDevice::ParamType>& info) {
  return std::get<0>(info.param) + "_" + std::get<1>(info.param);
}

TEST_P(EachReferenceDevice, KeepsTheRules) {
  if (!start_with_key()) GTEST_SKIP() << "cc is not installed here";
  // A busy machine may hold a device up, which then disarms as it should. A rule that is really
  // broken is broken every time.
  ProgramOutcome told = checked(at_);
  for (int i = 0; i < 2 && told.exit_code != 0; ++i) told = checked(at_);
  EXPECT_EQ(told.exit_code, 0) << told.out << told.err;
  EXPECT_NE(told.out.find(" rules kept, 0 broken, "), std::string::npos) << told.out;
}

TEST_P(EachReferenceDevice, RunsTheShortTourToItsEnd) {
  if (!start_with_key()) GTEST_SKIP() << "cc is not installed here";
  write_short_tour();

  const ProgramOutcome looped = jnd({"loop", "--device", at_, "--seconds", "0.5", "--json"});
  EXPECT_EQ(looped.exit_code, 0) << looped.err;
  const ProgramOutcome ended =
      resumed(jnd({"run", "short_tour.json", "--study", "tour.study", "--participant", "P01",
                   "--headless", "--realtime", "--seed", "7", "--device", at_}));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(opened("tour.study").completed(1));
  EXPECT_EQ(jnd({"verify", "tour.study"}).exit_code, 0);

  device_->send_signal(SIGTERM);
  const ProgramOutcome served = device_->wait();
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_NE(served.out.find("programs connected"), std::string::npos) << served.out;
}

/// The server dies in the middle of a session, as by `kill -9` or a pulled cable.
TEST_P(EachReferenceDevice, ASessionSurvivesItsDeath) {
  if (!start_with_key()) GTEST_SKIP() << "cc is not installed here";
  write_short_tour();
  RunningProgram session(
      {"run", "short_tour.json", "--study", "tour.study", "--participant", "P01", "--headless",
       "--realtime", "--seed", "7", "--acknowledge", "--device", at_},
      options_);
  int num_answers = 0;
  while (num_answers < 1) {
    const std::optional<std::string> line = session.read_line();
    if (!line) break;
    num_answers += line->find("trial_answered") != std::string::npos ? 1 : 0;
  }
  device_->send_signal(SIGKILL);
  (void)device_->wait();
  const ProgramOutcome ended = session.wait();
  EXPECT_TRUE(ended.exit_code == 1 || ended.exit_code == 3) << ended.exit_code << ended.err;
  EXPECT_NE(ended.err.find("jnd resume"), std::string::npos) << ended.err;
  EXPECT_FALSE(opened("tour.study").finished(1));
  EXPECT_GE(static_cast<int>(opened("tour.study").trials(1).size()), num_answers);
  EXPECT_EQ(jnd({"verify", "tour.study"}).exit_code, 0);

  const ProgramOutcome alone = jnd({"resume", "tour.study", "--headless", "--realtime"});
  EXPECT_EQ(alone.exit_code, 3) << "nobody is there" << alone.err;
  start_again();
  const ProgramOutcome over = resumed({.exit_code = 1});
  EXPECT_EQ(over.exit_code, 0) << over.err;
  EXPECT_TRUE(opened("tour.study").completed(1));
  EXPECT_EQ(jnd({"verify", "tour.study"}).exit_code, 0);
}

/// Each language and each way is tested once, because a session in real time takes most of a
/// minute.
INSTANTIATE_TEST_SUITE_P(Languages, EachReferenceDevice,
                         ::testing::Values(std::tuple("python", "key"),
                                           std::tuple("c", "open")),
                         name_of);

class WrongReferenceDevice : public ReferenceDevice,
                             public ::testing::WithParamInterface<std::string> {};

TEST_P(WrongReferenceDevice, IsFoundByTheCheckOfDevices) {
  ASSERT_TRUE(start("python", {"--key", drawn_key(), "--wrong", GetParam()}));
  const ProgramOutcome told = checked("network:" + place_ + ",simulated,key=robot");
  EXPECT_EQ(told.exit_code, 1) << told.err;
  EXPECT_NE(("\n" + told.out).find("\nfail  " + GetParam() + " "), std::string::npos)
      << told.out;
  EXPECT_NE(told.out.find(" to do: "), std::string::npos) << told.out;
}

INSTANTIATE_TEST_SUITE_P(Names, WrongReferenceDevice,
                         ::testing::Values("units_mm", "force_sign", "silence", "halt",
                                           "bad_key", "replay", "stale", "sequence_wrap",
                                           "sequence_step", "half_rate", "rearms",
                                           "arms_with_force", "no_limits", "echo",
                                           "told_as_sent", "slow_velocity", "acted", "points",
                                           "force_size", "description", "other_version",
                                           "datagrams", "arming", "jitter", "time", "velocity",
                                           "busy", "goodbye", "gone"),
                         [](const auto& info) { return info.param; });

TEST_F(ReferenceDevice, WhichSaysNothingOfUnknownStreamsIsFoundWithoutAKey) {
  ASSERT_TRUE(start("python", {"--wrong", "unknown_stream"}));
  const ProgramOutcome told = checked("network:" + place_ + ",simulated");
  EXPECT_EQ(told.exit_code, 1) << told.err;
  EXPECT_NE(told.out.find("\nfail  unknown_stream "), std::string::npos) << told.out;
}

/// One that a person moves: what its mistakes are is seen only then.
class FollowedReferenceDevice : public ReferenceDevice {
 protected:
  /// Its prompts go to the file that the device follows.
  ProgramOutcome checked_by_hand(const std::vector<std::string>& words) {
    std::vector<std::string> all = {"--follow", path("prompts").string()};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_TRUE(start("python", all));
    ProgramOptions options = options_;
    options.wrapper = {"sh", "-c", "exec \"$@\" 2>prompts", "sh"};
    return test_support::run_program(
        {"device-check", "network:" + place_ + ",simulated", "--by-hand", "--step-s", "1"},
        options);
  }
};

TEST_F(FollowedReferenceDevice, KeepsTheRulesOfAHand) {
  ProgramOutcome told = checked_by_hand({});
  for (int i = 0; i < 2 && told.exit_code != 0; ++i) told = checked_by_hand({});
  EXPECT_EQ(told.exit_code, 0) << told.out << test_support::read_file(path("prompts"));
  for (const char* rule : {"still", "moves", "distance", "swapped_axes", "mirrored_axes",
                           "points_order", "buttons", "gripper", "workspace"}) {
    EXPECT_NE(told.out.find("\npass  " + std::string(rule) + " "), std::string::npos)
        << rule << told.out;
  }
  EXPECT_NE(
      test_support::read_file(path("prompts"))
          .find("PROMPT right: Move it 10 cm to your right, and hold it there (1 s left)"),
      std::string::npos);
}

class WrongFollowedDevice : public FollowedReferenceDevice,
                            public ::testing::WithParamInterface<std::string> {};

TEST_P(WrongFollowedDevice, IsFoundByTheRuleOfItsName) {
  const ProgramOutcome told = checked_by_hand({"--wrong", GetParam()});
  EXPECT_EQ(told.exit_code, 1) << told.out;
  EXPECT_NE(told.out.find("\nfail  " + GetParam() + " "), std::string::npos) << told.out;
}

INSTANTIATE_TEST_SUITE_P(Names, WrongFollowedDevice,
                         ::testing::Values("still", "moves", "distance", "swapped_axes",
                                           "mirrored_axes", "points_order", "buttons",
                                           "gripper", "workspace"),
                         [](const auto& info) { return info.param; });

TEST_F(ReferenceDevice, AHandAndAPushExcludeEachOther) {
  const ProgramOutcome told =
      jnd({"device-check", "network:127.0.0.1:1,simulated", "--by-hand", "--with-force"});
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_NE(told.err.find("a hand is in the device"), std::string::npos) << told.err;
}

/// What one device says of itself, as table and as JSON.
TEST_F(ReferenceDevice, DevicesTellsWhatOneSaysOfItself) {
  ASSERT_TRUE(start("python", {"--points", "1"}));
  const ProgramOutcome told = jnd({"devices", "--device", "network:" + place_, "--json"});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const auto out = document(told.out);
  EXPECT_EQ(out["name"], "python reference");
  EXPECT_EQ(out["num_contact_points"], 1);
  EXPECT_EQ(out["share_ratio"].size(), 1U);
  EXPECT_EQ(out["share_ratio"]["palm_inner"], 1.0);
  EXPECT_EQ(out["rate_hz"], 1000.0);
  EXPECT_EQ(out["max_force_per_point_n"], 8.0);
  EXPECT_EQ(out["workspace_half_width_m"], nlohmann::json({1.0, 1.0, 1.0}));
  EXPECT_EQ(out["closed_loop_delay_s"], 0.001);
  EXPECT_TRUE(out["simulated"].get<bool>());
  EXPECT_EQ(out["lacks"], nlohmann::json({"enable_switch", "measured_force", "orientation",
                                          "torque", "gripper", "buttons"}));
  const ProgramOutcome table = jnd({"devices", "--device", "network:" + place_});
  EXPECT_NE(table.out.find("closed_loop_delay_s            0.001\n"), std::string::npos)
      << table.out;
  EXPECT_NE(table.out.find("measured_force, orientation"), std::string::npos) << table.out;
  EXPECT_EQ(jnd({"devices", "--device", "network:127.0.0.1:1"}).exit_code, 3);
}

TEST_F(ReferenceDevice, ARealDeviceIsNotPushedUnlessSomebodySaysSo) {
  ASSERT_TRUE(start("python"));
  // Unless the operator calls it simulated, it is treated as a robot.
  const ProgramOutcome told = jnd({"device-check", "network:" + place_, "--json"});
  EXPECT_EQ(told.exit_code, 0) << told.out << told.err;
  const auto out = document(told.out);
  EXPECT_FALSE(out["simulated"].get<bool>());
  EXPECT_EQ(out["num_skipped"].get<int>(), 14);
  for (const auto& rule : out["rules"]) {
    if (rule["rule"] != "halt") continue;
    EXPECT_EQ(rule["verdict"], "skip");
  }
  device_->send_signal(SIGTERM);
  const ProgramOutcome served = device_->wait();
  EXPECT_NE(served.out.find(" 0 armings"), std::string::npos) << served.out;
}

TEST_F(ReferenceDevice, NobodyThereIsASentence) {
  ASSERT_TRUE(start("python"));
  device_->send_signal(SIGTERM);
  (void)device_->wait();
  const ProgramOutcome told = jnd({"device-check", "network:" + place_ + ",simulated"});
  EXPECT_EQ(told.exit_code, 3);
  EXPECT_NE(told.err.find("expected a device that nobody uses, found no answer"),
            std::string::npos)
      << told.err;
}

TEST_F(ReferenceDevice, TheClientShowsWhatADeviceCanDoAndGivesNoForce) {
  ASSERT_TRUE(start("python", {"--points", "2"}));
  const ProgramOutcome asked = python(reference("python_client.py"), {place_, "--only-ask"});
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_NE(asked.out.find("1000 Hz, 2 contact points, 0 joints"), std::string::npos)
      << asked.out;
  const ProgramOutcome watched =
      python(reference("python_client.py"), {place_, "--seconds", "0.5", "--every-s", "0.2"});
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  EXPECT_NE(watched.out.find("not armed (0), fault none"), std::string::npos) << watched.out;
  EXPECT_EQ(watched.out.find(" armed (1)"), std::string::npos) << watched.out;

  RunningProgram simulator({"device-simulator", "--port", "0"}, options_);
  const std::string line = simulator.read_line().value_or("");
  const ProgramOutcome simulated =
      python(reference("python_client.py"),
             {line.substr(line.rfind(' ') + 1), "--seconds", "2", "--force-n", "0.1,0,0"});
  EXPECT_NE(simulated.out.find("  armed (1), fault none"), std::string::npos)
      << simulated.out << simulated.err;
}

/// Another program reads what this program writes, and refuses what this one refuses.
TEST_F(ReferenceDevice, ReadsTheExamplesOfDatagrams) {
  const std::string script =
      "import os, sys\n"
      "sys.path.insert(0, sys.argv[1])\n"
      "import jnd_datagram as jd\n"
      "for name in sorted(os.listdir(sys.argv[2])):\n"
      "    data = open(os.path.join(sys.argv[2], name), 'rb').read()\n"
      "    found = jd.unpack(data, False)\n"
      "    if found:\n"
      "        content = vars(found)\n"
      "        layout, places = jd._CONTENT[found.kind]\n"
      "        again = jd.pack(found.kind, found.stream, found.number, found.clock_ns,\n"
      "                        found.echo_ns, None, **{n: content[n] for n, _, _ in places})\n"
      "        print(name, 'same' if again == data else 'other')\n";
  test_support::write_file(path("read.py"), script);
  const ProgramOutcome read =
      python(path("read.py"),
             {reference("").string(),
              (test_support::source_folder() / "tests/fuzz/corpus/datagram").string()});
  EXPECT_EQ(read.out,
            "command.bin same\n"
            "command_of_a_wrapped_sequence.bin same\n"
            "goodbye.bin same\n"
            "halt.bin same\n"
            "hello.bin same\n"
            "order_to_stroke.bin same\n"
            "refusal_busy.bin same\n"
            "state_of_a_moving_hand.bin same\n"
            "state_of_an_open_switch.bin same\n"
            "welcome.bin same\n")
      << read.err;
}

}  // namespace reference_devices_test
}  // namespace jnd::app
