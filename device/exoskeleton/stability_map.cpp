#include "device/exoskeleton/stability_map.h"

#include <algorithm>
#include <cstdint>

#include "device/drawn_mass.h"
#include "device/exoskeleton/exoskeleton_device.h"

namespace jnd::device {
namespace {

constexpr double kPushBegins_s = 0.05, kPushEnds_s = 0.15;
constexpr double kPush_n = 4.0;
constexpr double kPushedSpeed_m_per_s = 0.15;
constexpr double kPress_n = 1.0;
constexpr double kGap_m = 0.005;  ///< Gap between the lowest tip and the plane.
constexpr double kFirmMagnet_n = 1e6;

constexpr StabilityLadder kViscosities_pa_s = {.first = 2.0, .last = 512.0};
constexpr StabilityLadder kStiffnesses_n_per_m = {.first = 50.0, .last = 51200.0};
constexpr SettlingCriterion kCriterion = {.duration_s = 1.6};

enum class Pattern { kTogether, kAlternating };

ExoskeletonDevice::Parameters parameters_of(const StabilityCase& wanted) {
  ExoskeletonDevice::Parameters parameters{.rate_hz = wanted.rate_hz,
                                           .extra_delay_s = wanted.extra_delay_s};
  const bool is_detached = wanted.contact == Contact::kDetached;
  parameters.attached.fill(!is_detached);
  // Without a hand, nothing else would hold the arm.
  parameters.arm_joint_locked.fill(is_detached);
  parameters.break_away_n =
      wanted.contact == Contact::kSlipping ? kSlippingBreakAwayN : kFirmMagnet_n;
  return parameters;
}

/// The exoskeleton with disturbances. It claims that every point is attached.
class DisturbedExoskeleton final : public HapticDevice {
 public:
  explicit DisturbedExoskeleton(const StabilityCase& wanted)
      : exoskeleton_(parameters_of(wanted)),
        puts_fingers_back_(wanted.contact == Contact::kSlipping),
        period_s_(1.0 / wanted.rate_hz) {}

  void choose(Pattern pattern, bool is_on_plane) noexcept {
    pattern_ = pattern;
    is_on_plane_ = is_on_plane;
  }

  [[nodiscard]] std::string_view name() const noexcept override { return exoskeleton_.name(); }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return exoskeleton_.capabilities();
  }
  void open() override {
    exoskeleton_.open();
    tick_ = 0;
    is_moving_.fill(false);
  }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    if (!exoskeleton_.read(state)) return false;
    state.attached = core::kAllAttached;
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      is_moving_[point] |= state.tip_velocity_m_per_s[point].norm() > kPushedSpeed_m_per_s;
    }
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    const double now_s = static_cast<double>(tick_++) * period_s_;
    const bool is_pushed = now_s >= kPushBegins_s && now_s < kPushEnds_s;
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      exoskeleton_.load_tip(point, load_n(point, is_pushed && !is_moving_[point]));
      if (puts_fingers_back_) exoskeleton_.attach(point);
    }
    return exoskeleton_.write(force_on_hand_n);
  }
  void close() noexcept override { exoskeleton_.close(); }
  void halt() noexcept override { exoskeleton_.halt(); }
  [[nodiscard]] core::Fault fault() const noexcept override { return exoskeleton_.fault(); }

 private:
  [[nodiscard]] Eigen::Vector3d load_n(int point, bool is_pushed) const noexcept {
    const double sign = pattern_ == Pattern::kAlternating && point % 2 == 1 ? -1.0 : 1.0;
    const double push_n = is_pushed ? sign * kPush_n : 0.0;
    if (!is_on_plane_) return {push_n, 0.0, 0.0};
    return {0.0, 0.0, -kPress_n - push_n};
  }

  ExoskeletonDevice exoskeleton_;
  bool puts_fingers_back_;
  double period_s_;
  Pattern pattern_ = Pattern::kTogether;
  bool is_on_plane_ = false;
  std::int64_t tick_ = 0;
  std::array<bool, core::kNumContactPoints> is_moving_{};  ///< The point was pushed enough.
};

core::HapticCommand command_of(const core::MediumAmounts& medium) {
  core::HapticCommand command{.medium = medium};
  if (!medium.plane().is_there()) return command;
  double lowest_m = 0.0;
  for (const Eigen::Vector3d& tip_m : lumped_hand_tips_m()) {
    lowest_m = std::min(lowest_m, tip_m.z());
  }
  command.immersion.origin_z_m = StrokingArm::Parameters().home_z_m + lowest_m - kGap_m;
  return command;
}

bool settles_in(DisturbedExoskeleton& exoskeleton, const core::MediumAmounts& medium,
                double rate_hz) {
  for (const Pattern pattern : {Pattern::kTogether, Pattern::kAlternating}) {
    exoskeleton.choose(pattern, medium.plane().is_there());
    if (!settles(exoskeleton, command_of(medium), rate_hz, kCriterion)) return false;
  }
  return true;
}

}  // namespace

ExoskeletonStability measure_stability(const StabilityCase& wanted,
                                       const std::function<void()>& is_cancelled) {
  DisturbedExoskeleton exoskeleton(wanted);
  const auto stable = [&](const core::MediumAmounts& medium) {
    if (is_cancelled) is_cancelled();
    return settles_in(exoskeleton, medium, wanted.rate_hz);
  };
  return {
      .viscosity_pa_s =
          largest_stable(kViscosities_pa_s,
                         [&](double viscosity_pa_s) {
                           return stable(core::viscous({.viscosity_pa_s = viscosity_pa_s}));
                         }),
      .stiffness_n_per_m = largest_stable(kStiffnesses_n_per_m, [&](double stiffness_n_per_m) {
        return stable(core::solid({.stiffness_n_per_m = stiffness_n_per_m}));
      })};
}

bool is_stable_in(const StabilityCase& wanted, const core::MediumAmounts& medium) {
  DisturbedExoskeleton exoskeleton(wanted);
  return settles_in(exoskeleton, medium, wanted.rate_hz);
}

}  // namespace jnd::device
