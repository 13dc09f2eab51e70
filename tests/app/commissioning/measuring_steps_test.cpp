#include "app/commissioning/measuring_steps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <string>

#include "device/twin/twin_device.h"

namespace jnd::app {
namespace measuring_steps_test {

using device::TwinDevice;

const StepProgress kQuiet = [](double, const std::string&) {};

/// How often a quantity's interval held what the twin was made with.
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
    // Steps that are larger than the noise are no noise that could be added to it.
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

}  // namespace measuring_steps_test
}  // namespace jnd::app
