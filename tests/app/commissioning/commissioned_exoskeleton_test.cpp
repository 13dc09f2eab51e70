#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/commissioning/commissioned_profile.h"
#include "app/commissioning/daily_check.h"
#include "app/session/stability_limits.h"
#include "device/exoskeleton/exoskeleton_device.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace commissioned_exoskeleton_test {

const StepProgress kQuiet = [](double, const std::string&) {};

/// Returns the limits that `jnd stability` found with a hand in the device.
device::ExoskeletonStability shipped_limits(double rate_hz) {
  const StabilityMap map = shipped_stability_map("exoskeleton").value();
  for (const StabilityRow& row : map.rows) {
    if (row.measured_case.rate_hz == rate_hz && row.measured_case.extra_delay_s == 0.0 &&
        row.measured_case.contact == device::Contact::kAttached) {
      return row.limits;
    }
  }
  ADD_FAILURE() << "no row of " << rate_hz << " Hz";
  return {};
}

TEST(CommissionedExoskeleton, IsMeasuredWholeAndPassesItsDailyCheck) {
  const test_support::TemporaryFolder folder;
  device::ExoskeletonDevice exoskeleton(device::ExoskeletonDevice::Parameters{});
  Commissioning commissioning(folder.path() / "record",
                              {.name = "exoskeleton",
                               .identity = exoskeleton.identity(),
                               .can = exoskeleton.capabilities()},
                              {.loads_kg = {0.4}});
  for (const CommissioningStep step : kCommissioningSteps) {
    commissioning.measure(step, exoskeleton, *exoskeleton.bench(), kQuiet);
  }
  const experiments::DeviceProfile profile =
      profile_of(commissioning, exoskeleton.identity(), "0.1.0");
  const analysis::ForceFit& force = *commissioning.results().force;
  EXPECT_TRUE(force.gain.holds(1.0));
  EXPECT_LT(force.gain.ci95_high - force.gain.ci95_low, 0.05);
  // There is no value, because the fingers give way and the arm is damped differently along
  // each axis.
  EXPECT_FALSE(profile.delay_s.has_value());
  EXPECT_FALSE(profile.mechanics.mass_kg.has_value());
  const device::ExoskeletonStability own = shipped_limits(1000.0);
  ASSERT_TRUE(own.viscosity_pa_s.is_beyond_ladder);
  EXPECT_TRUE(profile.stability->viscosity_pa_s.is_beyond_ladder);
  EXPECT_NEAR(profile.stability->viscosity_pa_s.value, own.viscosity_pa_s.value, 1e-6);
  EXPECT_LE(profile.stability->stiffness_n_per_m.value, own.stiffness_n_per_m.value);
  EXPECT_GE(profile.stability->stiffness_n_per_m.value, 0.8 * own.stiffness_n_per_m.value);

  const DailyCheckResult check = check_daily(exoskeleton, *exoskeleton.bench(), {.seed = 7},
                                             profile, "2026-11-26", kQuiet);
  for (const CheckedQuantity& one : check.quantities) {
    EXPECT_TRUE(one.passed()) << one.what << " " << found_words(one);
  }
}

}  // namespace commissioned_exoskeleton_test
}  // namespace jnd::app
