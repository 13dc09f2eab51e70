#include "app/commissioning/measuring_steps.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "device/twin/twin_device.h"

namespace jnd::app {
namespace measuring_steps_test {

using device::TwinDevice;

const StepProgress kQuiet = [](double, const std::string&) {};

/// Counts how often the interval of a quantity contained the value with which the twin was
/// made.
class Tally {
 public:
  void count(const std::string& name, bool held) { counts_[name] += held ? 1 : 0; }
  [[nodiscard]] const std::map<std::string, int>& counts() const { return counts_; }

 private:
  std::map<std::string, int> counts_;
};

TEST(MeasuringSteps, RecoverWhatTwinsWereMadeWith) {
  constexpr int kTwins = 20, kFewestHeld = 18;
  Tally tally;
  for (int seed = 1; seed <= kTwins; ++seed) {
    TwinDevice twin(device::drawn_twin(static_cast<std::uint64_t>(seed)));
    const TwinDevice::Parameters& truth = twin.made_with();
    const MeasuringPlan plan{.seed = static_cast<std::uint64_t>(seed)};
    const analysis::NoiseFit noise = measure_noise(twin, *twin.bench(), plan, kQuiet);
    const double sd_m =
        std::hypot(truth.position_sd_m, truth.position_resolution_m / std::sqrt(12.0));
    // If the steps of the readings are larger than the noise, they do not add to it as
    // independent noise.
    if (truth.position_resolution_m < 2.0 * truth.position_sd_m) {
      EXPECT_NEAR(noise.position_sd_m.value, sd_m, 0.05 * sd_m) << seed;
    }
    EXPECT_NEAR(noise.position_resolution_m, truth.position_resolution_m, 1e-9) << seed;
    tally.count("velocity_sd", noise.velocity_sd_m_per_s.holds(truth.velocity_sd_m_per_s));

    const analysis::FrameFit frame = measure_frame(twin, *twin.bench(), plan, kQuiet);
    const Eigen::AngleAxisd between(frame.rotation * truth.rotation.transpose());
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name = std::string("xyz").substr(static_cast<std::size_t>(axis), 1);
      tally.count("turn about " + name, std::abs(between.angle() * between.axis()[axis]) <=
                                            frame.rotation_ci95_rad[axis]);
      tally.count(
          "offset along " + name,
          std::abs(frame.offset_m[axis] - truth.offset_m[axis]) <= frame.offset_ci95_m[axis]);
    }

    const analysis::ForceFit force = measure_force(twin, *twin.bench(), plan, frame, kQuiet);
    const analysis::DelayFit delay = measure_delay(twin, *twin.bench(), plan, force, kQuiet);
    tally.count("delay", delay.delay_s.holds(truth.delay_s));
    tally.count("mass", delay.mass_per_gain_kg.holds(truth.mass_kg / truth.gain));
    tally.count("gain", force.gain.holds(truth.gain));
    tally.count("weight", force.weight_n.holds(truth.weight_n));
    tally.count("damping", force.damping_n_s_per_m.holds(truth.damping_n_s_per_m));
    tally.count("friction", force.friction_n.holds(truth.friction_n));
  }
  for (const auto& [name, held] : tally.counts()) EXPECT_GE(held, kFewestHeld) << name;
}

TEST(MeasuringSteps, HomingTellsHowFarTheZeroIsOffAndWhetherTheToolStays) {
  TwinDevice exact({.friction_n = 1.0, .weight_n = 0.5});
  const analysis::HomingFit held = measure_homing(exact, *exact.bench(), {}, kQuiet);
  EXPECT_EQ(held.spread_m, 0.0);
  EXPECT_LT(held.moved_m, 1e-9) << "its friction is more than its weight";

  TwinDevice sinks({.friction_n = 0.5, .weight_n = 1.5, .homing_sd_m = 0.001});
  const analysis::HomingFit fell = measure_homing(sinks, *sinks.bench(), {}, kQuiet);
  EXPECT_EQ(fell.homed_m.size(), 3U);
  EXPECT_GT(fell.spread_m, 0.0003);
  EXPECT_LT(fell.spread_m, 0.01);
  // Half a kilogram with a newton left over falls by a quarter of a metre in half a second.
  EXPECT_GT(fell.moved_m, 0.05);
  EXPECT_LT(fell.moved_m, 0.1) << "it is held again as soon as it is seen to fall";
}

/// Returns the damping or the stiffness above which a twin without noise, friction and cogging
/// oscillates with growing amplitude. It is computed from the twin's own steps of motion alone.
double own_limit(const TwinDevice::Parameters& twin, bool is_stiffness) {
  constexpr double kStep_s = 1e-4;
  constexpr int kSteps = 10;  // So many steps make a tick.
  const auto late = static_cast<int>(std::lround(twin.delay_s / kStep_s));
  const int num_writes = late / kSteps + 2;
  const auto grows = [&](double amount) {
    Eigen::MatrixXd tick = Eigen::MatrixXd::Zero(2 + num_writes, 2 + num_writes);
    for (int column = 0; column < 2 + num_writes; ++column) {
      const Eigen::VectorXd before = Eigen::VectorXd::Unit(2 + num_writes, column);
      double position_m = before[0], velocity_m_per_s = before[1];
      const double written_n = -amount * (is_stiffness ? position_m : velocity_m_per_s);
      for (int step = 0; step < kSteps; ++step) {
        const int ticks_ago = step >= late ? 0 : (late - step + kSteps - 1) / kSteps;
        const double force_n = ticks_ago == 0 ? written_n : before[1 + ticks_ago];
        const double damped = 0.5 * kStep_s * twin.damping_n_s_per_m / twin.mass_kg;
        const double next_m_per_s =
            ((1.0 - damped) * velocity_m_per_s + kStep_s / twin.mass_kg * twin.gain * force_n) /
            (1.0 + damped);
        position_m += 0.5 * kStep_s * (velocity_m_per_s + next_m_per_s);
        velocity_m_per_s = next_m_per_s;
      }
      // A fluid does not pull the mass back to a place, so the position is left out.
      tick(0, column) = is_stiffness ? position_m : 0.0;
      tick(1, column) = velocity_m_per_s;
      tick(2, column) = written_n;
      for (int i = 3; i < 2 + num_writes; ++i) tick(i, column) = before[i - 1];
    }
    return tick.eigenvalues().cwiseAbs().maxCoeff() >= 1.0;
  };
  double stable = 1e-3, unstable = 1e6;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = std::sqrt(stable * unstable);
    (grows(middle) ? unstable : stable) = middle;
  }
  return stable;
}

// To save time, the test takes every sixth twin. The table in the documentation has all of
// them.
TEST(MeasuringSteps, LimitsOfStabilityLieBelowTheTwinsOwnButNotFar) {
  constexpr double kShape_m = 1.7760;  // The shape of the hand in a viscous fluid.
  constexpr double kThickest_pa_s = 512.0;
  for (int seed = 1; seed <= 20; seed += 6) {
    TwinDevice twin(device::drawn_twin(static_cast<std::uint64_t>(seed)));
    const MeasuringPlan plan{.seed = static_cast<std::uint64_t>(seed)};
    device::Bench& bench = *twin.bench();
    const analysis::NoiseFit noise = measure_noise(twin, bench, plan, kQuiet);
    const analysis::FrameFit frame = measure_frame(twin, bench, plan, kQuiet);
    const analysis::ForceFit force = measure_force(twin, bench, plan, frame, kQuiet);
    const analysis::DelayFit delay = measure_delay(twin, bench, plan, force, kQuiet);
    const analysis::StabilityFit fit =
        measure_stability(twin, bench, plan, noise, force, delay, kQuiet);
    const double viscosity_pa_s = own_limit(twin.made_with(), false) / kShape_m,
                 stiffness_n_per_m = own_limit(twin.made_with(), true);
    EXPECT_LE(fit.viscosity_pa_s, viscosity_pa_s) << seed;
    EXPECT_GE(fit.viscosity_pa_s, 0.8 * std::min(viscosity_pa_s, kThickest_pa_s)) << seed;
    EXPECT_EQ(fit.damping.is_beyond, fit.viscosity_pa_s >= kThickest_pa_s - 1e-9) << seed;
    EXPECT_LE(fit.stiffness_n_per_m, stiffness_n_per_m) << seed;
    EXPECT_GE(fit.stiffness_n_per_m, 0.8 * stiffness_n_per_m) << seed;
    EXPECT_GT(fit.quiet_viscosity_pa_s, 0.0) << seed;
    EXPECT_LE(fit.quiet_viscosity_pa_s, fit.viscosity_pa_s) << seed;
  }
}

}  // namespace measuring_steps_test
}  // namespace jnd::app
