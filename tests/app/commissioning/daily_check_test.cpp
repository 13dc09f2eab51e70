#include "app/commissioning/daily_check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "app/commissioning/commissioned_profile.h"
#include "core/error.h"
#include "device/twin/twin_device.h"
#include "experiments/device_profile/profile_reader.h"
#include "experiments/device_profile/profile_writer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace daily_check_test {

using device::TwinDevice;
using experiments::DeviceProfile;
using test_support::TemporaryFolder;

constexpr int kTwins = 20;
const StepProgress kQuiet = [](double, const std::string&) {};

/// Returns the profile that a commissioning of this twin gives. Each twin is commissioned once.
const DeviceProfile& profile_of_twin(int seed) {
  static std::array<std::optional<DeviceProfile>, kTwins + 1> made;
  std::optional<DeviceProfile>& profile = made.at(static_cast<std::size_t>(seed));
  if (!profile) {
    const TemporaryFolder folder;
    const std::filesystem::path record = folder.path() / "record";
    TwinDevice twin(device::drawn_twin(static_cast<std::uint64_t>(seed)));
    const CommissionedDevice device = {
        .name = "twin", .identity = twin.identity(), .can = twin.capabilities()};
    Commissioning commissioning(record, device, {});
    for (const CommissioningStep step :
         {CommissioningStep::kHoming, CommissioningStep::kNoise, CommissioningStep::kFrame,
          CommissioningStep::kForce, CommissioningStep::kDelay}) {
      commissioning.measure(step, twin, *twin.bench(), kQuiet);
    }
    // The test writes the step of stability itself, because measuring it takes as long as all
    // the rest, and the check does not look at it.
    std::ofstream(record, std::ios::app)
        << R"({"step": "stability", "at": "2026-11-25T10:00:00Z", "found": {"rate_hz)"
           R"(": 1000, "damping_limit_n_s_per_m": {"value": 100, "ci95": [90, 110]},)"
           R"( "damping_limit_frequency_hz": 60, "viscosity_pa_s": 50, "viscosity_is)"
           R"(_at_least": false, "quiet_viscosity_pa_s": 40, "stiffness_n_per_m": 50)"
           R"(0, "is_single_mass": true, "num_ways": 12}})"
        << "\n";
    profile = profile_of(Commissioning(record, device, {}), twin.identity(), "0.1.0");
  }
  return *profile;
}

/// Checks the device as on another day, with other noise and other beginnings of the ways.
DailyCheckResult checked(TwinDevice::Parameters parameters, int seed) {
  parameters.noise_seed += 1000;
  TwinDevice twin(parameters);
  const MeasuringPlan plan{.seed = static_cast<std::uint64_t>(seed) + 500};
  return check_daily(twin, *twin.bench(), plan, profile_of_twin(seed), "2026-11-26", kQuiet);
}

std::string words_of_result(const DailyCheckResult& result) {
  std::string words;
  for (const CheckedQuantity& one : result.quantities) {
    words += std::string(one.what) + " " + found_words(one) + " of " + expected_words(one) +
             " " + std::string(one.shown_unit) + (one.passed() ? "\n" : " FAILED\n");
  }
  return words;
}

bool has_failed(const DailyCheckResult& result, std::string_view name) {
  for (const CheckedQuantity& one : result.quantities) {
    if (one.name == name) return !one.passed();
  }
  return false;
}

TEST(DailyCheckOfTwins, PassesADeviceThatIsAsItWas) {
  int num_passed = 0;
  std::string failed;
  for (int seed = 1; seed <= kTwins; ++seed) {
    const DailyCheckResult result = checked(device::drawn_twin(seed), seed);
    EXPECT_EQ(result.quantities.size(), 8U);
    num_passed += result.passed() ? 1 : 0;
    if (!result.passed()) failed += std::to_string(seed) + ":\n" + words_of_result(result);
  }
  EXPECT_GE(num_passed, 19) << failed;
}

TEST(DailyCheckOfTwins, FindsAGainThatChangedByFivePercent) {
  for (int seed = 1; seed <= kTwins; ++seed) {
    TwinDevice::Parameters twin = device::drawn_twin(seed);
    twin.gain *= seed % 2 == 0 ? 1.05 : 0.95;
    const DailyCheckResult result = checked(twin, seed);
    EXPECT_TRUE(has_failed(result, "gain")) << seed << ":\n" << words_of_result(result);
    EXPECT_FALSE(result.passed());
    EXPECT_FALSE(has_failed(result, "damping_n_s_per_m")) << words_of_result(result);
    EXPECT_FALSE(has_failed(result, "turned_rad")) << words_of_result(result);
  }
}

TEST(DailyCheckOfTwins, FindsATurnOfOneDegreeAboutAnyAxis) {
  for (int seed = 1; seed <= kTwins; ++seed) {
    TwinDevice::Parameters twin = device::drawn_twin(seed);
    const Eigen::Vector3d axis = seed % 4 == 3
                                     ? Eigen::Vector3d(1.0, 1.0, 1.0).normalized()
                                     : Eigen::Vector3d(Eigen::Vector3d::Unit(seed % 4));
    twin.rotation = Eigen::AngleAxisd(0.0174533, axis) * twin.rotation;
    const DailyCheckResult result = checked(twin, seed);
    EXPECT_TRUE(has_failed(result, "turned_rad")) << seed << ":\n" << words_of_result(result);
    EXPECT_FALSE(result.passed());
    EXPECT_FALSE(has_failed(result, "gain")) << words_of_result(result);
  }
}

TEST(DailyCheckOfTwins, FindsADampingThatGrewByHalfANewtonSecondAMetre) {
  for (int seed = 1; seed <= kTwins; ++seed) {
    TwinDevice::Parameters twin = device::drawn_twin(seed);
    twin.damping_n_s_per_m += 0.5;
    const DailyCheckResult result = checked(twin, seed);
    EXPECT_TRUE(has_failed(result, "damping_n_s_per_m")) << seed << ":\n"
                                                         << words_of_result(result);
    EXPECT_FALSE(result.passed());
  }
}

TEST(DailyCheckOfTwins, FindsADeviceThatWasMovedAndOneThatGrewNoisyOrSticky) {
  TwinDevice::Parameters moved = device::drawn_twin(3);
  moved.offset_m.y() += 0.005;
  EXPECT_TRUE(has_failed(checked(moved, 3), "shifted_m"));
  TwinDevice::Parameters noisy = device::drawn_twin(3);
  noisy.position_sd_m *= 4.0;
  noisy.velocity_sd_m_per_s *= 4.0;
  const DailyCheckResult of_noisy = checked(noisy, 3);
  EXPECT_TRUE(has_failed(of_noisy, "position_sd_m")) << words_of_result(of_noisy);
  EXPECT_TRUE(has_failed(of_noisy, "velocity_sd_m_per_s")) << words_of_result(of_noisy);
  TwinDevice::Parameters sticky = device::drawn_twin(3);
  sticky.friction_n += 0.4;
  EXPECT_TRUE(has_failed(checked(sticky, 3), "friction_n"));
  TwinDevice::Parameters heavy = device::drawn_twin(3);
  heavy.weight_n += 0.4;
  EXPECT_TRUE(has_failed(checked(heavy, 3), "weight_n"));
}

TEST(DailyCheckOfTwins, IsKeptInTheProfileWithWhatWasFound) {
  const TemporaryFolder folder;
  const std::filesystem::path file =
      experiments::write_device_profile(profile_of_twin(2), folder.path());
  const DailyCheckResult result = checked(device::drawn_twin(2), 2);
  experiments::DailyCheck kept = result.kept;
  kept.checked_on = profile_of_twin(2).measured_on;
  experiments::add_daily_check(file, kept);
  const DeviceProfile profile = experiments::read_device_profile(file);
  ASSERT_EQ(profile.checks.size(), 1U);
  EXPECT_EQ(profile.checks.front(), kept);
  EXPECT_TRUE(kept.passed);
  EXPECT_TRUE(kept.gain && kept.weight_n && kept.damping_n_s_per_m && kept.friction_n);
  EXPECT_TRUE(kept.turned_rad && kept.shifted_m && kept.position_sd_m &&
              kept.velocity_sd_m_per_s);
}

TEST(DailyCheck, WhatIsNoNumberOrLeavesTooMuchOpenHasNotPassed) {
  CheckedQuantity one{.expected = 1.0, .least = 0.9, .most = 1.1, .found = {1.0, 0.99, 1.01}};
  EXPECT_TRUE(one.passed());
  one.found = {1.0, 0.8, 1.2};
  EXPECT_FALSE(one.passed()) << "it may be anything";
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const analysis::Measured found :
       {analysis::Measured{kNone, 0.99, 1.01}, analysis::Measured{1.0, kNone, 1.01},
        analysis::Measured{1.0, 0.99, kNone}}) {
    one.found = found;
    EXPECT_FALSE(one.passed());
  }
  one.found = {1.0, 0.99, 1.01};
  one.most = kNone;
  EXPECT_FALSE(one.passed());
}

TEST(DailyCheck, TheMarksAreFourThatTellEveryTurn) {
  const std::vector<Eigen::Vector3d> marks_m = daily_marks_m(default_marks_m());
  ASSERT_EQ(marks_m.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      EXPECT_NEAR((marks_m[i] - marks_m[j]).norm(), std::sqrt(2.0) * 0.2, 1e-12)
          << "every other corner of the box";
    }
  }
  EXPECT_THROW((void)daily_marks_m({marks_m[0], marks_m[1], marks_m[2]}), core::Error);
}

TEST(DailyCheck, NeedsAProfileThatSaysAGain) {
  TwinDevice twin(device::drawn_twin(1));
  DeviceProfile profile = profile_of_twin(1);
  profile.force.gain.reset();
  EXPECT_THROW((void)check_daily(twin, *twin.bench(), {}, profile, "2026-11-26", kQuiet),
               core::Error);
  EXPECT_THROW((void)check_daily(twin, *twin.bench(), {.loads_kg = {}}, profile_of_twin(1),
                                 "2026-11-26", kQuiet),
               core::Error);
}

TEST(DailyCheck, WhatTheProfileDoesNotHaveIsNotChecked) {
  TwinDevice twin(device::drawn_twin(1));
  DeviceProfile profile = profile_of_twin(1);
  profile.mechanics = {};
  profile.noise = {};
  profile.tool = {};
  profile.delay_s.reset();
  const DailyCheckResult result =
      check_daily(twin, *twin.bench(), {}, profile, "2026-11-26", kQuiet);
  EXPECT_EQ(result.quantities.size(), 3U) << words_of_result(result);
  EXPECT_TRUE(result.passed()) << words_of_result(result);
}

}  // namespace daily_check_test
}  // namespace jnd::app
