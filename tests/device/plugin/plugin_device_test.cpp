#include "device/plugin/plugin_device.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <vector>

#include "plugin_fixture.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace plugin_device_test {

using core::Fault;

class PluginDeviceTest : public PluginTest {};

/// Returns the states of a hand that a viscous force holds back.
std::vector<core::HapticState> strokes(HapticDevice& device, int num_ticks) {
  std::vector<core::HapticState> states;
  for (int i = 0; i < num_ticks; ++i) {
    core::HapticState state;
    EXPECT_TRUE(device.read(state));
    core::PointVectors force_n = core::zero_vectors();
    force_n[0] = -20.0 * state.tip_velocity_m_per_s[0];
    EXPECT_TRUE(device.write(force_n));
    states.push_back(state);
  }
  return states;
}

TEST_F(PluginDeviceTest, AnOutsidersDriverMovesAHandAndFeelsTheForce) {
  const auto device = opened(example().string() + ":simulated");
  const DeviceCapabilities can = device->capabilities();
  EXPECT_TRUE(can.simulated && can.moves_by_itself && can.tells_acting_force);
  EXPECT_FALSE(can.has_own_clock);
  EXPECT_EQ(can.num_contact_points(), 1);
  EXPECT_EQ(can.max_force_per_point_n, 30.0);
  EXPECT_EQ(can.max_slew_n_per_s, 2000.0);
  EXPECT_EQ(can.max_speed_m_per_s, 5.0);
  EXPECT_EQ(can.workspace.half_width_y_m, 1.0);
  double most_left_m = 0.0, most_right_m = 0.0, most_opposed_n = 0.0;
  std::int64_t last_ns = 0;
  for (const core::HapticState& state : strokes(*device, 2500)) {
    most_left_m = std::min(most_left_m, state.tip_position_m[0].x());
    most_right_m = std::max(most_right_m, state.tip_position_m[0].x());
    most_opposed_n = std::max(
        most_opposed_n, -state.acted_n[0].dot(state.tip_velocity_m_per_s[0].normalized()));
    EXPECT_TRUE(state.attached[0] && !state.attached[1]);
    EXPECT_GT(state.device_time_ns, last_ns);
    last_ns = state.device_time_ns;
  }
  EXPECT_LT(most_left_m, -0.13);
  EXPECT_GT(most_right_m, 0.13);
  EXPECT_GT(most_opposed_n, 5.0);
}

TEST_F(PluginDeviceTest, AProcessOfItsOwnChangesNoNumber) {
  const auto apart = opened(example().string() + ":simulated,mass=0.7");
  const auto within = opened(example().string() + ":simulated,in-process,mass=0.7");
  const std::vector<core::HapticState> one = strokes(*apart, 1500);
  const std::vector<core::HapticState> other = strokes(*within, 1500);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].tip_position_m[0], other[i].tip_position_m[0]) << "tick " << i;
    ASSERT_EQ(one[i].acted_n[0], other[i].acted_n[0]) << "tick " << i;
    ASSERT_EQ(one[i].device_time_ns, other[i].device_time_ns) << "tick " << i;
  }
}

TEST_F(PluginDeviceTest, OpenedAgainItBeginsAnew) {
  const auto device = opened(example().string() + ":simulated");
  const std::vector<core::HapticState> first = strokes(*device, 50);
  device->close();
  core::HapticState state;
  EXPECT_FALSE(device->read(state));
  EXPECT_FALSE(device->write(pushed(1.0)));
  EXPECT_FALSE(device->may_arm());
  device->open();
  EXPECT_EQ(strokes(*device, 50).back().tip_position_m[0], first.back().tip_position_m[0]);
  EXPECT_TRUE(device->may_arm());
}

TEST_F(PluginDeviceTest, ItsTickTakesNoHeap) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const auto device = opened(example().string() + ":simulated");
  (void)strokes(*device, 10);
  core::HapticState state;
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 200; ++i) {
    (void)device->read(state);
    (void)device->write(pushed(0.1));
  }
  device->halt();
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_EQ(counter.frees(), 0U);
}

TEST_F(PluginDeviceTest, AForceThatIsNoNumberReachesNoDriver) {
  const auto device = opened(own_clock("none", "simulated"));
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] { return device->read(state); }));
  EXPECT_TRUE(device->write(pushed(1.0)));
  ASSERT_TRUE(comes_to([] { return motors().force_n == 1.0; }));
  EXPECT_FALSE(device->write(pushed(std::nan(""))));
  EXPECT_EQ(device->fault(), Fault::kNonFiniteForce);
  pause_ms(5);
  EXPECT_TRUE(motors().force_n == 1.0 || motors().force_n == 0.0);
}

TEST_F(PluginDeviceTest, NoForceIsAboveWhatTheDriverDescribesNorFasterThanItsSlew) {
  const auto device = opened(own_clock("none", "simulated"));
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] { return device->read(state); }));
  (void)device->write(pushed(1000.0));
  ASSERT_TRUE(comes_to([] { return motors().force_n > 0.0; }));
  EXPECT_LE(motors().force_n, 2.0) << "of one millisecond";
  for (int i = 0; i < 50; ++i) {
    (void)device->read(state);
    (void)device->write(pushed(1000.0));
    EXPECT_LE(motors().force_n, 10.0);
    pause_ms(1);
  }
}

TEST_F(PluginDeviceTest, AHaltEndsTheForceAtOnceAndZerosAloneBringItBack) {
  const auto device = opened(own_clock("none", "simulated"));
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] { return device->read(state); }));
  const auto becomes = [&](double force_n, double asked_n) {
    return comes_to([&] {
      (void)device->read(state);
      (void)device->write(pushed(asked_n));
      return motors().force_n == force_n;
    });
  };
  ASSERT_TRUE(becomes(1.0, 1.0));
  device->halt();
  ASSERT_TRUE(comes_to([] { return motors().force_n == 0.0; }));
  for (int i = 0; i < 20; ++i) {
    (void)device->write(pushed(1.0));
    EXPECT_EQ(motors().force_n, 0.0);
    (void)device->read(state);
    pause_ms(1);
  }
  EXPECT_FALSE(device->write(pushed(1.0))) << "the loop has to know that there is no force";
  EXPECT_EQ(device->fault(), Fault::kWatchdog);
  ASSERT_TRUE(becomes(0.0, 0.0));
  (void)device->write(pushed(0.0));
  pause_ms(20);
  EXPECT_TRUE(becomes(1.0, 1.0));
}

TEST_F(PluginDeviceTest, AHaltReachesADeviceWhoseDriverIsStuck) {
  const auto device = opened(own_clock("hang_in_read,after=1", "simulated"));
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] { return device->read(state); }));
  (void)device->write(pushed(1.0));
  ASSERT_TRUE(comes_to([] { return motors().force_n == 1.0; }));
  (void)device->read(state);  // The process never comes back from this call.
  device->halt();
  EXPECT_TRUE(comes_to([] { return motors().force_n == 0.0; }));
}

TEST_F(PluginDeviceTest, ForcesEndByThemselvesWhenCommandsDo) {
  const auto device = opened(own_clock("none"));
  ASSERT_FALSE(device->capabilities().simulated);
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] {
    (void)device->read(state);
    (void)device->write(pushed(1.0));
    return motors().force_n == 1.0;
  }));
  // Nobody sends anything any more. The force ends after 20 ms and the machine's own delay.
  EXPECT_TRUE(comes_to([] { return motors().force_n == 0.0 && motors().num_halts > 0.0; }));
}

TEST_F(PluginDeviceTest, ForcesEndAndTheProcessGoesWhenTheProgramDies) {
  const std::string argument = own_clock("none", "simulated");
  int told[2] = {-1, -1};
  ASSERT_EQ(::pipe(told), 0);
  const pid_t program = ::fork();
  if (program == 0) {
    const auto device = opened(argument);
    core::HapticState state;
    if (!comes_to([&] {
          (void)device->read(state);
          (void)device->write(pushed(1.0));
          return motors().force_n == 1.0;
        })) {
      ::_exit(1);
    }
    const pid_t host = dynamic_cast<PluginDevice&>(*device).process();
    if (::write(told[1], &host, sizeof host) < 0) ::_exit(1);
    ::kill(::getpid(), SIGKILL);
  }
  ::close(told[1]);
  pid_t host = -1;
  ASSERT_EQ(::read(told[0], &host, sizeof host), static_cast<ssize_t>(sizeof host));
  ASSERT_GT(host, 0);
  (void)::waitpid(program, nullptr, 0);
  EXPECT_TRUE(comes_to([] { return motors().force_n == 0.0 && motors().num_halts > 0.0; }));
  EXPECT_TRUE(comes_to([&] {
    // A process whose end nobody has collected stays as a zombie.
    std::ifstream status("/proc/" + std::to_string(host) + "/stat");
    std::string line;
    return !std::getline(status, line) || line.find(") Z ") != std::string::npos;
  }));
  ::close(told[0]);
}

TEST_F(PluginDeviceTest, ItsWordThatNobodyCanBeHurtIsNotEnough) {
  try {
    (void)make_plugin_device(example().string(), 1000.0);
    FAIL() << "believed";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find(":simulated if that is true"), std::string::npos)
        << error.what();
  }
  const auto real = make_plugin_device(example().string() + ":real", 1000.0);
  EXPECT_FALSE(real->capabilities().simulated);
  EXPECT_TRUE(real->capabilities().has_own_clock);
  EXPECT_EQ(real->capabilities().watchdog_timeout_s, 0.020);
  EXPECT_THROW((void)make_plugin_device(example().string() + ":in-process", 1000.0),
               core::Error);
  EXPECT_THROW((void)make_plugin_device(example().string() + ":in-process,real", 1000.0),
               core::Error);
}

TEST_F(PluginDeviceTest, ADeviceAtItsOwnPaceIsNoSlowerThanTheLoop) {
  EXPECT_THROW((void)make_plugin_device(own_clock("none", "simulated"), 1200.0), core::Error);
  EXPECT_NO_THROW((void)make_plugin_device(own_clock("none", "simulated"), 833.0));
  EXPECT_NO_THROW((void)make_plugin_device(troubled("none"), 1200.0));
}

}  // namespace plugin_device_test
}  // namespace jnd::device
