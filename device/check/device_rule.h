#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/hand.h"
#include "core/haptic_state.h"
#include "device/haptic_device.h"

namespace jnd::device {

/// A rule that a device has to follow.
struct DeviceRule {
  std::string_view name;    ///< "force_sign", as JSON spells it.
  std::string_view demand;  ///< The rule: "A push moves the hand along with it."
  std::string_view advice;  ///< A sentence with advice for a device that breaks the rule.
};

inline constexpr DeviceRule kForceSign = {
    "force_sign", "A push moves the hand along with it, in each direction of the workspace.",
    "Forces are those on the hand, in the workspace frame: +x right, +y away, +z up."};

inline constexpr DeviceRule kTellsOfAHand = {
    "description", "What the device says of itself is in SI units and of a hand's size.",
    "Tell lengths in m, speeds in m/s, times in s, masses in kg and forces in N."};

/// Which numbers are not, with their units; "": all are, as far as it says them.
[[nodiscard]] std::string unlikely_numbers(const DeviceCapabilities& can);

/// What was seen of a simulation's points beyond the workspace and the speed that it tells; "":
/// nothing. A real device may be parked elsewhere.
[[nodiscard]] std::string beyond_what_is_told(const DeviceCapabilities& can,
                                              std::span<const core::HapticState> states);

/// A force on one point alone.
[[nodiscard]] core::PointVectors push_of(int point, const Eigen::Vector3d& force_n);
/// Returns the first point that the device has, which is pushed.
[[nodiscard]] int pushed_point(const DeviceCapabilities& can);

/// Whether a point hardly moved along this axis in the second half of these states, in which
/// nothing pushed it. A push would be hidden in what a hand moves by itself.
[[nodiscard]] bool stands_still(std::span<const core::HapticState> states, std::size_t point,
                                int axis);

/// The outcome of a rule on one device.
struct RuleOutcome {
  enum class Verdict { kPassed, kFailed, kSkipped };

  DeviceRule rule;
  Verdict verdict = Verdict::kPassed;
  /// What was measured, or why the rule was skipped; "" if there is nothing to say.
  std::string found;
};

/// Returns "pass", "fail" or "skip".
[[nodiscard]] std::string_view name(RuleOutcome::Verdict verdict) noexcept;

/// Receives every outcome as soon as it is known.
using TellOutcome = std::function<void(const RuleOutcome&)>;

/// Reports outcomes and remembers whether any rule is broken.
class RuleJudge {
 public:
  /// `tell` must outlive this object.
  explicit RuleJudge(const TellOutcome& tell) : tell_(tell) {}

  void judge(const DeviceRule& rule, bool is_kept, std::string found);
  void skip(const DeviceRule& rule, std::string why);
  [[nodiscard]] bool all_kept() const noexcept { return all_kept_; }

 private:
  const TellOutcome& tell_;
  bool all_kept_ = true;
};

/// What only a person who moves the device can find out, and how to be asked.
inline constexpr char kHandIsIn[] = "a hand is in the device, which is not pushed then";

/// Why nothing can be said about where a push moves the hand.
inline constexpr char kHidesPush[] =
    "its hand moves by itself along every axis, which hides a push";

/// Why a rule that takes a push is not tried.
inline constexpr char kNoPush[] =
    "it takes a force: take every hand out and give --with-force, or call a simulation "
    "simulated";

}  // namespace jnd::device
