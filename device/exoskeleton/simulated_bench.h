#pragma once

#include <cstdint>

#include "core/random_stream.h"
#include "device/exoskeleton/characterization.h"
#include "device/exoskeleton/exoskeleton_device.h"

namespace jnd::device {

/// The simulated exoskeleton on a bench, with its arm locked and nobody's hand on it. Weights
/// hang at the tip of one finger. Instead of the finger, the direction of the weight is turned,
/// which is the same if gravity is compensated.
class SimulatedBench final : public FingerBench {
 public:
  struct Parameters {
    double rate_hz = 1000.0;
    int point = 3;           ///< Index of the finger, as in `core::ContactPoint`.
    std::uint64_t seed = 1;  ///< Determines how fast the container is filled.
    std::uint64_t sensor_seed = 1;
  };

  /// Throws `core::Error` naming the field.
  explicit SimulatedBench(const Parameters& parameters);

  /// Fills the container at 0.2 to 0.4 N/s until a base joint has turned by 5 mrad, which is
  /// half a millimetre at the tip.
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

/// Moves the device by a simulated hand that strokes in free space at several speeds, to
/// measure what it adds by itself. `on_progress` gets 0 to 1. Throws `core::Error` if the
/// device fails. Not real time.
[[nodiscard]] FreeSpaceRegression stroke_in_free_space(
    double rate_hz, std::uint64_t seed, const std::function<void(double)>& on_progress = {});

}  // namespace jnd::device
