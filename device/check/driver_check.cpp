#include "device/check/driver_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/safety/fault.h"
#include "core/safety/force_limiter.h"
#include "device/check/push_judge.h"
#include "device/check/velocity_lag.h"

namespace jnd::device {
namespace {

using Clock = std::chrono::steady_clock;

constexpr DeviceRule kDriverOpens = {"opens", "The device opens.",
                                     "Look at what its driver says; is it switched on?"};
constexpr DeviceRule kDriverPace = {
    "pace", "Nearly every tick brings a new measurement.",
    "Measure within a third of a tick, and tell the rate that the device keeps."};
constexpr DeviceRule kDriverTime = {
    "time", "The device time rises with every measurement, as fast as time goes.",
    "Tell the device's own clock in ns, of the moment when it measured."};
constexpr DeviceRule kDriverUnits = {
    "units", "Positions are in m and velocities in m/s, of a hand.",
    "Convert what the robot measures before it is handed over."};
constexpr DeviceRule kDriverVelocity = {
    "velocity", "Velocities are how fast the positions change.",
    "Tell the velocity of the same point and axis, in m/s and not in the robot's joints."};
constexpr DeviceRule kDriverAbsent = {
    "absent_points", "A point that the device has not is not attached.",
    "Set the bits of the points that are held to the hand, and no others."};
constexpr DeviceRule kDriverHalt = {
    "halt", "After a halt no force acts until a write of nothing but zeros.",
    "Keep the motors free of force from a halt on."};
constexpr DeviceRule kDriverLimits = {
    "limits", "No more force acts than the description says (jnd keeps to it as well).",
    "Limit each point to what the description says."};
constexpr DeviceRule kDriverReopens = {"reopens", "It can be closed and opened again.",
                                       "Free in close all that open takes."};

struct Measured {
  core::HapticState state;
  double came_s = 0.0;  ///< Time since the device was opened.
  std::int64_t tick = 0;
};

class DriverChecker {
 public:
  DriverChecker(HapticDevice& device, const DriverCheck& check, const TellOutcome& tell)
      : device_(device),
        can_(device.capabilities()),
        point_(static_cast<std::size_t>(pushed_point(can_))),
        push_n_(can_.simulated ? 2.0 : 0.5),
        can_push_((check.pushes || can_.simulated) && !check.by_hand_step_s),
        is_paced_(check.is_paced),
        is_cancelled_(check.is_cancelled),
        check_(check),
        push_judge_(can_),
        limiter_({.per_point_n = push_n_,
                  .total_n = push_n_,
                  .slew_n_per_s = can_.simulated ? 2000.0 : 100.0,
                  .max_speed_m_per_s = can_.simulated ? 5.0 : 0.5},
                 1.0 / can_.rate_hz),
        judge_(tell) {}

  bool run() {
    if (!opens(kDriverOpens)) return false;
    judge_measurements();
    if (can_push_) {
      judge_pushes();
      judge_halt();
      judge_limits();
    } else {
      for (const DeviceRule& rule : {kDriverVelocity, kForceSign, kActed, kPoints, kForceSize,
                                     kDelay, kDriverHalt, kDriverLimits}) {
        judge_.skip(rule, check_.by_hand_step_s ? kHandIsIn : kNoPush);
      }
      if (!check_.by_hand_step_s) judge_.skip(kSlowVelocity, kNoPush);
    }
    if (check_.by_hand_step_s) judge_by_hand();
    device_.close();
    if (opens(kDriverReopens)) device_.close();
    return judge_.all_kept();
  }

 private:
  bool opens(const DeviceRule& rule) {
    try {
      device_.open();
    } catch (const core::Error& error) {
      judge_.judge(rule, false, error.what());
      return false;
    }
    begin_ = Clock::now();
    core::HapticState state;
    const bool is_read = rule.name != kDriverOpens.name || device_.read(state);
    const std::string said = is_read ? "" : device_.words_of_fault();
    judge_.judge(rule, said.empty(), said);
    return true;
  }

  [[noreturn]] void stop() {
    (void)device_.write(core::zero_vectors());
    device_.halt();
    device_.close();
    throw core::Error("device-check: stopped; the device has no force and is closed");
  }

  /// Ticks at the device's rate, each with this force. The measurements that came.
  std::vector<Measured> ticks(double duration_s, const core::PointVectors& force_n) {
    std::vector<Measured> all;
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / can_.rate_hz));
    const auto num_ticks = std::llround(duration_s * can_.rate_hz);
    auto due = Clock::now();
    num_ticks_ = num_ticks;
    std::vector<double> reads_s;
    for (std::int64_t i = 0; i < num_ticks; ++i) {
      if (is_cancelled_ && is_cancelled_()) stop();
      if (is_paced_) std::this_thread::sleep_until(due);
      due = std::max(due + period, Clock::now());
      core::HapticState state;
      const auto began = Clock::now();
      const bool is_measured = device_.read(state);
      reads_s.push_back(std::chrono::duration<double>(Clock::now() - began).count());
      if (is_measured) {
        all.push_back({state, std::chrono::duration<double>(Clock::now() - begin_).count(), i});
        newest_ = state;
      }
      // Without a measurement nobody could see the push, so it is zero.
      core::PointVectors limited_n = is_measured ? force_n : core::zero_vectors();
      limiter_.limit(newest_.attached, newest_.tip_velocity_m_per_s, limited_n);
      if (!device_.write(limited_n)) ++num_not_taken_;
    }
    std::ranges::nth_element(reads_s, reads_s.begin() + std::ssize(reads_s) / 2);
    median_read_s_ = reads_s[reads_s.size() / 2];
    return all;
  }

  /// Reads without writing.
  std::vector<Measured> reads(double duration_s) {
    std::vector<Measured> all;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(duration_s));
    while (Clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      core::HapticState state;
      if (device_.read(state)) all.push_back({state, 0.0, 0});
    }
    return all;
  }

  void judge_by_hand() {
    check_by_hand({.can = can_,
                   .step_s = *check_.by_hand_step_s,
                   .watch =
                       [this](double duration_s) {
                         return states_of(ticks(duration_s, core::zero_vectors()));
                       },
                   .prompt = check_.prompt},
                  judge_);
  }

  void judge_measurements() {
    (void)ticks(0.3, core::zero_vectors());
    num_not_taken_ = 0;
    const std::vector<Measured> all = ticks(2.0, core::zero_vectors());
    const auto num_read = static_cast<double>(all.size());
    constexpr double kFewest = 0.99;
    // A device that paces the loop keeps its read waiting on purpose.
    const double most_s = can_.paces_loop ? 1.0 : kShareOfTick / can_.rate_hz;
    const bool keeps_pace = num_read >= kFewest * static_cast<double>(num_ticks_) &&
                            num_not_taken_ == 0 && median_read_s_ <= most_s;
    const std::string said = keeps_pace ? "" : device_.words_of_fault();
    DeviceRule pace = kDriverPace;
    if (!said.empty()) pace.advice = "Mend what the driver says; it hides how punctual it is.";
    judge_.judge(
        pace, keeps_pace,
        fmt::format("{} of {} ticks brought one in {:.2f} ms, {} forces were not taken{}",
                    all.size(), num_ticks_, 1e3 * median_read_s_, num_not_taken_,
                    said.empty() ? "" : ". The driver says: " + said));
    if (all.size() < 2) return;
    judge_time(all);
    double largest = 0.0;
    for (const Measured& one : all) {
      for (const auto& at : one.state.tip_position_m) largest = std::max(largest, at.norm());
      for (const auto& v : one.state.tip_velocity_m_per_s)
        largest = std::max(largest, v.norm());
    }
    constexpr double kLargestOfAHand = 20.0;
    judge_.judge(kDriverUnits, largest < kLargestOfAHand,
                 fmt::format("the largest position or velocity is {:.3g}", largest));
    std::string unlikely = unlikely_numbers(can_);
    // Positions of another unit are the fault of the rule before.
    if (unlikely.empty() && largest < kLargestOfAHand) {
      unlikely = beyond_what_is_told(can_, states_of(all));
    }
    judge_.judge(kTellsOfAHand, unlikely.empty(), unlikely);
    int num_absent = 0;
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      if (can_.has_point(point)) continue;
      num_absent += all.back().state.attached[static_cast<std::size_t>(point)] ? 1 : 0;
    }
    judge_.judge(kDriverAbsent, num_absent == 0,
                 fmt::format("{} of {} points are its own", can_.num_contact_points(),
                             core::kNumContactPoints));
  }

  void judge_time(const std::vector<Measured>& all) {
    std::size_t num_risen = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      num_risen += all[i].state.device_time_ns > all[i - 1].state.device_time_ns ? 1 : 0;
    }
    const double device_s = 1e-9 * static_cast<double>(all.back().state.device_time_ns -
                                                       all.front().state.device_time_ns);
    const double ours_s = all.back().came_s - all.front().came_s;
    // Without a clock of its own a device advances by one period in each tick, however long
    // that took.
    const double expected_s =
        can_.has_own_clock
            ? ours_s
            : static_cast<double>(all.back().tick - all.front().tick) / can_.rate_hz;
    constexpr double kMostDrift = 0.02, kMostRepeated = 0.1;
    const double drift = device_s / expected_s - 1.0;
    judge_.judge(kDriverTime,
                 static_cast<double>(num_risen) >
                         (1.0 - kMostRepeated) * static_cast<double>(all.size() - 1) &&
                     std::fabs(drift) < kMostDrift,
                 fmt::format("it rose {} times in {}, and is {:+.0f} parts in a million fast",
                             num_risen, all.size() - 1, 1e6 * drift));
  }

  static std::vector<core::HapticState> states_of(const std::vector<Measured>& all) {
    std::vector<core::HapticState> states;
    for (const Measured& one : all) states.push_back(one.state);
    return states;
  }

  void judge_pushes() {
    std::string wrong, fast, latched;
    int num_tried = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<Measured> before = ticks(0.3, core::zero_vectors());
      const bool is_still = stands_still(states_of(before), point_, axis);
      num_tried += is_still ? 1 : 0;
      Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
      force_n[axis] = push_n_;
      const std::vector<Measured> pushed =
          ticks(0.15, push_of(static_cast<int>(point_), force_n));
      if (latched.empty()) latched = latched_words();
      observe_lag(pushed, ticks(0.3, core::zero_vectors()));
      push_judge_.observe({.point = static_cast<int>(point_),
                           .force_n = force_n,
                           .before = states_of(before),
                           .during = states_of(pushed)});
      if (before.empty() || pushed.size() < 2) {
        wrong = fast = "no measurement came while it was pushed";
        break;
      }
      const double moved_m = (pushed.back().state.tip_position_m[point_] -
                              before.back().state.tip_position_m[point_])[axis];
      const char letter = "xyz"[axis];
      if (is_still && moved_m < kLeastMoved_m) {
        wrong += fmt::format("{}it moved {:+.2f} mm along {}", wrong.empty() ? "" : ", ",
                             1e3 * moved_m, letter);
      }
      // The sum of the velocities over the device's time is the displacement.
      double way_m = 0.0;
      for (std::size_t i = 1; i < pushed.size(); ++i) {
        const auto step_ns =
            pushed[i].state.device_time_ns - pushed[i - 1].state.device_time_ns;
        way_m += 1e-9 * static_cast<double>(step_ns) *
                 pushed[i].state.tip_velocity_m_per_s[point_][axis];
      }
      const double own_way_m = (pushed.back().state.tip_position_m[point_] -
                                pushed.front().state.tip_position_m[point_])[axis];
      constexpr double kShare = 0.25, kResolution_m = 0.0005;
      if (std::fabs(way_m - own_way_m) > kShare * std::fabs(own_way_m) + kResolution_m) {
        fast += fmt::format("{}{:.1f} mm by velocity and {:.1f} mm by position along {}",
                            fast.empty() ? "" : ", ", 1e3 * way_m, 1e3 * own_way_m, letter);
      }
    }
    if (num_tried == 0) {
      judge_.skip(kForceSign, kHidesPush);
    } else {
      judge_.judge(kForceSign, wrong.empty(), wrong.empty() ? "" : wrong + latched);
    }
    judge_.judge(kDriverVelocity, fast.empty(), fast);
    lag_.judge(judge_);
    push_other_points();
    push_judge_.judge(judge_);
    push_judge_.judge_delay(judge_);
  }

  void push_other_points() {
    const Eigen::Vector3d force_n = {push_n_, 0.0, 0.0};
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      if (!can_.has_point(point) || point == static_cast<int>(point_)) continue;
      const std::vector<core::HapticState> before = states_of(ticks(0.3, core::zero_vectors()));
      const std::vector<core::HapticState> pushed =
          states_of(ticks(0.15, push_of(point, force_n)));
      push_judge_.observe(
          {.point = point, .force_n = force_n, .before = before, .during = pushed});
    }
    (void)ticks(0.3, core::zero_vectors());
  }

  /// While it is pushed, and while it comes back.
  void observe_lag(const std::vector<Measured>& pushed, const std::vector<Measured>& after) {
    std::vector<core::HapticState> states = states_of(pushed);
    for (const Measured& one : after) states.push_back(one.state);
    lag_.observe(states, point_);
  }

  /// Judges by the force that the device reports, or otherwise by where the hand goes.
  [[nodiscard]] bool acts(const std::vector<Measured>& all, std::size_t first) const {
    return std::any_of(
        all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())), all.end(),
        [this](const Measured& one) { return !one.state.acted_n[point_].isZero(0.0); });
  }

  /// The fault that keeps forces away, in words behind a finding; "" if there is none.
  [[nodiscard]] std::string latched_words() const {
    const core::Fault fault = device_.fault();
    if (fault == core::Fault::kNone) return "";
    return fmt::format("; the fault {} keeps it away: {}", core::name(fault),
                       core::words(fault));
  }

  void judge_halt() {
    if (!can_.tells_acting_force) {
      judge_.skip(kDriverHalt, "the device does not tell which force acted");
      return;
    }
    const double delay_s = std::min(can_.closed_loop_delay_s, kMostDelay_s);
    const std::vector<Measured> before =
        ticks(0.05 + delay_s, push_of(static_cast<int>(point_), {push_n_, 0.0, 0.0}));
    if (before.empty()) return judge_.skip(kDriverHalt, "no measurement came");
    if (!acts(before, 0)) {
      DeviceRule halt = kDriverHalt;
      halt.advice =
          "Tell in acted_n the force that acted, and see that the device takes a push: nothing "
          "is known of a halt before.";
      return judge_.judge(halt, false, "no force acted before the halt" + latched_words());
    }
    device_.halt();
    constexpr std::size_t kUnderWay = 3;
    // jnd withholds what is written after a halt. That the driver itself ends the force shows
    // only if its time advances without writes.
    if (can_.has_own_clock && acts(reads(0.05), kOfDelay)) {
      judge_.judge(kDriverHalt, false, "the force stood after the halt, without any write");
      (void)ticks(0.3, core::zero_vectors());
      return;
    }
    const std::vector<Measured> halted =
        ticks(0.1, push_of(static_cast<int>(point_), {push_n_, 0.0, 0.0}));
    if (std::ssize(halted) < num_ticks_) {
      judge_.skip(kDriverHalt, "a tick without a measurement wrote zeros, which ends a halt");
      return;
    }
    const bool still_acts = acts(halted, kUnderWay);
    (void)ticks(0.1, core::zero_vectors());
    const bool comes_back =
        acts(ticks(0.1, push_of(static_cast<int>(point_), {push_n_, 0.0, 0.0})), 0);
    const std::string latched = latched_words();
    (void)ticks(0.3, core::zero_vectors());
    judge_.judge(kDriverHalt, !still_acts && comes_back,
                 still_acts   ? "a force acted after the halt"
                 : comes_back ? ""
                              : "no force came back after a write of zeros" + latched);
  }

  void judge_limits() {
    if (!can_.simulated || !can_.tells_acting_force) {
      judge_.skip(kDriverLimits, can_.simulated ? "the device does not tell which force acted"
                                                : "a real device is never asked for too much");
      return;
    }
    double most_n = 0.0;
    const double asked_n = 3.0 * can_.max_force_per_point_n;
    // What acts is seen by the device's own time: of one with a clock of its own that is ours.
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / can_.rate_hz));
    const double told_delay_s = std::min(can_.closed_loop_delay_s, kMostDelay_s);
    const auto num_ticks =
        std::max<std::int64_t>(30, std::llround((kLimitsTime_s + told_delay_s) * can_.rate_hz));
    auto due = Clock::now();
    for (std::int64_t i = 0; i < num_ticks; ++i) {
      core::HapticState state;
      if (device_.read(state)) most_n = std::max(most_n, state.acted_n[point_].norm());
      (void)device_.write(push_of(static_cast<int>(point_), {asked_n, 0.0, 0.0}));
      due += period;
      if (is_paced_ || can_.has_own_clock) std::this_thread::sleep_until(due);
    }
    (void)ticks(0.3, core::zero_vectors());
    constexpr double kRounding_n = 1e-6;
    if (most_n == 0.0)
      return judge_.skip(kDriverLimits, "no force acted that could be too much");
    judge_.judge(kDriverLimits, most_n <= can_.max_force_per_point_n + kRounding_n,
                 fmt::format("asked for {:g} N, {:.1f} N acted", asked_n, most_n));
  }

  static constexpr double kLeastMoved_m = 0.0002, kShareOfTick = 1.0 / 3.0;
  static constexpr double kLimitsTime_s = 0.03, kMostDelay_s = 0.1;
  static constexpr std::size_t kOfDelay = 20;  ///< Measurements that may show what was before.

  HapticDevice& device_;
  DeviceCapabilities can_;
  std::size_t point_;  ///< The point that is pushed.
  double push_n_;
  bool can_push_, is_paced_;
  std::function<bool()> is_cancelled_;
  const DriverCheck& check_;
  VelocityLagJudge lag_;
  PushJudge push_judge_;
  core::ForceLimiter limiter_;  ///< A push that gets away ends.
  RuleJudge judge_;
  Clock::time_point begin_;
  core::HapticState newest_;
  std::int64_t num_ticks_ = 0;
  int num_not_taken_ = 0;
  double median_read_s_ = 0.0;  ///< How long a read took in the last ticks.
};

}  // namespace

bool check_driver(HapticDevice& device, const DriverCheck& check, const TellOutcome& tell) {
  return DriverChecker(device, check, tell).run();
}

}  // namespace jnd::device
