#include "device/fault_injection.h"

#include <chrono>
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include "core/error.h"

namespace jnd::device {

FaultInjectingDevice::FaultInjectingDevice(HapticDevice& inner,
                                           std::vector<ScheduledFault> faults)
    : inner_(inner), faults_(std::move(faults)) {}

void FaultInjectingDevice::open() {
  tick_ = -1;
  ++num_openings_;
  for (const ScheduledFault& fault : faults_) {
    if (fault.injection != Injection::kOpenFailure || num_openings_ > fault.num_ticks) continue;
    throw core::Error(std::string(name()) +
                      ": expected the device to start, found an injected failure; take it out "
                      "of the list of faults");
  }
  inner_.open();
}

bool FaultInjectingDevice::read(core::HapticState& state) noexcept {
  ++tick_;
  bool succeeds = inner_.read(state);
  const core::HapticState frozen = last_good_;
  last_good_ = state;
  for (const ScheduledFault& fault : faults_) {
    if (!is_due(fault)) continue;
    const auto point = static_cast<std::size_t>(fault.point);
    switch (fault.injection) {
      case Injection::kNonFinitePosition:
        state.tip_position_m[point].y() = std::numeric_limits<double>::quiet_NaN();
        break;
      case Injection::kNonFiniteVelocity:
        state.tip_velocity_m_per_s[point].z() = std::numeric_limits<double>::infinity();
        break;
      case Injection::kReadFailure:
        succeeds = false;
        break;
      case Injection::kFrozenSample: {
        const std::int64_t time_ns = state.device_time_ns;
        state = last_good_ = frozen;
        state.device_time_ns = time_ns;
        break;
      }
      case Injection::kStaleTime:
        state = last_good_ = frozen;
        break;
      case Injection::kDetachedPoint:
        state.attached[point] = false;
        break;
      case Injection::kPositionJump:
        state.tip_position_m[point].x() += fault.magnitude;
        break;
      case Injection::kVelocitySpike:
        state.tip_velocity_m_per_s[point].x() += fault.magnitude;
        break;
      case Injection::kStall:
        std::this_thread::sleep_for(std::chrono::duration<double>(fault.magnitude));
        break;
      case Injection::kWriteFailure:
      case Injection::kForceSpike:
      case Injection::kOpenFailure:
        break;
    }
  }
  return succeeds;
}

bool FaultInjectingDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  core::PointVectors force = force_on_hand_n;
  for (const ScheduledFault& fault : faults_) {
    if (!is_due(fault)) continue;
    if (fault.injection == Injection::kWriteFailure) return false;
    if (fault.injection == Injection::kForceSpike) {
      force[static_cast<std::size_t>(fault.point)].x() += fault.magnitude;
    }
  }
  return inner_.write(force);
}

}  // namespace jnd::device
