#include "app/commissioning/force_test.h"

#include <cmath>

#include "app/commissioning/device_on_bench.h"
#include "app/language/words.h"
#include "core/require.h"

namespace jnd::app {

ForceTestResult test_force(device::HapticDevice& device, device::Bench& bench,
                           const MeasuringPlan& plan, const ForceTest& test,
                           const StepProgress& progress) {
  constexpr double kPeriod_s = 2.0, kMost_n = 2.0;
  constexpr int kPushes = 3;
  core::require(test.force_n > 0.0 && test.force_n <= kMost_n, "force_n",
                "a number above 0 and at most 2", test.force_n);
  core::require(std::abs(test.along.norm() - 1.0) < 1e-6, "along", "a vector of length 1",
                test.along.norm());
  const Eigen::Vector3d own_along = test.rotation.transpose() * test.along;
  DeviceOnBench started(device, bench, plan);
  started.hold(kSoftHold);
  GuideOrder order = kSoftHold;
  order.to_m = plain_of(started.place_m());
  order.pulse_n = plain_of(test.force_n * own_along);
  order.pulse_period_s = kPeriod_s;
  started.run().order(order);
  ForceTestResult result;
  // Uses the second half of each push, when the device has come to rest.
  const auto mean_of_half = [&](double sense) {
    double moved_m = 0.0;
    int num_samples = 0;
    started.run().run_for(0.25 * kPeriod_s);
    started.run().run_for(0.25 * kPeriod_s, [&](const core::Sample& sample) {
      moved_m += hand_m(sample, started.can()).dot(own_along);
      ++num_samples;
    });
    result.moved_m += sense * moved_m / num_samples / (2.0 * kPushes);
  };
  for (int push = 0; push < kPushes; ++push) {
    progress(static_cast<double>(push) / kPushes,
             tr_later("The device is pushed to and fro by a small force."));
    mean_of_half(1.0);
    mean_of_half(-1.0);
  }
  started.run().stop();
  progress(1.0, "");
  return result;
}

}  // namespace jnd::app
