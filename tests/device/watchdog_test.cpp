#include "device/watchdog.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <semaphore>
#include <thread>

#include "core/error.h"

namespace jnd::device {
namespace watchdog_test {

constexpr std::int64_t kMs = 1'000'000;

class HaltedDevice final : public HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "halted"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override { return {}; }
  void open() override {}
  [[nodiscard]] bool read(core::HapticState&) noexcept override { return true; }
  [[nodiscard]] bool write(const core::PointVectors&) noexcept override { return true; }
  void close() noexcept override {}
  void halt() noexcept override {
    ++num_halts;
    halted.release();
  }

  std::atomic<int> num_halts{0};
  std::counting_semaphore<> halted{0};
};

class WatchdogTest : public ::testing::Test {
 protected:
  /// Lets time pass, with a loop of 1 kHz and a look every 2 ms.
  void pass(int num_ms, bool beats) {
    for (int i = 0; i < num_ms; ++i) {
      now_ns += kMs;
      if (beats) state.beat();
      if (now_ns / kMs % 2 == 0) watchdog.look(now_ns);
    }
  }

  HaltedDevice device;
  core::WatchdogState state;
  Watchdog watchdog{{}, device, state};
  std::int64_t now_ns = 0;
};

TEST_F(WatchdogTest, ALoopThatBeatsIsLeftAlone) {
  pass(10'000, true);
  EXPECT_EQ(device.num_halts, 0);
  EXPECT_FALSE(state.has_bitten());
}

TEST_F(WatchdogTest, ItWaitsForTheFirstBeat) {
  pass(10'000, false);
  EXPECT_EQ(device.num_halts, 0);
}

TEST_F(WatchdogTest, ShortStallsAreForgivenAndLongOnesBitten) {
  for (const int num_ms : {2, 10, 50, 1000}) {
    pass(100, true);
    device.num_halts = 0;
    pass(num_ms, false);
    EXPECT_EQ(device.num_halts > 0, num_ms >= 50) << num_ms;
    EXPECT_EQ(state.has_bitten(), num_ms >= 50) << num_ms;
    state.forgive();
  }
}

TEST_F(WatchdogTest, TheForceIsGoneWithinTheTimeoutAndOneLook) {
  pass(101, true);
  pass(19, false);
  EXPECT_EQ(device.num_halts, 0);
  pass(4, false);
  EXPECT_EQ(device.num_halts, 1);
}

TEST_F(WatchdogTest, ADeadLoopIsBittenAgainAndAgain) {
  pass(10, true);
  pass(1000, false);
  EXPECT_GE(device.num_halts, 45);
}

TEST_F(WatchdogTest, ItStaysBittenUntilTheLoopIsArmed) {
  pass(10, true);
  pass(50, false);
  pass(1000, true);
  EXPECT_TRUE(state.has_bitten());
  const int num_halts = device.num_halts;
  state.forgive();
  pass(1000, true);
  EXPECT_FALSE(state.has_bitten());
  EXPECT_EQ(device.num_halts, num_halts) << "it beats again";
}

TEST_F(WatchdogTest, ParametersOutOfRangeAreRefused) {
  for (const double timeout_s : {0.0, -1.0, 11.0, std::nan("")}) {
    EXPECT_THROW(Watchdog({.timeout_s = timeout_s}, device, state), core::Error);
  }
  EXPECT_THROW(WatchdogThread({.priority = 100}, device, state), core::Error);
}

/// The loop ends without notice after a few beats, as a killed thread does.
TEST(WatchdogThread, HaltsTheDeviceOfALoopThatIsGone) {
  HaltedDevice device;
  core::WatchdogState state;
  const WatchdogThread watchdog({}, device, state);
  std::thread loop([&state] {
    for (int i = 0; i < 5; ++i) state.beat();
  });
  loop.join();
  device.halted.acquire();
  EXPECT_TRUE(state.has_bitten());
  device.halted.acquire();
  EXPECT_GE(state.num_bites(), 2u);
}

}  // namespace watchdog_test
}  // namespace jnd::device
