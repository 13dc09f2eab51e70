#include "device/check/hand_check.h"

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/device_channels.h"
#include "core/hand.h"
#include "device/check/velocity_lag.h"

namespace jnd::device {
namespace {

using HandStates = std::vector<core::HapticState>;

constexpr DeviceRule kHandStill = {
    "still", "Of a hand that is held still, positions stay and velocities are zero on average.",
    "Hold it stiller; else take the offset out of the velocities and the drift out of the "
    "positions."};
constexpr DeviceRule kHandMoves = {
    "moves", "Positions follow a hand that is moved.",
    "Move it as far as the text asks; else look why this axis or this point does not change."};
constexpr DeviceRule kHandDistance = {"distance", "A way of some 10 cm is told as some 0.1 m.",
                                      "Tell positions in m: what is in mm is a thousand times "
                                      "too much, what is in inches 39 times."};
constexpr DeviceRule kHandAxes = {
    "swapped_axes", "The axis changes along which the hand is moved: x, then y, then z.",
    "Turn positions, velocities and forces into the workspace frame in the driver: x to the "
    "right, y away, z up."};
constexpr DeviceRule kHandSigns = {
    "mirrored_axes", "+x is to the person's right, +y away, +z up.",
    "Change the sign of this axis in the driver, of positions, velocities and forces alike."};
constexpr DeviceRule kHandPoints = {
    "points_order", "The point changes whose finger moves: thumb, index or middle.",
    "Put the points in the order inner palm, outer palm, thumb, index, middle."};
constexpr DeviceRule kHandButtons = {
    "buttons", "Buttons change when they are pressed.",
    "Set a bit for each button that is pressed now, or do not tell that it has buttons."};
constexpr DeviceRule kHandGripper = {
    "gripper", "The gripper's opening is in m, and is larger when it is open.",
    "Tell the opening in m, 0 when it is closed, or do not tell that it has a gripper."};
constexpr DeviceRule kHandWorkspace = {
    "workspace",
    "The hand can be moved through the workspace that the device tells, and no further.",
    "Tell the half widths of the box about the origin that the device really reaches; a "
    "session ends the force outside of it."};
constexpr std::array kHandRules = {kHandStill,   kHandMoves,   kHandDistance,
                                   kHandAxes,    kHandSigns,   kHandPoints,
                                   kHandButtons, kHandGripper, kHandWorkspace};

class HandChecker {
 public:
  HandChecker(const HandCheck& check, RuleJudge& judge) : check_(check), judge_(judge) {}

  void run() {
    (void)during("ready", "The device gives no force now. Take hold of it", 1.0);
    judge_still();
    judge_directions();
    judge_points();
    judge_buttons();
    judge_gripper();
    judge_workspace();
    lag_.judge(judge_);
  }

 private:
  /// What is measured while somebody does this, `share` times as long as a step.
  HandStates during(std::string_view step, const std::string& text, double share) {
    HandStates all;
    double left_s = share * check_.step_s;
    while (left_s > 1e-9) {
      check_.prompt({.step = step, .text = text, .left_s = left_s});
      const double now_s = std::min(left_s, 1.0);
      const HandStates more = check_.watch(now_s);
      all.insert(all.end(), more.begin(), more.end());
      left_s -= now_s;
    }
    return all;
  }
  /// What is left of it when somebody has done as the text says.
  static std::span<const core::HapticState> last_part(const HandStates& states, double share) {
    const auto num =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(states.size())));
    return std::span(states).last(num);
  }
  void back_to_the_middle() {
    middle_ = during("back", "Bring it back to the middle, and hold it there", 0.75);
  }

  /// Mean over the points that the device has.
  [[nodiscard]] Eigen::Vector3d place_of(std::span<const core::HapticState> states) const {
    return mean_of(states, &core::HapticState::tip_position_m);
  }
  [[nodiscard]] Eigen::Vector3d mean_of(std::span<const core::HapticState> states,
                                        core::PointVectors core::HapticState::*vectors) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const core::HapticState& state : states) {
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        if (check_.can.has_point(point))
          sum += (state.*vectors)[static_cast<std::size_t>(point)];
      }
    }
    const auto num = static_cast<double>(states.size()) * check_.can.num_contact_points();
    return num > 0.0 ? (sum / num).eval() : sum;
  }
  [[nodiscard]] static double range_m(std::span<const core::HapticState> states,
                                      std::size_t point) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
    for (const core::HapticState& state : states) {
      low = low.cwiseMin(state.tip_position_m[point]);
      high = high.cwiseMax(state.tip_position_m[point]);
    }
    return states.empty() ? 0.0 : (high - low).norm();
  }

  void judge_still() {
    const HandStates states =
        during("still", "Hold it still, without touching anything else", 1.0);
    const auto rest = last_part(states, 0.5);
    if (rest.size() < 2) return judge_.judge(kHandStill, false, "no measurement came");
    double range = 0.0;
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      if (check_.can.has_point(point)) {
        range = std::max(range, range_m(rest, static_cast<std::size_t>(point)));
      }
    }
    const double offset = mean_of(rest, &core::HapticState::tip_velocity_m_per_s).norm();
    constexpr double kMostRange_m = 0.015, kMostOffset_m_per_s = 0.02;
    judge_.judge(kHandStill, range < kMostRange_m && offset < kMostOffset_m_per_s,
                 fmt::format("positions within {:.1f} mm, velocities {:.1f} mm/s on average",
                             1e3 * range, 1e3 * offset));
  }

  struct Direction {
    std::string_view step, words;
    int axis;
  };
  static constexpr std::array<Direction, 3> kDirections = {
      {{"right", "to your right", 0}, {"away", "away from you", 1}, {"up", "up", 2}}};

  void judge_directions() {
    std::string unmoved, far, swapped, mirrored;
    Eigen::Matrix3d ways_m = Eigen::Matrix3d::Zero();
    int num_moved = 0;
    for (const Direction& direction : kDirections) {
      back_to_the_middle();
      const Eigen::Vector3d from_m = place_of(last_part(middle_, 0.25));
      HandStates moved =
          during(direction.step,
                 fmt::format("Move it 10 cm {}, and hold it there", direction.words), 1.0);
      const Eigen::Vector3d way_m = place_of(last_part(moved, 0.25)) - from_m;
      if (!moved.empty())
        lag_.observe(moved, static_cast<std::size_t>(pushed_point(check_.can)));
      ways_m.col(direction.axis) = way_m;
      constexpr double kLeast_m = 0.02, kMost_m = 0.4;
      if (moved.empty() || way_m.norm() < kLeast_m) {
        add(unmoved, fmt::format("moved {}, it told {:.1f} mm in all", direction.words,
                                 1e3 * way_m.norm()));
        continue;
      }
      ++num_moved;
      if (way_m.norm() > kMost_m) {
        add(far, fmt::format("moved {}, it told {:.3g} m", direction.words, way_m.norm()));
      }
      int largest = 0;
      way_m.cwiseAbs().maxCoeff(&largest);
      const char letter = "xyz"[largest];
      const std::string found = fmt::format("moved {}, it told {:+.0f} mm along {}",
                                            direction.words, 1e3 * way_m[largest], letter);
      if (largest != direction.axis) add(swapped, found);
      if (way_m[largest] < 0.0) add(mirrored, found);
    }
    judge_.judge(kHandMoves, unmoved.empty(), unmoved);
    if (num_moved == 0) {
      for (const DeviceRule& rule : {kHandDistance, kHandAxes, kHandSigns}) {
        judge_.skip(rule, "no movement was seen");
      }
      return;
    }
    if (num_moved == 3 && ways_m.determinant() < 0.0) {
      add(mirrored.empty() ? swapped : mirrored, "so its frame is left-handed");
    }
    judge_.judge(kHandDistance, far.empty(), far);
    judge_.judge(kHandAxes, swapped.empty(), swapped);
    judge_.judge(kHandSigns, mirrored.empty(), mirrored);
  }

  void judge_points() {
    std::string wrong;
    int num_tried = 0;
    constexpr int kFirstFinger = 2;
    const bool has_several = check_.can.num_contact_points() > 1;
    for (int finger = kFirstFinger; has_several && finger < core::kNumContactPoints; ++finger) {
      if (!check_.can.has_point(finger)) continue;
      ++num_tried;
      const std::string name(core::kContactPointNames[static_cast<std::size_t>(finger)]);
      back_to_the_middle();
      const HandStates states = during(
          name, fmt::format("Move the {} alone to and fro, and hold all else still", name),
          1.0);
      int most = finger;
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        if (check_.can.has_point(point) &&
            range_m(states, static_cast<std::size_t>(point)) >
                range_m(states, static_cast<std::size_t>(most))) {
          most = point;
        }
      }
      constexpr double kLeast_m = 0.003;
      if (range_m(states, static_cast<std::size_t>(most)) < kLeast_m) {
        add(wrong, fmt::format("the {} was moved, and no point told it", name));
      } else if (most != finger) {
        add(wrong, fmt::format("the {} was moved, and the point {} told it", name,
                               core::kContactPointNames[static_cast<std::size_t>(most)]));
      }
    }
    if (num_tried == 0) {
      return judge_.skip(kHandPoints, "it has no two points of which one is a finger");
    }
    judge_.judge(kHandPoints, wrong.empty(), wrong);
  }

  void judge_buttons() {
    if ((check_.can.channels & core::kButtons) == 0) {
      return judge_.skip(kHandButtons, "it does not tell of buttons");
    }
    const HandStates states =
        during("buttons", "Press each button once, one after the other, and let go", 1.0);
    std::uint32_t set = 0, cleared = 0;
    for (const core::HapticState& state : states) {
      set |= state.channels.buttons;
      cleared |= ~state.channels.buttons;
    }
    const std::uint32_t changed = set & cleared;
    std::string names;
    for (int bit = 0; bit < 32; ++bit) {
      if ((changed >> bit & 1U) != 0) add(names, std::to_string(bit));
    }
    judge_.judge(kHandButtons, changed != 0,
                 changed != 0 ? "these bits changed: " + names : "no bit changed");
  }

  void judge_gripper() {
    if ((check_.can.channels & core::kGripper) == 0) {
      return judge_.skip(kHandGripper, "it does not tell of a gripper");
    }
    const HandStates states =
        during("gripper", "Open the gripper wide, close it, and keep it closed", 1.0);
    if (states.empty()) return judge_.judge(kHandGripper, false, "no measurement came");
    double low = 1e9, high = -1e9;
    for (const core::HapticState& state : states) {
      low = std::min(low, state.channels.gripper_m);
      high = std::max(high, state.channels.gripper_m);
    }
    const double end = states.back().channels.gripper_m;
    constexpr double kLeast_m = 0.003, kMost_m = 0.5;
    const bool is_closed = end - low < high - end;
    judge_.judge(kHandGripper,
                 high - low > kLeast_m && is_closed && std::max(std::fabs(low), high) < kMost_m,
                 fmt::format("from {:.1f} to {:.1f} mm, closed it told {:.1f} mm", 1e3 * low,
                             1e3 * high, 1e3 * end));
  }

  void judge_workspace() {
    const core::Workspace& told = check_.can.workspace;
    const Eigen::Vector3d told_m(told.half_width_x_m, told.half_width_y_m, told.half_width_z_m);
    if (!told_m.allFinite()) {
      return judge_.skip(kHandWorkspace, "it does not tell its workspace");
    }
    const HandStates states = during(
        "workspace", "Move it as far as it goes: right, left, away, near, up and down", 2.0);
    Eigen::Vector3d reached_m = Eigen::Vector3d::Zero();
    for (const core::HapticState& state : states) {
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        if (!check_.can.has_point(point)) continue;
        reached_m = reached_m.cwiseMax(
            state.tip_position_m[static_cast<std::size_t>(point)].cwiseAbs());
      }
    }
    std::string wrong;
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kMargin_m = 0.01, kLeastShare = 0.5;
      const std::string reached =
          fmt::format("along {} it went to {:.0f} mm from the origin, and tells {:.0f} mm",
                      "xyz"[axis], 1e3 * reached_m[axis], 1e3 * told_m[axis]);
      if (reached_m[axis] > told_m[axis] + kMargin_m ||
          reached_m[axis] < kLeastShare * told_m[axis]) {
        add(wrong, reached);
      }
    }
    judge_.judge(kHandWorkspace, wrong.empty(), wrong);
  }

  static void add(std::string& all, const std::string& one) {
    all += (all.empty() ? "" : ", ") + one;
  }

  const HandCheck& check_;
  RuleJudge& judge_;
  VelocityLagJudge lag_;
  HandStates middle_;
};

}  // namespace

void check_by_hand(const HandCheck& check, RuleJudge& judge) {
  if (check.can.moves_by_itself) {
    constexpr char kMoves[] = "its hand moves by itself, and nobody can move it";
    skip_by_hand(judge, kMoves);
    return judge.skip(kSlowVelocity, kMoves);
  }
  HandChecker(check, judge).run();
}

void skip_by_hand(RuleJudge& judge, const std::string& why) {
  for (const DeviceRule& rule : kHandRules) judge.skip(rule, why);
}

}  // namespace jnd::device
