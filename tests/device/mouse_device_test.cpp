#include "device/mouse_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/random_stream.h"
#include "device/haptic_loop.h"
#include "device/realtime_thread.h"

namespace jnd::device {
namespace mouse_device_test {

/// Where the person's mouse is at each time.
using Way = std::function<double(double time_s)>;

/// Returns strokes that are 0.3 m wide, one in each second.
double ordinary_strokes(double time_s) {
  return 0.15 * std::sin(2.0 * std::numbers::pi * time_s);
}

/// A person at a mouse, whose window reports it sixty times a second.
struct Person {
  explicit Person(const core::MediumAmounts& medium = {}, double rate_hz = 1000.0)
      : mouse(MouseDevice::Parameters{.rate_hz = rate_hz}),
        loop({.starts_armed = true, .rate_hz = rate_hz}, mouse, {commands, telemetry, stop}),
        period_s(1.0 / rate_hz) {
    mouse.open();
    feel(medium);
    loop.tick();
    telemetry.fetch();
  }

  void feel(const core::MediumAmounts& medium) {
    commands.publish({.sequence = ++sequence, .medium = medium});
  }

  void move(const Way& way, double duration_s) {
    const double until_s = time_s + duration_s;
    for (; time_s < until_s; time_s += period_s) {
      if (time_s >= next_frame_s) {
        pointer = {.sequence = pointer.sequence + 1, .x_m = way(time_s)};
        mouse.pointer().publish(pointer);
        next_frame_s += 1.0 / 60.0;
      }
      const Eigen::Vector3d before_m = hand_m();
      loop.tick();
      telemetry.fetch();
      farthest_step_m = std::max(farthest_step_m, (hand_m() - before_m).norm());
      lag_m = std::max(lag_m, std::abs(way(time_s) - hand_m().x()));
      low_m = std::min(low_m, hand_m().x());
      high_m = std::max(high_m, hand_m().x());
      fastest_m_per_s = std::max(fastest_m_per_s, speed_m_per_s());
    }
  }
  /// Strokes, and measures after the first two seconds, when the strokes have become regular.
  void stroke(double duration_s = 3.0) {
    move(ordinary_strokes, 2.0);
    forget();
    move(ordinary_strokes, duration_s);
  }
  void forget() {
    farthest_step_m = lag_m = fastest_m_per_s = 0.0;
    low_m = 1.0;
    high_m = -1.0;
  }

  [[nodiscard]] Eigen::Vector3d hand_m() const {
    return Eigen::Map<const Eigen::Vector3d>(telemetry.value().hand_position_m.data());
  }
  [[nodiscard]] double speed_m_per_s() const {
    return Eigen::Map<const Eigen::Vector3d>(telemetry.value().hand_velocity_m_per_s.data())
        .norm();
  }
  [[nodiscard]] core::Fault fault() const { return telemetry.value().fault; }

  MouseDevice mouse;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop;
  double period_s;
  std::uint64_t sequence = 0;
  core::PointerPosition pointer;
  double time_s = 0.0, next_frame_s = 0.0;
  double farthest_step_m = 0.0, lag_m = 0.0, fastest_m_per_s = 0.0;
  double low_m = 1.0, high_m = -1.0;
};

TEST(MouseDevice, InSteadyMotionAMediumHoldsTheHandBackByItsForceOverTheStiffness) {
  const auto lag_in = [](const core::MediumAmounts& medium) {
    Person person(medium);
    const Way steady = [](double time_s) { return -0.4 + 0.2 * time_s; };
    person.move(steady, 3.9);
    return steady(person.time_s) - person.hand_m().x();
  };
  const double free_m = lag_in(core::free_space());
  for (const double viscosity : {2.0, 4.0, 8.0, 16.0}) {
    const double lag_m = lag_in(core::viscous({.viscosity_pa_s = viscosity})) - free_m;
    EXPECT_NEAR(lag_m, 1.776 * viscosity * 0.2 / 60.0, 0.001) << viscosity;
  }
  const double water_m = lag_in(core::water({.scale = 4.0})) - free_m;
  EXPECT_NEAR(water_m, 0.5 * 4.0 * 1000.0 * 0.0148 * 0.8899 * 0.2 * 0.2 / 60.0, 0.001);
}

TEST(MouseDevice, InFreeSpaceTheHandGoesWithThePointer) {
  Person person;
  person.stroke();
  EXPECT_LT(person.lag_m, 0.03);
  EXPECT_NEAR(person.high_m - person.low_m, 0.3, 0.005);
}

TEST(MouseDevice, EachFluidOfAShortTourLagsVisiblyMoreThanTheOneBefore) {
  constexpr double kVisibleM = 0.005;
  double last_m = 0.03;
  for (const double scale : {0.5, 1.0, 2.0, 4.0}) {
    Person person(core::water({.scale = scale}));
    person.stroke();
    EXPECT_GT(person.lag_m, last_m + kVisibleM) << "water, scale " << scale;
    last_m = person.lag_m;
  }
  last_m = 0.03;
  double last_width_m = 0.3;
  for (const double viscosity : {3.0, 5.0, 7.0, 9.0, 13.0, 21.0}) {
    Person person(core::viscous({.viscosity_pa_s = viscosity}));
    person.stroke();
    EXPECT_GT(person.lag_m, last_m + kVisibleM) << viscosity << " Pa s";
    EXPECT_LT(person.high_m - person.low_m, last_width_m - 2.0 * kVisibleM) << viscosity;
    last_m = person.lag_m;
    last_width_m = person.high_m - person.low_m;
  }
  EXPECT_GT(last_width_m, 0.06) << "and in the thickest it can still be moved";
}

TEST(MouseDevice, KeepsItsHeightAlsoOnASurface) {
  Person person(core::solid({.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 1.0}));
  person.stroke();
  EXPECT_NEAR(person.hand_m().z(), -0.15, 1e-12);
  EXPECT_EQ(person.fault(), core::Fault::kNone);
}

core::MediumAmounts everything() {
  core::MediumAmounts medium = core::solid({.stiffness_n_per_m = 5000.0});
  medium.quadratic_kg_per_m = 50.0;
  medium.damping_n_s_per_m = 100.0;
  return medium;
}

/// Returns media from thin to the strongest that a study may ask for.
std::vector<core::MediumAmounts> media() {
  return {core::free_space(),
          core::water({.scale = 0.5}),
          core::water({.scale = 99.0}),
          core::viscous({.viscosity_pa_s = 4.0}),
          core::viscous({.viscosity_pa_s = 30.0}),
          core::viscous({.viscosity_pa_s = 100.0}),
          core::viscous({.viscosity_pa_s = 1000.0}),
          everything()};
}

TEST(MouseDevice, ComesToRestInEveryMediumAtEveryRate) {
  for (const double rate_hz : {250.0, 1000.0, 4000.0}) {
    for (std::size_t medium = 0; medium < media().size(); ++medium) {
      SCOPED_TRACE("medium " + std::to_string(medium) + " at " + std::to_string(rate_hz));
      Person person(media()[medium], rate_hz);
      const double last_m = 0.1;
      person.move([](double time_s) { return 0.3 * std::sin(15.0 * time_s); }, 2.0);
      EXPECT_LE(person.fastest_m_per_s, 2.5 + 1e-12);
      person.move([last_m](double) { return last_m; }, 1.0);
      // Only the way to the pointer is left. The hand becomes slower and slower, and never
      // turns back.
      int num_turns = 0;
      double last_speed_m_per_s = person.telemetry.value().hand_velocity_m_per_s[0];
      const double speed_before_m_per_s = person.speed_m_per_s();
      for (int i = 0; i < 200; ++i) {
        person.move([last_m](double) { return last_m; }, person.period_s);
        const double now_m_per_s = person.telemetry.value().hand_velocity_m_per_s[0];
        if (now_m_per_s * last_speed_m_per_s < -1e-12) ++num_turns;
        last_speed_m_per_s = now_m_per_s;
      }
      EXPECT_LE(num_turns, 1);
      EXPECT_LE(person.speed_m_per_s(), speed_before_m_per_s + 1e-6);
      EXPECT_EQ(person.fault(), core::Fault::kNone);
    }
  }
}

TEST(MouseDevice, NeverTripsTheLoopHoweverWildThePointer) {
  for (const core::MediumAmounts& medium : media()) {
    Person person(medium);
    core::RandomStream random(1, "pointer");
    person.move([&random](double) { return 0.5 * random.normal(); }, 10.0);
    EXPECT_EQ(person.fault(), core::Fault::kNone);
    EXPECT_LE(person.farthest_step_m, 2.5e-3 + 1e-12);
  }
}

TEST(MouseDevice, AMediumThatIsGoneAtOnceThrowsNoHandAbout) {
  Person person(core::viscous({.viscosity_pa_s = 500.0}));
  person.move([](double time_s) { return std::min(0.5, time_s); }, 1.0);
  EXPECT_GT(0.5 - person.hand_m().x(), 0.4) << "far behind";
  person.stop.press();
  person.move([](double) { return 0.5; }, 2.0);
  EXPECT_EQ(person.fault(), core::Fault::kEmergencyStop) << "and nothing on top of it";
  EXPECT_LE(person.farthest_step_m, 2.5e-3 + 1e-12);
  EXPECT_LE(person.high_m, 0.5 + 0.01);
  EXPECT_NEAR(person.hand_m().x(), 0.5, 1e-3) << "without force it is where the pointer is";
}

TEST(MouseDevice, StaysFiniteForAPointerThatIsOutOfItsMind) {
  Person person(core::viscous({.viscosity_pa_s = 4.0}));
  const std::vector<double> silly = {
      std::numeric_limits<double>::quiet_NaN(), 1e9, -1e300,
      std::numeric_limits<double>::infinity(),  0.0, std::numeric_limits<double>::denorm_min()};
  std::size_t next = 0;
  person.move([&](double) { return silly[next++ % silly.size()]; }, 5.0);
  EXPECT_EQ(person.fault(), core::Fault::kNone);
  EXPECT_TRUE(person.hand_m().allFinite());
  EXPECT_LE(person.hand_m().norm(), 0.6);
}

TEST(MouseDevice, RepeatsARunToTheBit) {
  const auto run = [] {
    Person person(core::water({.scale = 2.0}));
    person.stroke();
    return person.telemetry.value();
  };
  const core::Telemetry one = run();
  const core::Telemetry two = run();
  EXPECT_EQ(std::memcmp(&one.contact_sums, &two.contact_sums, sizeof one.contact_sums), 0);
  EXPECT_EQ(std::memcmp(&one.hand_position_m, &two.hand_position_m, sizeof one.hand_position_m),
            0);
}

TEST(MouseDevice, TheContactSumsTellTheMediumThatWasRendered) {
  Person person;
  person.move(ordinary_strokes, 1.0);
  person.feel(core::viscous({.viscosity_pa_s = 8.0}));
  person.move(ordinary_strokes, 0.2);  // This is the time of the ramp.
  const core::ContactSums from = person.mouse.contact_sums();
  person.move(ordinary_strokes, 2.0);
  const core::ContactSums felt = person.mouse.contact_sums() - from;
  EXPECT_NEAR(felt.delivered_damping_n_s_per_m(), 8.0 * 1.776, 0.01 * 8.0);
  EXPECT_EQ(felt.opposing_n, felt.rendered_opposing_n) << "no friction of its own";
}

TEST(MouseDevice, OpenedAgainItStartsAfreshAndItsTimeGoesByPeriods) {
  Person person(core::viscous({.viscosity_pa_s = 4.0}), 500.0);
  person.stroke();
  person.mouse.open();
  EXPECT_EQ(person.mouse.contact_sums().num_ticks, 0);
  core::HapticState state;
  for (int tick = 0; tick < 3; ++tick) {
    ASSERT_TRUE(person.mouse.read(state));
    EXPECT_EQ(state.device_time_ns, tick * 2'000'000);
    if (tick == 0) {
      EXPECT_EQ(state.tip_velocity_m_per_s[0], Eigen::Vector3d::Zero());
      EXPECT_EQ(state.tip_position_m[0].x(), 0.0);
    }
    ASSERT_TRUE(person.mouse.write(core::zero_vectors()));
  }
}

TEST(MouseDevice, OpenedAgainItGoesToThePointerFromTheMiddleWithoutAJerk) {
  Person person;
  person.move([](double) { return 0.4; }, 1.0);
  person.mouse.open();
  core::HapticState state;
  double hardest_kick_m_per_s = 0.0;
  double last_m_per_s = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    ASSERT_TRUE(person.mouse.write(core::zero_vectors()));
    ASSERT_TRUE(person.mouse.read(state));
    const double now_m_per_s = state.tip_velocity_m_per_s[0].x();
    hardest_kick_m_per_s = std::max(hardest_kick_m_per_s, std::abs(now_m_per_s - last_m_per_s));
    last_m_per_s = now_m_per_s;
  }
  EXPECT_LT(hardest_kick_m_per_s, 0.15);
  EXPECT_NEAR(state.tip_position_m[0].x(), 0.4, 1e-6);
}

TEST(MouseDevice, FollowsThePointerOfAnotherThreadThroughADoorOfTheirs) {
  core::LatestValue<core::PointerPosition> pointers;
  MouseDevice mouse(MouseDevice::Parameters{.rate_hz = 20'000.0}, &pointers);
  EXPECT_EQ(&mouse.pointer(), &pointers);
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop({.starts_armed = true, .rate_hz = 20'000.0}, mouse,
                  {commands, telemetry, stop});
  RealtimeThread thread(
      {.priority = 0, .lock_memory = false, .max_spin_s = 0.0, .keep_cpus_awake = false});
  start_haptics(mouse, loop, thread, false);
  for (std::uint64_t sequence = 1; telemetry.value().hand_position_m[0] < 0.19; ++sequence) {
    pointers.publish({.sequence = sequence, .x_m = 0.2});
    telemetry.fetch();
    ASSERT_EQ(telemetry.value().fault, core::Fault::kNone);
    std::this_thread::yield();
  }
  thread.stop();
}

TEST(MouseDevice, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Parameters = MouseDevice::Parameters;
  EXPECT_THROW(MouseDevice(Parameters{.rate_hz = nan}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.rate_hz = 0.0}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.mass_kg = 0.0}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.stiffness_n_per_m = nan}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.damping_n_s_per_m = -1.0}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.height_m = nan}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.max_speed_m_per_s = 0.0}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.guide = {.reach_m = nan}}), core::Error);
  EXPECT_THROW(MouseDevice(Parameters{.max_total_force_n = nan}), core::Error);
  // A hundredth of a gram on that damper would become unstable within two periods.
  EXPECT_THROW(MouseDevice(Parameters{.mass_kg = 1e-5}), core::Error);
}

}  // namespace mouse_device_test
}  // namespace jnd::device
