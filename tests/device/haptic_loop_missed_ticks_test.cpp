// Time that passed in ticks that never ran is time: nothing takes longer on a loop that misses
// most of them.

#include <gtest/gtest.h>

#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_missed_ticks_test {

using core::Fault;

/// A loop of which one tick in eleven runs, each within the time of its watchdog.
class LoopThatMissesTicks : public HapticLoopTest {
 protected:
  static constexpr int kStep_ms = 11;

  LoopThatMissesTicks() { make_loop({}, {}, &heartbeat); }

  void be_in_a_fluid() {
    device.move_all({0.3, 0.0, 0.0});
    command(core::viscous({.viscosity_pa_s = 10.0}));
    for (int tick = 0; tick < 100; ++tick) {
      heartbeat.beat();
      run(1);
    }
    ASSERT_GT(felt_n(), 1.0);
  }
  /// One tick, after ten that were missed.
  void step() {
    now_ms += kStep_ms;
    loop->due(1'000'000 * now_ms, kStep_ms - 1);
    run(1);
  }
  /// Milliseconds until something is so, and 3000 where it never is.
  template <typename Condition>
  int ms_until(Condition is_so) {
    int passed_ms = 0;
    while (!is_so() && passed_ms < 3000) {
      step();
      passed_ms += kStep_ms;
    }
    return passed_ms;
  }
  [[nodiscard]] double felt_n() const { return device.last_total_n().norm(); }

  core::Heartbeat heartbeat;
  std::int64_t now_ms = 100;
};

TEST_F(LoopThatMissesTicks, ASilentWindowIsHeardInItsTimeAndTheForceFadesInIts) {
  be_in_a_fluid();
  EXPECT_LE(ms_until([this] { return telemetry().fault == Fault::kHeartbeatLost; }),
            250 + kStep_ms);
  EXPECT_LE(ms_until([this] { return felt_n() == 0.0; }), 100 + kStep_ms);
}

TEST_F(LoopThatMissesTicks, WhoeverLeadsTheSessionIsMissedAfterASecond) {
  core::Heartbeat session;
  loop = std::make_unique<HapticLoop>(HapticLoop::Parameters{.starts_armed = true}, *faulty,
                                      HapticLoop::Exchange{.commands = commands,
                                                           .telemetry = published_telemetry,
                                                           .emergency_stop = stop,
                                                           .heartbeat = &heartbeat,
                                                           .session = &session});
  device.move_all({0.03, 0.0, 0.0});
  const auto is_lost = [this] {
    heartbeat.beat();  // The window lives.
    return telemetry().fault == Fault::kHeartbeatLost;
  };
  EXPECT_GE(ms_until(is_lost), 3000) << "nobody has begun to lead it";
  session.beat();
  step();
  EXPECT_NEAR(ms_until(is_lost), 1000, kStep_ms);
}

TEST_F(LoopThatMissesTicks, AGuardsFadeTakesItsTime) {
  make_loop({}, {.workspace = {.half_width_x_m = 0.045}}, &heartbeat);
  be_in_a_fluid();
  const auto is_fault = [this] {
    heartbeat.beat();
    return telemetry().fault == Fault::kOutsideWorkspace;
  };
  ASSERT_LT(ms_until(is_fault), 3000);
  EXPECT_LE(ms_until([this] { return felt_n() == 0.0; }), 30 + kStep_ms);
}

TEST_F(LoopThatMissesTicks, AMediumIsTakenAwayInItsTime) {
  be_in_a_fluid();
  commands.publish({.sequence = ++sequence, .medium = core::free_space(), .ramp_s = 0.050});
  const auto is_free = [this] {
    heartbeat.beat();
    return felt_n() == 0.0;
  };
  EXPECT_LE(ms_until(is_free), 50 + kStep_ms);
}

TEST_F(LoopThatMissesTicks, AMediumDoesNotBeginWithTimeFromBeforeItsCommand) {
  be_in_a_fluid();
  const double whole_n = felt_n();
  command(core::free_space());
  heartbeat.beat();
  run(20);
  ASSERT_EQ(felt_n(), 0.0);
  command(core::viscous({.viscosity_pa_s = 10.0}), 0.050);
  step();
  EXPECT_GT(felt_n(), 0.0);
  EXPECT_LE(felt_n(), 0.03 * whole_n) << "one tick of fifty, whatever was missed";
  step();
  EXPECT_NEAR(felt_n(), 0.24 * whole_n, 0.03 * whole_n) << "missed under the command";
}

TEST_F(LoopThatMissesTicks, AMeasurementOfTenMillisecondsAgoIsOld) {
  make_loop({{.first_tick = 101, .num_ticks = 100, .injection = Injection::kStaleTime}}, {},
            &heartbeat);
  be_in_a_fluid();
  step();
  step();
  EXPECT_EQ(telemetry().fault, Fault::kHostTooSlow);
  EXPECT_EQ(felt_n(), 0.0);
}

}  // namespace haptic_loop_missed_ticks_test
}  // namespace jnd::device
