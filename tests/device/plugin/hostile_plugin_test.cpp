#include <sys/wait.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/haptic_loop.h"
#include "device/plugin/plugin_device.h"
#include "plugin_fixture.h"

namespace jnd::device {
namespace hostile_plugin_test {

using core::Fault;

/// If a driver does not load, describe or open, the program says so in one sentence.
class HostilePluginTest : public PluginTest {
 protected:
  static void expect_refused(const std::string& argument, const std::string& words) {
    const std::string said = why_not(argument);
    EXPECT_TRUE(said.starts_with("device plugin ")) << argument << ": " << said;
    EXPECT_NE(said.find(words), std::string::npos) << argument << ": " << said;
    EXPECT_NE(said.find("expected"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }

  /// Ticks a loop in which a force acts until the loop has a fault. Each tick is no longer than
  /// a driver may keep it.
  Fault fault_of(HapticDevice& device, int most_ticks = 3000) {
    core::LatestValue<core::HapticCommand> commands;
    core::LatestValue<core::Telemetry> telemetry;
    core::EmergencyStop stop;
    HapticLoop loop({.starts_armed = true}, device, {commands, telemetry, stop});
    commands.publish(
        {.sequence = 1, .medium = core::viscous({.viscosity_pa_s = 5.0}), .ramp_s = 0.0});
    for (int i = 0; i < most_ticks; ++i) {
      loop.tick();
      telemetry.fetch();
      const core::Telemetry& now = telemetry.value();
      if (now.fault != Fault::kNone) {
        EXPECT_EQ(now.total_force_n, (core::PlainVector{0.0, 0.0, 0.0}));
        return now.fault;
      }
      if (device.capabilities().has_own_clock) pause_ms(1);
    }
    return Fault::kNone;
  }
};

TEST_F(HostilePluginTest, WhatIsNoDriverIsToldInASentence) {
  expect_refused("/nowhere/hand.so:simulated", "found no such file");
  expect_refused("hand_that_is_nowhere:simulated", "found none of this name");
  expect_refused(example_source().string() + ":simulated", "expected the shared object");
  expect_refused(hostile("WRONG_ABI").string() + ":simulated",
                 "expected a driver of ABI version 1, found version 42");
  expect_refused(hostile("LACKS_CLOSE").string() + ":simulated",
                 "with the function jnd_device_close, found none");
}

TEST_F(HostilePluginTest, OneThatCrashesOrHangsBeforeItIsOpenIsToldInASentence) {
  expect_refused(hostile("ABORTS_IN_LOAD").string() + ":simulated", "while loading it");
  expect_refused(troubled("crash_in_describe"), "while loading it");
  expect_refused(troubled("crash_in_open"), "while opening its device");
  expect_refused(troubled("exit_in_open"), "ended by itself (exit code 7)");
  expect_refused(troubled("hang_in_open"), "with opening its device within 0.3 s");
  expect_refused(troubled("fail_in_open"),
                 "found: the emergency stop of the \"robot\" is pressed");
  expect_refused(troubled("fail_in_describe"), "to describe its device, found: the emergency");
  expect_refused(troubled("changes_its_mind"), "described alike");
}

TEST_F(HostilePluginTest, OneThatNeverDescribesItselfIsGivenUp) {
  try {
    PluginDevice device({.process = {.host = test_support::device_host_file(),
                                     .driver = hostile(),
                                     .options = "trouble=hang_in_describe",
                                     .place = "device plugin",
                                     .load_patience_s = 0.3}});
    FAIL() << "described";
  } catch (const DeviceUnreachable& error) {
    EXPECT_NE(std::string(error.what()).find("loading it within 0.3 s"), std::string::npos)
        << error.what();
  }
}

TEST_F(HostilePluginTest, NumbersThatNoDeviceHasAreNamed) {
  expect_refused(troubled("nine_points"), "contact_point_bits: expected 1 to 31");
  expect_refused(troubled("no_limit"), "max_force_per_point_n: expected");
  expect_refused(troubled("other_shares"), "area_share_ratio: expected numbers that sum to 1");
  expect_refused(troubled("no_limit"), "; mend it in jnd_device_describe");
  expect_refused(troubled("changes_its_mind"),
                 "max_force_per_point_n differs; tell the same in jnd_device_describe");
}

TEST_F(HostilePluginTest, AnOpeningThatSaysNothingOfItsFailureIsNamed) {
  expect_refused(troubled("fail_in_open_without_words"), "jnd_device_error says nothing");
  expect_refused(troubled("opens_nothing"), "set *device before it returns");
  expect_refused(troubled("answers_42"),
                 "expected JND_DEVICE_OK or JND_DEVICE_FAILED, found 42");
}

TEST_F(HostilePluginTest, WhichFieldOfAMeasurementIsWrongIsSaid) {
  for (const auto& [trouble, words] :
       {std::pair("nan", "velocity_m_per_s holds a number that is not finite"),
        std::pair("sixth_point",
                  "attached_bits has a point that contact_point_bits has not")}) {
    const auto device = opened(troubled(trouble, ",after=20"));
    EXPECT_TRUE(comes_to([&, words = std::string(words)] {
      core::HapticState state;
      (void)device->read(state);
      (void)device->write(core::zero_vectors());
      return device->words_of_fault().find(words) != std::string::npos;
    })) << trouble
        << device->words_of_fault();
  }
}

TEST_F(HostilePluginTest, HowTheProcessOfADriverEndedIsSaid) {
  const auto device = opened(troubled("crash_in_read", ",after=20"));
  EXPECT_TRUE(comes_to([&] {
    core::HapticState state;
    (void)device->read(state);
    return device->words_of_fault().starts_with("its process crashed (");
  })) << device->words_of_fault();
}

TEST_F(HostilePluginTest, OneThatDoesNotAnswerAnyMoreSaysSo) {
  for (const auto& [trouble, words] :
       {std::pair("hang_in_read", "its process has not answered the last "),
        std::pair("crash_in_read", "its process crashed (")}) {
    const auto device = opened(own_clock(trouble, "simulated") + ",after=20");
    EXPECT_TRUE(device->answers()) << trouble;
    EXPECT_TRUE(comes_to([&, words = std::string(words)] {
      core::HapticState state;
      (void)device->read(state);
      return !device->answers() && device->words_of_fault().starts_with(words);
    })) << trouble
        << device->words_of_fault();
  }
}

TEST_F(HostilePluginTest, TheFirstReadHasToBringAMeasurement) {
  const auto device = opened(troubled("no_sample"));
  core::HapticState state;
  EXPECT_FALSE(device->read(state));
  EXPECT_NE(device->words_of_fault().find("the first jnd_device_read found no measurement"),
            std::string::npos)
      << device->words_of_fault();
}

TEST_F(HostilePluginTest, WhatADriverSaysOfItsFailureIsKept) {
  for (const char* trouble : {"fail_in_read", "fail_in_write"}) {
    const auto device = opened(troubled(trouble, ",after=20"));
    EXPECT_EQ(device->words_of_fault(), "") << trouble;
    (void)fault_of(*device);
    EXPECT_TRUE(comes_to([&] {
      core::HapticState state;
      (void)device->read(state);
      return device->words_of_fault() == "the emergency stop of the \"robot\" is pressed";
    })) << trouble;
  }
}

TEST_F(HostilePluginTest, OneThatDiesOrHangsInASimulationIsAFault) {
  for (const char* trouble :
       {"crash_in_read", "exit_in_read", "hang_in_read", "fail_in_read"}) {
    const auto device = opened(troubled(trouble, ",after=100"));
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(fault_of(*device), Fault::kDeviceReadFailed) << trouble;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
    EXPECT_FALSE(device->may_arm()) << trouble;
  }
}

TEST_F(HostilePluginTest, OneThatDiesOrHangsAtItsOwnPaceIsAFaultAndHoldsNobodyUp) {
  for (const char* trouble : {"crash_in_read", "exit_in_read", "hang_in_read"}) {
    const auto device = opened(own_clock(trouble + std::string(",after=50"), "simulated"));
    const Fault found = fault_of(*device);
    EXPECT_TRUE(found == Fault::kStaleSample || found == Fault::kDeviceReadFailed)
        << trouble << ": " << core::name(found);
    EXPECT_FALSE(device->may_arm()) << trouble;
    // The driver must not take the loop's time: a thousand ticks without it take next to no
    // time.
    const auto begin = std::chrono::steady_clock::now();
    core::HapticState state;
    for (int i = 0; i < 1000; ++i) {
      (void)device->read(state);
      (void)device->write(core::zero_vectors());
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(400))
        << trouble;
  }
}

TEST_F(HostilePluginTest, OneThatIsStoppedIsAFaultAndBringsNoOldForceBack) {
  const auto device = opened(own_clock("none", "real"));
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] {
    (void)device->read(state);
    (void)device->write(pushed(1.0));
    return motors().force_n == 1.0;
  }));
  const pid_t process = dynamic_cast<PluginDevice&>(*device).process();
  ASSERT_EQ(::kill(process, SIGSTOP), 0);
  ASSERT_TRUE(comes_to([&] { return !device->read(state); }));
  EXPECT_EQ(device->fault(), Fault::kDeviceReadFailed);
  // The command that was written while the driver was stopped waits for it, and is too old when
  // it goes on.
  (void)device->write(pushed(3.0));
  pause_ms(50);
  ASSERT_EQ(::kill(process, SIGCONT), 0);
  EXPECT_TRUE(comes_to([] { return motors().force_n == 0.0; }));
  for (int i = 0; i < 20; ++i) {
    EXPECT_NE(motors().force_n, 3.0);
    pause_ms(1);
  }
  EXPECT_TRUE(comes_to([&] {
    (void)device->write(core::zero_vectors());
    return device->read(state) && device->may_arm();
  })) << "it answers again";
}

TEST_F(HostilePluginTest, OneThatIsKilledIsAFaultAndTheNextOpeningStartsAnother) {
  const auto device = opened(example().string() + ":simulated");
  core::HapticState state;
  ASSERT_TRUE(device->read(state));
  ASSERT_EQ(::kill(dynamic_cast<PluginDevice&>(*device).process(), SIGKILL), 0);
  EXPECT_FALSE(device->read(state) && device->write(pushed(0.0)) && device->read(state));
  EXPECT_EQ(device->fault(), Fault::kDeviceReadFailed);
  device->open();
  EXPECT_TRUE(device->read(state));
}

TEST_F(HostilePluginTest, MeasurementsThatAreNoneAreFaults) {
  const std::vector<std::pair<std::string, Fault>> faults = {
      {"nan", Fault::kNonFiniteState},    {"sixth_point", Fault::kDeviceReadFailed},
      {"jump", Fault::kPositionJump},     {"old_number", Fault::kStaleSample},
      {"time_back", Fault::kStaleSample}, {"no_sample", Fault::kStaleSample},
      {"half_rate", Fault::kStaleSample}, {"fail_in_write", Fault::kDeviceWriteFailed},
  };
  for (const auto& [trouble, fault] : faults) {
    for (const char* place : {"", ",in-process"}) {
      // Within this process nobody counts how many measurements are missing.
      if (trouble == "half_rate" && place[0] != '\0') continue;
      const auto device = opened(troubled(trouble, place + std::string(",after=100")));
      EXPECT_EQ(fault_of(*device), fault) << trouble << place;
    }
  }
}

TEST_F(HostilePluginTest, OneThatDoesNotCloseIsEnded) {
  PluginDevice device({.process = {.host = test_support::device_host_file(),
                                   .driver = hostile(),
                                   .options = "trouble=hang_in_close",
                                   .place = "device plugin",
                                   .close_patience_s = 0.2},
                       .believes_simulated = true});
  device.open();
  const pid_t process = device.process();
  device.close();
  EXPECT_EQ(::kill(process, 0), -1) << "it is still there";
}

/// A broken driver may have written anything into the page that is its own.
TEST_F(HostilePluginTest, NonsenseInItsPageIsAFaultAndNothingElse) {
  jnd_device_description description{};
  description.contact_point_bits = 1;
  core::HapticState state;
  for (int byte = 0; byte < 256; ++byte) {
    jnd_device_state measured;
    std::memset(static_cast<void*>(&measured), byte, sizeof measured);
    const Fault found = checked_state(description, measured, state);
    EXPECT_EQ(found == Fault::kNone, byte == 0) << byte;
  }
}

}  // namespace hostile_plugin_test
}  // namespace jnd::device
