#include "app/commissioning/commissioned_profile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/commissioning/measured_twin.h"
#include "core/error.h"
#include "device/twin/twin_device.h"
#include "experiments/device_profile/profile_reader.h"
#include "experiments/device_profile/profile_writer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace commissioned_profile_test {

using test_support::TemporaryFolder;

using TwinParameters = device::TwinDevice::Parameters;

const StepProgress kQuiet = [](double, const std::string&) {};

TEST(CommissionedProfile, IsWhatWasMeasuredAndReadsBackAsItIs) {
  const TemporaryFolder folder;
  device::TwinDevice twin(device::drawn_twin(7));
  const std::filesystem::path record = folder.path() / "record.jsonl";
  const Commissioning empty = begun_with_twin(folder.path() / "empty.jsonl", twin);
  EXPECT_THROW((void)profile_of(empty, twin.identity(), "0.1.0"), core::Error);
  test_support::write_file(record, record_of_all_steps());
  const Commissioning commissioning = begun_with_twin(record, twin);
  const experiments::DeviceProfile profile =
      profile_of(commissioning, twin.identity(), "0.1.0");
  EXPECT_EQ(profile.name, "twin_seed_7");
  EXPECT_EQ(profile.device.serial, "seed-7");
  EXPECT_TRUE(profile.simulated);
  EXPECT_LT(profile.measured_on, profile.valid_until);
  const CommissioningResults& found = commissioning.results();
  EXPECT_EQ(profile.force.gain->value, found.force->gain.value);
  EXPECT_EQ(profile.mechanics.damping_n_s_per_m->ci95[1],
            found.force->damping_n_s_per_m.ci95_high);
  EXPECT_NEAR(profile.mechanics.mass_kg->value, twin.made_with().mass_kg, 0.01);
  EXPECT_EQ(profile.frame.rotation[1], found.frame->rotation(0, 1)) << "row by row";
  ASSERT_TRUE(profile.stability.has_value());
  EXPECT_EQ(profile.stability->viscosity_pa_s.value, found.stability->viscosity_pa_s);
  EXPECT_EQ(profile.stability->quiet_viscosity_pa_s, found.stability->quiet_viscosity_pa_s);
  EXPECT_EQ(profile.stability->phantom_mass_kg, 0.0);
  EXPECT_NEAR(profile.limits.workspace_half_width_m[2], 0.75, 1e-12);

  const std::filesystem::path file = experiments::write_device_profile(profile, folder.path());
  EXPECT_EQ(experiments::read_device_profile(file), profile);
}

TEST(CommissionedProfile, NoiseMakesNoDampingBelowZero) {
  const TemporaryFolder folder;
  // Without damping and friction, about half of the measured values are below zero.
  for (int seed = 1; seed <= 2; ++seed) {
    TwinParameters ideal{.position_sd_m = 1e-5,
                         .velocity_sd_m_per_s = 0.001,
                         .touch_sd_m = 0.0002,
                         .noise_seed = static_cast<std::uint64_t>(seed)};
    device::TwinDevice twin(ideal);
    Commissioning commissioning(
        folder.path() / ("record" + std::to_string(seed)),
        {.name = "twin", .identity = twin.identity(), .can = twin.capabilities()}, {});
    for (const CommissioningStep step : kCommissioningSteps) {
      commissioning.measure(step, twin, *twin.bench(), kQuiet);
    }
    const auto profile = profile_of(commissioning, twin.identity(), "0.1.0");
    EXPECT_GE(profile.mechanics.damping_n_s_per_m->value, 0.0);
    EXPECT_EQ(experiments::read_device_profile(
                  experiments::write_device_profile(profile, folder.path())),
              profile);
  }
}

}  // namespace commissioned_profile_test
}  // namespace jnd::app
