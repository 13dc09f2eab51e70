#include "core/safety/guards.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace jnd::core {
namespace guards_test {

HapticState held() {
  HapticState state;
  state.attached = kAllAttached;
  return state;
}

/// Pushes a hand along by `num_mm` with 1 N at each point. Returns the fault.
Fault push(Guards& guards, int num_mm) {
  HapticState state = held();
  state.acted_n.fill({1.0, 0.0, 0.0});
  state.tip_velocity_m_per_s.fill({1.0, 0.0, 0.0});
  Fault found = Fault::kNone;
  for (int mm = 0; mm <= num_mm && found == Fault::kNone; ++mm) {
    for (Eigen::Vector3d& tip_m : state.tip_position_m) tip_m.x() = 0.001 * mm;
    found = guards.observe_port(state, {}, 0.001);
    guards.end_tick(true);
  }
  return found;
}

TEST(Guards, AreTheFaultsThatJudge) {
  for (const Fault guard : kGuards) {
    EXPECT_TRUE(is_guard(guard));
    EXPECT_FALSE(std::string(warning_words(guard)).empty());
  }
  EXPECT_FALSE(is_guard(Fault::kEmergencyStop));
  EXPECT_FALSE(fades(Fault::kEmergencyStop));
  EXPECT_FALSE(fades(Fault::kNone));
  EXPECT_FALSE(fades(Fault::kEnergyGiven)) << "it hurts";
  EXPECT_TRUE(fades(Fault::kForceOscillates));
  EXPECT_TRUE(fades(Fault::kOutsideWorkspace));
}

TEST(Guards, WarnHalfWayToAFault) {
  // The bound is 20 mJ at a point, and 0.4 % of the given energy is forgotten in each
  // millisecond.
  Guards guards({}, 0.001);
  EXPECT_EQ(push(guards, 9), Fault::kNone);
  EXPECT_EQ(guards.warning(), Fault::kNone);
  EXPECT_EQ(push(guards, 12), Fault::kNone);
  EXPECT_EQ(guards.warning(), Fault::kEnergyGiven);
  EXPECT_EQ(guards.counts().num_warnings[guard_place(Fault::kEnergyGiven)], 1U);
  guards.reset();
  EXPECT_EQ(push(guards, 40), Fault::kEnergyGiven);
}

TEST(Guards, OfARealDeviceEnergyIsNeverOnlyCounted) {
  Guards real({.shadows = true, .shadows_energy = false}, 0.001);
  EXPECT_EQ(push(real, 40), Fault::kEnergyGiven);
  Guards simulated({.shadows = true, .shadows_energy = true}, 0.001);
  EXPECT_EQ(push(simulated, 60), Fault::kNone);
  EXPECT_EQ(simulated.counts().num_shadowed[guard_place(Fault::kEnergyGiven)], 2U)
      << "it begins anew after each";
}

TEST(Guards, SwingsWarnBeforeTheyAreTooMany) {
  Guards guards({}, 0.001);
  PointVectors force_n = zero_vectors();
  int num_turns = 0;
  Fault found = Fault::kNone;
  while (found == Fault::kNone && num_turns < 20) {
    force_n[0].x() = force_n[0].x() > 0.0 ? -2.0 : 2.0;
    for (int tick = 0; tick < 15; ++tick) {
      found = guards.observe_force(force_n);
      guards.end_tick(true);
    }
    if (++num_turns == 6) {
      EXPECT_EQ(guards.warning(), Fault::kNone);
    }
    if (num_turns == 9) {
      EXPECT_EQ(guards.warning(), Fault::kForceOscillates);
    }
  }
  EXPECT_EQ(found, Fault::kForceOscillates);
  guards.reset();
  guards.end_tick(true);
  EXPECT_EQ(guards.warning(), Fault::kNone);
}

TEST(Guards, AVelocityThatIsOffWarnsBeforeItIsAFault) {
  Guards guards({}, 0.001);
  HapticState state = held();
  state.tip_velocity_m_per_s.fill({0.4, 0.0, 0.0});  // The positions stand still meanwhile.
  Fault found = Fault::kNone;
  int num_warned = 0;
  for (int tick = 0; tick < 200 && found == Fault::kNone; ++tick) {
    found = guards.observe_port(state, {}, 0.001);
    guards.end_tick(true);
    num_warned += guards.warning() == Fault::kVelocityContradicts ? 1 : 0;
  }
  EXPECT_EQ(found, Fault::kVelocityContradicts);
  EXPECT_GT(num_warned, 20);
}

TEST(Guards, NothingThatIsNoNumberIsInTheSpace) {
  Guards guards({}, 0.001);
  HapticState state = held();
  EXPECT_EQ(guards.observe_place(state), Fault::kNone);
  state.tip_position_m[2].y() = std::nan("");
  EXPECT_EQ(guards.observe_place(state), Fault::kOutsideWorkspace);
  state.attached[2] = false;
  EXPECT_EQ(guards.observe_place(state), Fault::kNone);
}

}  // namespace guards_test
}  // namespace jnd::core
