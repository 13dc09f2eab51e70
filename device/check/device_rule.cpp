#include "device/check/device_rule.h"

#include <utility>

namespace jnd::device {

core::PointVectors push_of(int point, const Eigen::Vector3d& force_n) {
  core::PointVectors all = core::zero_vectors();
  all[static_cast<std::size_t>(point)] = force_n;
  return all;
}

int pushed_point(const DeviceCapabilities& can) {
  int point = 0;
  while (point + 1 < core::kNumContactPoints && !can.has_point(point)) ++point;
  return point;
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

void RuleJudge::judge(const DeviceRule& rule, bool is_kept, std::string found) {
  all_kept_ &= is_kept;
  tell_({.rule = rule,
         .verdict = is_kept ? RuleOutcome::Verdict::kPassed : RuleOutcome::Verdict::kFailed,
         .found = std::move(found)});
}

void RuleJudge::skip(const DeviceRule& rule, std::string why) {
  tell_({.rule = rule, .verdict = RuleOutcome::Verdict::kSkipped, .found = std::move(why)});
}

}  // namespace jnd::device
