#pragma once

#include <cstdint>
#include <vector>

#include "core/hand.h"
#include "device/haptic_device.h"

namespace jnd::device {

enum class Injection {
  kNonFinitePosition,  ///< NaN at the point.
  kNonFiniteVelocity,  ///< Infinity at the point.
  kReadFailure,
  kWriteFailure,  ///< The write does not reach the device.
  kFrozenSample,  ///< Position and velocity stand still, but time goes on.
  kStaleTime,     ///< The same measurement is repeated with its time.
  kDetachedPoint,
  kPositionJump,   ///< The point is displaced by `magnitude`, in metres, along +x.
  kVelocitySpike,  ///< The point's velocity is changed by `magnitude`, in m/s, along +x.
  kForceSpike,     ///< The device adds `magnitude`, in newtons, along +x to any force.
  kStall,          ///< Each read takes `magnitude` seconds of real time.
  kOpenFailure,    ///< `open` throws the first `num_ticks` times.
};

/// One fault over a range of ticks.
struct ScheduledFault {
  std::int64_t first_tick = 0;  ///< Counted in reads since `open`, from 0.
  std::int64_t num_ticks = 1;
  Injection injection = Injection::kReadFailure;
  core::ContactPoint point = core::ContactPoint::kIndex;
  double magnitude = 0.0;
};

/// Any device, with faults at set ticks, for tests and to rehearse what to do. It counts as
/// simulated only if the device inside does.
class FaultInjectingDevice final : public HapticDevice {
 public:
  /// `inner` must outlive this object. Not real time.
  FaultInjectingDevice(HapticDevice& inner, std::vector<ScheduledFault> faults);

  [[nodiscard]] std::string_view name() const noexcept override { return inner_.name(); }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return inner_.capabilities();
  }
  [[nodiscard]] DeviceIdentity identity() const override { return inner_.identity(); }
  [[nodiscard]] bool wait_for_sample(std::int64_t deadline_ns) noexcept override {
    return inner_.wait_for_sample(deadline_ns);
  }
  /// Opens the device inside. Ticks are counted from here.
  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override { inner_.close(); }
  [[nodiscard]] core::Fault fault() const noexcept override { return inner_.fault(); }
  [[nodiscard]] std::string words_of_fault() const override { return inner_.words_of_fault(); }
  [[nodiscard]] bool answers() const override { return inner_.answers(); }
  [[nodiscard]] bool may_arm() const noexcept override { return inner_.may_arm(); }
  void halt() noexcept override { inner_.halt(); }
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override {
    return inner_.simulated_hand();
  }
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return inner_.contact_sums();
  }

 private:
  [[nodiscard]] bool is_due(const ScheduledFault& fault) const noexcept {
    return tick_ >= fault.first_tick && tick_ - fault.first_tick < fault.num_ticks;
  }

  HapticDevice& inner_;
  std::vector<ScheduledFault> faults_;
  std::int64_t num_openings_ = 0;
  std::int64_t tick_ = -1;
  core::HapticState last_good_;
};

}  // namespace jnd::device
