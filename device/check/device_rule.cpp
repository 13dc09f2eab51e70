#include "device/check/device_rule.h"

namespace jnd::device {

core::PointVectors push_of(const Eigen::Vector3d& force_n) {
  core::PointVectors all = core::zero_vectors();
  all[0] = force_n;
  return all;
}

std::string_view name(RuleOutcome::Verdict verdict) noexcept {
  switch (verdict) {
    case RuleOutcome::Verdict::kPassed:
      return "pass";
    case RuleOutcome::Verdict::kFailed:
      return "fail";
    case RuleOutcome::Verdict::kSkipped:
      break;
  }
  return "skip";
}

}  // namespace jnd::device
