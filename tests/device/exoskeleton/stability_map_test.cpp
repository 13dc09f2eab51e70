#include "device/exoskeleton/stability_map.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/error.h"
#include "device/exoskeleton/exoskeleton_device.h"
#include "device/haptic_loop.h"

namespace jnd::device {
namespace stability_map_test {

constexpr double kRate_hz = 1000.0;

bool is_stable_at(double viscosity_pa_s, double extra_delay_s, Contact contact) {
  return is_stable_in({kRate_hz, extra_delay_s, contact},
                      core::viscous({.viscosity_pa_s = viscosity_pa_s}));
}

TEST(StabilityMap, AHandDampsAViscosityThatALooseFingerDoesNot) {
  EXPECT_TRUE(is_stable_at(200.0, 0.0, Contact::kAttached));
  EXPECT_FALSE(is_stable_at(200.0, 0.0, Contact::kDetached));
  EXPECT_TRUE(is_stable_at(20.0, 0.0, Contact::kDetached)) << "a thin one it does";
}

TEST(StabilityMap, DelayOfTheForceMakesAFingerUnstable) {
  EXPECT_TRUE(is_stable_at(60.0, 0.0, Contact::kDetached));
  EXPECT_FALSE(is_stable_at(60.0, 0.003, Contact::kDetached));
}

TEST(StabilityMap, AStiffPlaneIsUnstableForALooseFingerFirst) {
  const core::MediumAmounts stiff = core::solid({.stiffness_n_per_m = 25000.0});
  EXPECT_TRUE(is_stable_in({kRate_hz, 0.0, Contact::kAttached}, stiff));
  EXPECT_FALSE(is_stable_in({kRate_hz, 0.0, Contact::kDetached}, stiff));
  EXPECT_TRUE(is_stable_in({kRate_hz, 0.0, Contact::kDetached},
                           core::solid({.stiffness_n_per_m = 1000.0})));
}

TEST(StabilityMap, ALimiterThatKnowsOfTheLooseFingerGivesItNoForceAtAll) {
  // The map is measured without the limiter's knowledge of loose fingers. This test has the
  // knowledge.
  ExoskeletonDevice exoskeleton({.rate_hz = kRate_hz, .attached = {}});
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop({.starts_armed = true, .rate_hz = kRate_hz}, exoskeleton,
                  {commands, telemetry, stop});
  commands.publish({.sequence = 1, .medium = core::viscous({.viscosity_pa_s = 200.0})});
  for (int tick = 0; tick < 500; ++tick) {
    exoskeleton.load_tip(0, {tick < 100 ? 4.0 : 0.0, 0.0, 0.0});
    loop.tick();
    telemetry.fetch();
    for (const core::PlainVector& force_n : telemetry.value().sample.tip_force_n) {
      ASSERT_EQ(force_n, core::PlainVector{});
    }
  }
}

TEST(StabilityMap, IsAskedBeforeEveryRunWhetherToGoOn) {
  int num_asked = 0;
  EXPECT_THROW((void)measure_stability({500.0, 0.003, Contact::kDetached},
                                       [&] {
                                         if (++num_asked == 3) throw std::runtime_error("stop");
                                       }),
               std::runtime_error);
  EXPECT_EQ(num_asked, 3);
}

TEST(StabilityMap, ARateThatTheDeviceCannotDoIsRefused) {
  EXPECT_THROW((void)measure_stability({10.0, 0.0, Contact::kAttached}), core::Error);
  EXPECT_THROW((void)measure_stability({kRate_hz, 1.0, Contact::kAttached}), core::Error);
}

}  // namespace stability_map_test
}  // namespace jnd::device
