#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/hand.h"

namespace jnd::device {

/// What a device has to do, or must not do.
struct DeviceRule {
  std::string_view name;    ///< "force_sign", as JSON spells it.
  std::string_view demand;  ///< "A push moves the hand along with it."
  std::string_view advice;  ///< What to do where it does not; a sentence.
};

inline constexpr DeviceRule kForceSign = {
    "force_sign", "A push moves the hand along with it, in each direction of the workspace.",
    "Forces are those on the hand, in the workspace frame: +x right, +y away, +z up."};

/// A force on the first point alone.
[[nodiscard]] core::PointVectors push_of(const Eigen::Vector3d& force_n);

/// What became of a rule on one device.
struct RuleOutcome {
  enum class Verdict { kPassed, kFailed, kSkipped };

  DeviceRule rule;
  Verdict verdict = Verdict::kPassed;
  std::string found;  ///< What was measured; why it was skipped. "" for nothing to tell.
};

/// "pass", "fail" or "skip".
[[nodiscard]] std::string_view name(RuleOutcome::Verdict verdict) noexcept;

/// Is told every outcome as soon as it is known.
using TellOutcome = std::function<void(const RuleOutcome&)>;

}  // namespace jnd::device
