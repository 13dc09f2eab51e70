#include "app/session/device_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/error.h"
#include "core/media/medium.h"
#include "device/haptic_device.h"
#include "device/registry/device_registry.h"
#include "device/simulated_hand.h"

namespace jnd::app {
namespace device_run_test {

using namespace std::chrono_literals;

/// A hand that is pulled through a medium, on a device that can get stuck and that counts
/// calls.
class StuckDevice final : public device::HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "stuck"; }
  [[nodiscard]] device::DeviceCapabilities capabilities() const noexcept override {
    device::DeviceCapabilities can = hand_->capabilities();
    can.watchdog_timeout_s = 0.1;
    can.simulated = simulated;
    return can;
  }
  void open() override { hand_->open(); }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    while (is_stuck && num_halts == 0) std::this_thread::sleep_for(1ms);
    return hand_->read(state);
  }
  [[nodiscard]] bool write(const core::PointVectors& force_n) noexcept override {
    double total_n = 0.0;
    for (const Eigen::Vector3d& force : force_n) total_n += force.norm();
    last_force_n = total_n;
    if (total_n > 0.0) ++num_forces;
    return hand_->write(force_n);
  }
  void close() noexcept override {
    ++num_closed;
    hand_->close();
  }
  void halt() noexcept override {
    ++num_halts;
    hand_->halt();
  }
  [[nodiscard]] device::SimulatedHand* simulated_hand() noexcept override {
    return hand_->simulated_hand();
  }

  bool simulated = true;
  std::atomic<bool> is_stuck{false};
  std::atomic<double> last_force_n{0.0};
  std::atomic<int> num_forces{0}, num_halts{0}, num_closed{0};

 private:
  std::unique_ptr<device::HapticDevice> hand_ = device::make_device("lumped", 1000.0);
};

/// Waits for up to ten seconds. Returns whether the condition holds.
bool comes(const std::function<bool()>& holds) {
  for (int i = 0; i < 1000 && !holds(); ++i) std::this_thread::sleep_for(10ms);
  return holds();
}

void stroke_through_water(StuckDevice& device, DeviceRun& run) {
  run.render(core::water({}));
  device.simulated_hand()->begin_strokes({}, core::RandomStream(1, "stroke"));
}

TEST(DeviceRun, ALoopThatIsStuckInTheDeviceIsHalted) {
  StuckDevice device;
  DeviceRun run(device, {});
  stroke_through_water(device, run);
  ASSERT_TRUE(comes([&] { return device.num_forces > 0; }));
  device.is_stuck = true;
  EXPECT_TRUE(comes([&] { return device.num_halts > 0; }));
  EXPECT_TRUE(comes([&] { return core::is_failure(run.telemetry().fault); }));
  EXPECT_TRUE(comes([&] { return device.last_force_n == 0.0; }));
}

TEST(DeviceRun, TheEmergencyStopReachesTheDevice) {
  StuckDevice device;
  core::EmergencyStop stop;
  DeviceRun run(device, {.emergency_stop = &stop});
  stroke_through_water(device, run);
  ASSERT_TRUE(comes([&] { return device.num_forces > 0; }));
  stop.press();
  EXPECT_TRUE(comes([&] { return run.telemetry().fault == core::Fault::kEmergencyStop; }));
  EXPECT_TRUE(comes([&] { return device.last_force_n == 0.0; }));
}

TEST(DeviceRun, TheHeartbeatGoesOnWhileSomebodyIsWaitedFor) {
  StuckDevice device;
  DeviceRun run(device, {});
  std::this_thread::sleep_for(1s);  // This thread is silent for more than three timeouts.
  EXPECT_NE(run.telemetry().fault, core::Fault::kHeartbeatLost);
}

TEST(DeviceRun, ARealDeviceGetsNoForceWhateverIsAskedFor) {
  StuckDevice device;
  device.simulated = false;
  DeviceRun run(device, {.allow_no_realtime = true});
  stroke_through_water(device, run);
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(device.num_forces, 0);
  EXPECT_EQ(run.telemetry().fault, core::Fault::kNotArmed);
}

TEST(DeviceRun, ARateThatItsWatchdogCannotFollowIsRefusedBeforeTheMotorsAreOn) {
  StuckDevice device;
  EXPECT_THROW(DeviceRun(device, {.rate_hz = 20.0}), core::Error) << "two ticks in 100 ms";
  EXPECT_EQ(device.num_closed, 0) << "it never was open";
}

TEST(DeviceRun, TheEndHaltsAndClosesOnce) {
  StuckDevice device;
  {
    DeviceRun run(device, {});
    run.stop();
    EXPECT_EQ(device.num_halts, 1);
    EXPECT_EQ(device.num_closed, 1);
  }
  EXPECT_EQ(device.num_closed, 1);
}

}  // namespace device_run_test
}  // namespace jnd::app
