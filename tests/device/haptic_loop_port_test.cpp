#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/media/medium.h"
#include "device/drawn_mass.h"
#include "device/haptic_loop.h"
#include "device/scripted_device.h"

namespace jnd::device {
namespace haptic_loop_port_test {

using core::Fault;

constexpr double kPeriod_s = 0.001;
constexpr int kMostLagTicks = 32;

/// A hand of one mass on a device whose velocity is filtered and late, or has the wrong sign,
/// and whose force may act late. It counts the energy that the device gave it.
class LateDevice final : public HapticDevice {
 public:
  struct Parameters {
    double mass_kg = 0.1;
    double cutoff_hz = 40.0;     ///< Cutoff of the first-order filter of the velocity; 0: none.
    int velocity_lag_ticks = 5;  ///< Applied after the filter.
    int reading_lag_ticks = 0;   ///< Lag of the whole measurement, its own time stamp included.
    int force_lag_ticks = 0;
    double velocity_sign = 1.0;
    double begins_m_per_s = 0.3;
  };

  explicit LateDevice(const Parameters& parameters)
      : parameters_(parameters), velocity_m_per_s_(parameters.begins_m_per_s) {
    sent_.fill(core::zero_vectors());
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "late"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return {.simulated = true, .tells_acting_force = true};
  }
  void open() override {}
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    state = states_[static_cast<std::size_t>((tick_ - parameters_.reading_lag_ticks) %
                                             kMostLagTicks)];
    // The device's own clock goes on, and so hides that the reading is late.
    state.device_time_ns = 1'000'000 * tick_;
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    const auto slot = static_cast<std::size_t>(tick_ % kMostLagTicks);
    sent_[slot] = force_on_hand_n;
    const core::PointVectors acting =
        sent_[static_cast<std::size_t>((tick_ - parameters_.force_lag_ticks) % kMostLagTicks)];
    const double force_n = total_of(acting).x();
    // This solution is exact under a force that stays constant for a period.
    const double before_m_per_s = velocity_m_per_s_;
    velocity_m_per_s_ += kPeriod_s / parameters_.mass_kg * force_n;
    const double way_m = 0.5 * kPeriod_s * (before_m_per_s + velocity_m_per_s_);
    position_m_ += way_m;
    ++tick_;
    given_j += force_n * way_m;
    top_given_j = std::max(top_given_j, given_j);
    top_m_per_s = std::max(top_m_per_s, std::abs(velocity_m_per_s_));
    last_force_n = force_n;
    measure(acting);
    return true;
  }
  void close() noexcept override {}
  void halt() noexcept override {}

  /// Fills in the measurements before any force, in which the hand comes at its speed.
  void begin() {
    const double begins_m_per_s = velocity_m_per_s_;
    filtered_m_per_s_ = begins_m_per_s;
    velocities_.fill(begins_m_per_s);
    tick_ = kMostLagTicks;
    for (int i = kMostLagTicks - 1; i >= 0; --i) {
      position_m_ = -kPeriod_s * begins_m_per_s * i;
      measure(core::zero_vectors());
      if (i > 0) ++tick_;
    }
  }

  double given_j = 0.0, top_given_j = 0.0, top_m_per_s = 0.0, last_force_n = 0.0;

 private:
  void measure(const core::PointVectors& acting) {
    const double ratio =
        parameters_.cutoff_hz > 0.0
            ? 1.0 - std::exp(-2.0 * std::numbers::pi * parameters_.cutoff_hz * kPeriod_s)
            : 1.0;
    filtered_m_per_s_ += ratio * (velocity_m_per_s_ - filtered_m_per_s_);
    velocities_[static_cast<std::size_t>(tick_ % kMostLagTicks)] = filtered_m_per_s_;
    const double reported = parameters_.velocity_sign *
                            velocities_[static_cast<std::size_t>(
                                (tick_ - parameters_.velocity_lag_ticks) % kMostLagTicks)];
    core::HapticState& state = states_[static_cast<std::size_t>(tick_ % kMostLagTicks)];
    state = {};
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      state.tip_position_m[i] =
          lumped_hand_tips_m()[i] + Eigen::Vector3d(position_m_, 0.0, -0.15);
      state.tip_velocity_m_per_s[i] = {reported, 0.0, 0.0};
    }
    state.acted_n = acting;
  }

  Parameters parameters_;
  double position_m_ = 0.0, velocity_m_per_s_ = 0.0, filtered_m_per_s_ = 0.0;
  std::int64_t tick_ = 0;
  std::array<double, kMostLagTicks> velocities_;
  std::array<core::HapticState, kMostLagTicks> states_;
  std::array<core::PointVectors, kMostLagTicks> sent_;
};

/// A loop with such a device in a fluid.
struct Rig {
  Rig(const LateDevice::Parameters& parameters, const core::MediumAmounts& medium)
      : device(parameters) {
    device.begin();
    commands.publish({.sequence = 1,
                      .medium = medium,
                      .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                      .ramp_s = 0.0});
  }
  Fault run(double duration_s) {
    for (int i = 0; i < std::lround(duration_s / kPeriod_s) && fault() == Fault::kNone; ++i) {
      loop.tick();
    }
    return fault();
  }
  Fault fault() {
    telemetry.fetch();
    return telemetry.value().fault;
  }

  LateDevice device;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop{{.starts_armed = true}, device, {commands, telemetry, stop}};
};

constexpr double kMasses_kg[] = {0.03, 0.1, 0.3, 0.6, 1.0, 2.0};
constexpr int kLags[] = {0, 1, 2, 5, 10};

/// What may be late.
enum class Late { kVelocity, kReading, kForce };

LateDevice::Parameters late(Late where, double mass_kg, int lag_ticks) {
  LateDevice::Parameters device{.mass_kg = mass_kg, .velocity_lag_ticks = 0};
  if (where == Late::kVelocity) device.velocity_lag_ticks = lag_ticks;
  if (where == Late::kReading) device.reading_lag_ticks = lag_ticks;
  if (where == Late::kForce) device.force_lag_ticks = lag_ticks;
  return device;
}

core::MediumAmounts thick() { return core::viscous({.viscosity_pa_s = 21.0}); }

/// Expects a run without a fault in which the hand has come to rest and was given nothing, or a
/// fault that comes before a hand is hurt: it got some tens of millijoules, and the speed that
/// they give.
void expect_rest_or_an_early_fault(const LateDevice::Parameters& parameters,
                                   const core::MediumAmounts& medium, Fault wanted) {
  Rig rig(parameters, medium);
  const Fault fault = rig.run(10.0);
  const double begins_j =
      0.5 * parameters.mass_kg * parameters.begins_m_per_s * parameters.begins_m_per_s;
  if (fault == Fault::kNone) {
    EXPECT_NEAR(rig.device.given_j, -begins_j, 0.01 * begins_j) << "it is at rest";
    EXPECT_LT(rig.device.top_given_j, 0.02);
    return;
  }
  EXPECT_EQ(fault, wanted);
  // The energy is seen at once, or as late as the whole reading is.
  const double most_j = parameters.reading_lag_ticks < 10 ? 0.15 : 0.3;
  EXPECT_LT(rig.device.top_given_j, most_j);
  EXPECT_LE(rig.device.top_m_per_s, std::sqrt(2.0 * (begins_j + most_j) / parameters.mass_kg));
  EXPECT_LT(rig.telemetry.value().num_ticks, 100) << "of its first swings";
}

TEST(HapticLoopPort, NoLagShakesAHandWhateverItsMass) {
  for (const Late where : {Late::kVelocity, Late::kReading, Late::kForce}) {
    for (const double mass_kg : kMasses_kg) {
      for (const int lag : kLags) {
        SCOPED_TRACE(testing::Message()
                     << static_cast<int>(where) << ", " << mass_kg << " kg, " << lag << " ms");
        expect_rest_or_an_early_fault(late(where, mass_kg, lag), thick(), Fault::kEnergyGiven);
      }
    }
  }
}

TEST(HapticLoopPort, TheBuzzOfALightHandIsAFault) {
  // 0.1 kg moves in 21 Pa s, with the velocity filtered at 40 Hz and 5 ms late. Without a
  // watch, 30 N and 2.4 m/s would go to and fro for ever, which is 31 J every ten seconds.
  Rig rig(late(Late::kVelocity, 0.1, 5), thick());
  EXPECT_EQ(rig.run(10.0), Fault::kEnergyGiven);
  EXPECT_EQ(rig.device.last_force_n, 0.0);
}

TEST(HapticLoopPort, AVelocityOfTheWrongSignIsAFault) {
  for (const double mass_kg : kMasses_kg) {
    for (const int lag : kLags) {
      SCOPED_TRACE(testing::Message() << mass_kg << " kg, " << lag << " ms");
      LateDevice::Parameters parameters = late(Late::kVelocity, mass_kg, lag);
      parameters.velocity_sign = -1.0;
      Rig rig(parameters, thick());
      EXPECT_EQ(rig.run(10.0), Fault::kEnergyGiven);
      EXPECT_LT(rig.device.top_given_j, 0.15);
    }
  }
}

TEST(HapticLoopPort, AVelocityOfTheWrongSignIsSeenInFreeSpaceToo) {
  Rig rig({.mass_kg = 1.0, .velocity_lag_ticks = 0, .velocity_sign = -1.0}, {});
  EXPECT_EQ(rig.run(10.0), Fault::kVelocityContradicts);
  EXPECT_LT(rig.telemetry.value().num_ticks, 100);
}

TEST(HapticLoopPort, WhatIsStableAtTwentyOnePascalSecondsNeverFaults) {
  for (const double mass_kg : {0.6, 1.0, 2.0}) {
    for (const int lag : kLags) {
      Rig rig(late(Late::kVelocity, mass_kg, lag), thick());
      EXPECT_EQ(rig.run(10.0), Fault::kNone) << mass_kg << " kg, " << lag << " ms";
    }
  }
}

/// A device that tells nothing of the force that acted.
class SilentDevice final : public HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "silent"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return {.simulated = simulated, .tells_acting_force = tells};
  }
  void open() override {}
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    state.device_time_ns = time_ns += 1'000'000;
    state.acted_n = acted_n;
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors&) noexcept override { return true; }
  void close() noexcept override {}
  void halt() noexcept override {}
  bool simulated = false, tells = false;
  core::PointVectors acted_n = core::zero_vectors();
  std::int64_t time_ns = 0;
};

Fault after_arming(SilentDevice& device) {
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop({}, device, {commands, telemetry, stop});
  loop.tick();
  telemetry.fetch();
  loop.rearm(telemetry.value().num_faults);
  loop.tick();
  telemetry.fetch();
  return telemetry.value().fault;
}

TEST(HapticLoopPort, ARealDeviceThatDoesNotTellItsForceIsNotArmed) {
  SilentDevice device;
  EXPECT_EQ(after_arming(device), Fault::kActingForceUnknown);
  device.tells = true;
  EXPECT_EQ(after_arming(device), Fault::kNone);
  device.tells = false;
  device.simulated = true;
  EXPECT_EQ(after_arming(device), Fault::kNone);
}

TEST(HapticLoopPort, AForceThatIsNoNumberBlindsNobody) {
  SilentDevice device;
  device.tells = true;
  device.acted_n[3].y() = std::nan("");
  EXPECT_EQ(after_arming(device), Fault::kNonFiniteState);
}

TEST(HapticLoopPort, AForceToldInAnotherUnitIsAFault) {
  ScriptedDevice device;
  device.device_capabilities = {
      .max_force_per_point_n = 8.0, .simulated = true, .tells_acting_force = true};
  double told_n = 99.0;  // A hand may press that hard on a sensor.
  device.while_read = [&] { device.state.acted_n[1].y() = told_n; };
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop({.starts_armed = true}, device, {commands, telemetry, stop});
  const auto fault_after = [&](int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) loop.tick();
    telemetry.fetch();
    return telemetry.value().fault;
  };
  EXPECT_EQ(fault_after(500), Fault::kNone);
  told_n = 2000.0;
  EXPECT_EQ(fault_after(40), Fault::kNone) << "a blow";
  EXPECT_EQ(fault_after(20), Fault::kActingForceUnknown);
}

TEST(HapticLoopPort, ADeviceThatNeverTellsOfTheForceItGivesIsAFault) {
  ScriptedDevice device;
  device.device_capabilities = {.simulated = true, .tells_acting_force = true};
  device.move_all({0.3, 0.0, 0.0});
  bool tells = true;
  int num_reads = 0;
  device.while_read = [&] {
    // The hand goes to and fro, so that it stays in the workspace.
    if (++num_reads % 200 == 0) device.move_all({num_reads % 400 == 0 ? 0.3 : -0.3, 0.0, 0.0});
    if (!tells) device.state.acted_n = core::zero_vectors();
  };
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  commands.publish({.sequence = 1,
                    .medium = core::viscous({.viscosity_pa_s = 5.0}),
                    .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                    .ramp_s = 0.0});
  HapticLoop loop({.starts_armed = true}, device, {commands, telemetry, stop});
  const auto fault_after = [&](int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) loop.tick();
    telemetry.fetch();
    return telemetry.value().fault;
  };
  EXPECT_EQ(fault_after(1500), Fault::kNone);
  tells = false;
  EXPECT_EQ(fault_after(300), Fault::kNone) << "a force may be late";
  EXPECT_EQ(fault_after(500), Fault::kActingForceUnknown);
  EXPECT_TRUE(device.received.back() == core::zero_vectors());
  tells = true;
  loop.rearm(telemetry.value().num_faults);
  EXPECT_EQ(fault_after(700), Fault::kNone) << "armed again it is judged anew";
}

}  // namespace haptic_loop_port_test
}  // namespace jnd::device
