#pragma once

#include <cstdint>

#include "core/random_stream.h"
#include "device/exoskeleton/characterization.h"
#include "device/exoskeleton/exoskeleton_device.h"

namespace jnd::device {

/// The simulated exoskeleton on a bench, its arm locked and nobody's hand on it: weights hang
/// at the tip of one finger. The finger stays in its neutral pose and the weight is turned
/// about it instead, which is the same where gravity is compensated.
class SimulatedBench final : public FingerBench {
 public:
  struct Parameters {
    double rate_hz = 1000.0;
    int point = 3;           ///< The finger, as in `core::ContactPoint`.
    std::uint64_t seed = 1;  ///< Of how fast the container is filled.
    std::uint64_t sensor_seed = 1;
  };

  /// Throws `core::Error` naming the field.
  explicit SimulatedBench(const Parameters& parameters);

  /// Filled until a base joint has turned by 5 mrad, half a millimetre at the tip, with 0.2 to
  /// 0.4 N/s.
  [[nodiscard]] double break_away_weight_n(FingerPose pose, int repetition) override;
  [[nodiscard]] TorqueReading torques_under(FingerPose pose, double weight_n) override;

 private:
  void start();
  [[nodiscard]] Eigen::Vector3d pull_direction(FingerPose pose) const;
  void tick(const Eigen::Vector3d& load_n);
  [[nodiscard]] JointVector position_rad() const;

  Parameters parameters_;
  ExoskeletonDevice exoskeleton_;
  core::HapticState state_;
};

/// The device with a simulated hand that strokes in free space at several speeds: what it adds
/// by itself. `on_progress` is told how much is done, 0 to 1. Throws `core::Error` if the
/// device fails. Not real time.
[[nodiscard]] FreeSpaceRegression stroke_in_free_space(
    double rate_hz, std::uint64_t seed, const std::function<void(double)>& on_progress = {});

}  // namespace jnd::device
