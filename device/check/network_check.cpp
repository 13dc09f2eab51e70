#include "device/check/network_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "device/check/link_probe.h"
#include "device/check/network_rules.h"
#include "device/check/push_judge.h"
#include "device/check/velocity_lag.h"
#include "device/haptic_device.h"
#include "device/network/crc32.h"

namespace jnd::device {
namespace {

using Seen = LinkProbe::Seen;
using States = std::vector<Seen>;

bool acts(const Seen& seen) {
  return std::ranges::any_of(seen.state.measured.acted_n,
                             [](const auto& force) { return !force.isZero(0.0); });
}

bool is_armed_or_acts(const Seen& seen) { return seen.state.armed || acts(seen); }

/// Whether any state from this one on is armed or reports a force. States that were under way
/// do not count.
bool any_after(const States& states, std::size_t first) {
  return states.size() > first &&
         std::any_of(states.begin() + static_cast<std::ptrdiff_t>(first), states.end(),
                     is_armed_or_acts);
}

class NetworkChecker {
 public:
  NetworkChecker(const NetworkCheck& check, const TellOutcome& tell)
      : check_(check), judge_(tell) {
    std::random_device draw;
    token_ = std::uint64_t{draw()} << 32 | draw();
  }

  bool run() {
    const auto port = check_.open_port();
    LinkProbe program(*port, check_.server, check_.key, token_++);
    require_answer(program);
    judge_hellos(program);
    judge_states(program);
    if (can_push_) {
      judge_arming(program);
      judge_pushes(program);
      judge_limits(program);
      judge_replay(program);
      judge_silence(program);
    } else {
      skip_pushes(program);
    }
    if (check_.by_hand_step_s) judge_by_hand(program);
    judge_others(program);
    judge_.judge(kDatagrams, program.num_refused() == 0,
                 program.num_refused() == 0
                     ? ""
                     : fmt::format("{} that are none of these, the last one {}",
                                   program.num_refused(), program.last_problem_words()));
    return judge_.all_kept();
  }

 private:
  void require_answer(LinkProbe& program) {
    constexpr double kPatience_s = 2.0;
    if (!program.connect(kPatience_s)) {
      const auto refusal = program.refusal();
      std::string why =
          program.num_refused() > 0
              ? "found one whose datagrams are not those of device/network/README.md, the last "
                "one " +
                    program.last_problem_words() + "; mend what it sends"
              : "found no answer; start its program, and see that address, port and key are "
                "the same on both sides";
      if (refusal == wire::RefusalReason::kBusy)
        why = "found one that a program uses; end that program";
      if (refusal == wire::RefusalReason::kOtherKey)
        why =
            "found one with another key, or none; use the same file of `jnd device-key` on "
            "both sides";
      if (refusal == wire::RefusalReason::kOtherVersion) {
        why = "found one of another version of the datagrams; this program speaks version " +
              std::to_string(wire::kVersion);
      }
      throw DeviceUnreachable("device-check: expected a device that nobody uses, " + why);
    }
    const DeviceCapabilities& can = program.welcome().capabilities;
    rate_hz_ = can.rate_hz;
    point_ = static_cast<std::size_t>(pushed_point(can));
    most_force_n_ = can.max_force_per_point_n;
    stand_in_s_ = can.max_stale_s;
    is_simulated_ = can.simulated && check_.believes_simulated;
    can_push_ = (check_.pushes || is_simulated_) && !check_.by_hand_step_s;
    push_n_ = is_simulated_ ? 2.0 : 0.5;
    if (!is_simulated_) {
      program.limit_by(core::ForceLimiter({.per_point_n = push_n_,
                                           .total_n = push_n_,
                                           .slew_n_per_s = kGentleSlew_n_per_s,
                                           .max_speed_m_per_s = kGentleSpeed_m_per_s},
                                          1.0 / rate_hz_));
    }
    // This keeps the hellos of others from being refused because of us.
    program.say_goodbye();
    port_pause(0.05);
  }

  void port_pause(double duration_s) {
    check_.open_port()->pause(std::llround(1e9 * duration_s));
  }

  /// Returns the refusal that a new program gets for these bytes.
  std::optional<wire::RefusalReason> refusal_of(std::span<const std::byte> bytes) {
    const auto port = check_.open_port();
    port->send(bytes, check_.server);
    const DatagramSeal unsealed(DatagramSeal::Side::kProgram, std::nullopt);
    std::array<std::byte, 2 * wire::kMaxBytes> heard;
    Address from;
    wire::Datagram datagram;
    constexpr int kMostTries = 300;
    for (int i = 0; i < kMostTries; ++i) {
      port->pause(1'000'000);
      const std::size_t size = port->receive(heard, from);
      if (size == 0) continue;
      if (unsealed.read(std::span(heard).first(size), datagram) != wire::Problem::kNone) {
        continue;
      }
      const auto* refusal = std::get_if<wire::Refusal>(&datagram.content);
      return refusal == nullptr ? std::nullopt : std::optional(refusal->reason);
    }
    return std::nullopt;
  }

  static std::vector<std::byte> bytes_of(const wire::Datagram& datagram,
                                         const std::optional<DeviceKey>& key) {
    std::array<std::byte, DatagramSeal::kMostBytes> bytes;
    const DatagramSeal seal(DatagramSeal::Side::kProgram, key);
    const std::size_t size = seal.write(datagram, bytes);
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
  }

  /// Returns a hello whose header has the next version, with the matching checksum.
  static std::vector<std::byte> hello_of_next_version(const wire::Datagram& hello) {
    std::vector<std::byte> bytes = bytes_of(hello, std::nullopt);
    const std::uint16_t version = wire::kVersion + 1;
    constexpr std::size_t kVersionAt = 4;
    std::memcpy(bytes.data() + kVersionAt, &version, sizeof version);
    const std::size_t content = bytes.size() - wire::kChecksumBytes;
    const std::uint32_t sum = crc32(std::span(bytes).first(content));
    std::memcpy(bytes.data() + content, &sum, sizeof sum);
    return bytes;
  }

  void judge_hellos(LinkProbe& program) {
    const wire::Datagram hello{.header = {.sent_ns = 1},
                               .content = wire::Hello{.token = token_++, .only_asks = true}};
    judge_.judge(kOtherVersion,
                 refusal_of(hello_of_next_version(hello)) == wire::RefusalReason::kOtherVersion,
                 "");
    DeviceKey wrong_key{};
    if (check_.key) wrong_key = *check_.key;
    wrong_key.front() ^= std::byte{1};
    judge_.judge(kBadKey,
                 refusal_of(bytes_of(hello, wrong_key)) == wire::RefusalReason::kOtherKey, "");
    if (check_.key) {
      judge_.skip(kUnknownStream,
                  "with a key nobody can tell who sealed what is of an unknown stream");
    } else {
      const wire::Datagram lost{.header = {.stream_id = 99, .sequence = 1, .sent_ns = 1},
                                .content = wire::Command{.arm_number = 1}};
      judge_.judge(
          kUnknownStream,
          refusal_of(bytes_of(lost, std::nullopt)) == wire::RefusalReason::kUnknownStream, "");
    }
    program.begin_anew(token_++);
    if (!program.connect(2.0)) {
      throw DeviceUnreachable(
          "device-check: expected a device that a program may come back to "
          "after its goodbye, found none that answers");
    }
  }

  void judge_states(LinkProbe& program) {
    // The connection settles in the first second.
    (void)program.talk(1.0, 0, core::zero_vectors());
    const States states = program.talk(1.0, 0, core::zero_vectors());
    const auto num_states = static_cast<double>(states.size());
    constexpr double kFewest = 0.65, kMost = 1.5;
    judge_.judge(kHalfRate, num_states > kFewest * rate_hz_ && num_states < kMost * rate_hz_,
                 fmt::format("{} states in a second, {:g} Hz told", states.size(), rate_hz_));
    if (states.size() < 2) return;
    std::vector<double> gaps_s;
    std::vector<std::uint32_t> steps;
    std::size_t num_risen = 0;
    for (std::size_t i = 1; i < states.size(); ++i) {
      gaps_s.push_back(1e-9 * static_cast<double>(states[i].came_ns - states[i - 1].came_ns));
      steps.push_back(states[i].header.sequence - states[i - 1].header.sequence);
      num_risen +=
          states[i].state.measured.device_time_ns > states[i - 1].state.measured.device_time_ns
              ? 1
              : 0;
    }
    std::ranges::sort(gaps_s);
    const double late_s = gaps_s[static_cast<std::size_t>(0.99 * num_states) - 1];
    judge_.judge(kJitter, late_s <= stand_in_s_,
                 fmt::format("{:.1f} ms between 99 of 100, {:g} ms may be stood in for",
                             1e3 * late_s, 1e3 * stand_in_s_));
    const auto num_wrong = std::ranges::count_if(steps, [](auto step) { return step != 1; });
    const bool are_wrong = static_cast<double>(num_wrong) > 0.2 * num_states;
    const bool stand_still = std::ranges::find(steps, 0U) != steps.end();
    judge_.judge(kSequenceStep, !are_wrong || stand_still,
                 are_wrong && !stand_still
                     ? fmt::format("they go on by {}", *std::ranges::min_element(steps))
                     : "");
    judge_.judge(kSequenceWrap, !are_wrong || !stand_still,
                 are_wrong && stand_still
                     ? fmt::format("they stay at {}", states.back().header.sequence)
                     : "");
    double largest_m = 0.0;
    for (const Seen& seen : states) {
      for (const auto& at : seen.state.measured.tip_position_m) {
        largest_m = std::max(largest_m, at.norm());
      }
      for (const auto& speed : seen.state.measured.tip_velocity_m_per_s) {
        largest_m = std::max(largest_m, speed.norm());
      }
    }
    constexpr double kLargestOfAHand = 20.0;
    judge_.judge(kUnits, largest_m < kLargestOfAHand,
                 fmt::format("the largest position or velocity is {:.3g}", largest_m));
    const DeviceCapabilities& can = program.welcome().capabilities;
    std::string unlikely = unlikely_numbers(can);
    // Positions of another unit are the fault of the rule before.
    if (unlikely.empty() && largest_m < kLargestOfAHand) {
      unlikely = beyond_what_is_told(can, measured_in(states));
    }
    judge_.judge(kTellsOfAHand, unlikely.empty(), unlikely);
    judge_.judge(
        kStale, static_cast<double>(num_risen) > 0.5 * num_states,
        fmt::format("the device time rose {} times in {} states", num_risen, states.size()));
    const double ours_ns = static_cast<double>(states.back().came_ns - states.front().came_ns);
    const double device_ratio =
        static_cast<double>(states.back().state.measured.device_time_ns -
                            states.front().state.measured.device_time_ns) /
        ours_ns;
    // A simulation whose ticks are late is slower than real time.
    constexpr double kSlowest = 0.3, kFastest = 1.5;
    judge_.judge(kTime, device_ratio > kSlowest && device_ratio < kFastest,
                 fmt::format("in a second it went on by {:.3g} s", device_ratio));
    const bool are_echoes = std::ranges::all_of(
        states, [&](const Seen& seen) { return program.has_sent_at(seen.header.echo_ns); });
    judge_.judge(kEcho, are_echoes, are_echoes ? "" : "a clock that was never sent");
  }

  void judge_by_hand(LinkProbe& program) {
    check_by_hand({.can = program.welcome().capabilities,
                   .step_s = *check_.by_hand_step_s,
                   .watch =
                       [&](double duration_s) {
                         return measured_in(program.talk(duration_s, 0, core::zero_vectors()));
                       },
                   .prompt = check_.prompt},
                  judge_);
  }

  void skip_pushes(LinkProbe&) {
    if (!check_.by_hand_step_s) judge_.skip(kSlowVelocity, kNoPush);
    for (const DeviceRule& rule :
         {kArmsWithForce, kArming, kForceSign, kVelocity, kToldAsSent, kActed, kPoints,
          kForceSize, kNoLimits, kReplay, kSilence, kRearms, kHalt}) {
      judge_.skip(rule, check_.by_hand_step_s ? kHandIsIn : kNoPush);
    }
  }

  void judge_arming(LinkProbe& program) {
    const States& states =
        program.talk(0.3, 1, push_of(static_cast<int>(point_), {0.5 * push_n_, 0.0, 0.0}));
    judge_.judge(
        kArmsWithForce,
        !std::ranges::any_of(states, [](const Seen& seen) { return seen.state.armed; }), "");
    const bool arms = program.arm(2);
    const States& at_zero = program.talk(0.3, 0, core::zero_vectors());
    const bool arms_at_zero = std::ranges::any_of(at_zero, [](const Seen& seen) {
      return seen.state.armed && seen.state.armed_number == 0;
    });
    judge_.judge(kArming, arms && !arms_at_zero,
                 arms_at_zero ? "it arms at the number 0, which asks for none" : "");
  }

  /// Returns the position of the pushed point, m.
  [[nodiscard]] Eigen::Vector3d place_of(const States& states) const {
    return states.empty() ? Eigen::Vector3d::Zero().eval()
                          : states.back().state.measured.tip_position_m[point_];
  }

  /// Returns the sum of the velocities over the device's time.
  [[nodiscard]] double way_by_velocity_m(const States& states, int axis) const {
    double way_m = 0.0;
    for (std::size_t i = 1; i < states.size(); ++i) {
      const core::HapticState& now = states[i].state.measured;
      const auto step_ns = now.device_time_ns - states[i - 1].state.measured.device_time_ns;
      way_m += 1e-9 * static_cast<double>(step_ns) * now.tip_velocity_m_per_s[point_][axis];
    }
    return way_m;
  }

  static std::vector<core::HapticState> measured_in(const States& states) {
    std::vector<core::HapticState> measured;
    for (const Seen& seen : states) measured.push_back(seen.state.measured);
    return measured;
  }

  void judge_pushes(LinkProbe& program) {
    std::string wrong, fast;
    int num_tried = 0;
    bool any_acted = false, is_told_in_time = true;
    VelocityLagJudge lag;
    DeviceCapabilities can = program.welcome().capabilities;
    can.tells_acting_force = true;  // Every state does.
    PushJudge pushes(can);
    for (int axis = 0; axis < 3; ++axis) {
      (void)program.arm(arm_number_++);
      const States before = program.talk(0.3, arm_number_ - 1, core::zero_vectors());
      Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
      force_n[axis] = push_n_;
      const States states =
          program.talk(0.15, arm_number_ - 1, push_of(static_cast<int>(point_), force_n));
      std::vector<core::HapticState> moved = measured_in(states);
      for (const Seen& seen : program.talk(0.3, arm_number_ - 1, core::zero_vectors())) {
        moved.push_back(seen.state.measured);
      }
      lag.observe(moved, point_);
      pushes.observe({.point = static_cast<int>(point_),
                      .force_n = force_n,
                      .before = measured_in(before),
                      .during = measured_in(states)});
      const auto acting = std::ranges::find_if(states, acts);
      if (acting == states.end() || before.empty()) {
        wrong += fmt::format("{}not at all along {}", wrong.empty() ? "" : ", ", "xyz"[axis]);
        continue;
      }
      any_acted = true;
      const bool is_still = stands_still(measured_in(before), point_, axis);
      num_tried += is_still ? 1 : 0;
      const double moved_m = (place_of(states) - place_of(before))[axis];
      if (is_still && moved_m < kLeastMoved_m)
        wrong += fmt::format("{}{:+.1f} mm along {}", wrong.empty() ? "" : ", ", 1e3 * moved_m,
                             "xyz"[axis]);
      const double way_m = way_by_velocity_m(states, axis);
      const double own_way_m = (states.back().state.measured.tip_position_m[point_] -
                                states.front().state.measured.tip_position_m[point_])[axis];
      constexpr double kShare = 0.25, kResolution_m = 0.0005;
      if (std::fabs(way_m - own_way_m) > kShare * std::fabs(own_way_m) + kResolution_m) {
        fast +=
            fmt::format("{}{:.1f} mm by velocity and {:.1f} mm by position along {}",
                        fast.empty() ? "" : ", ", 1e3 * way_m, 1e3 * own_way_m, "xyz"[axis]);
      }
      const double speed_m_per_s = kLeastSpeed_m_per_s * push_n_ / 2.0;
      const auto moving = std::ranges::find_if(states, [&](const Seen& seen) {
        return std::fabs(seen.state.measured.tip_velocity_m_per_s[point_][axis]) >
               speed_m_per_s;
      });
      const bool is_late = is_still && (moving == states.end() ||
                                        static_cast<double>(moving - acting) > 0.02 * rate_hz_);
      is_told_in_time &= !is_late;
    }
    if (!any_acted) {
      judge_.judge(
          kForceSign, false,
          "no state tells that a force acted: tell it in acted_n, and arm when asked to");
      judge_.skip(kToldAsSent, "no force acted");
      judge_.skip(kVelocity, "no force acted");
      for (const DeviceRule& rule : {kSlowVelocity, kActed, kPoints, kForceSize}) {
        judge_.skip(rule, "no force acted");
      }
      return;
    }
    judge_.judge(kVelocity, fast.empty(), fast);
    lag.judge(judge_);
    push_other_points(program, pushes);
    pushes.judge(judge_);
    if (num_tried == 0 && wrong.empty()) {
      judge_.skip(kForceSign, kHidesPush);
      return judge_.skip(kToldAsSent, kHidesPush);
    }
    judge_.judge(kForceSign, wrong.empty(),
                 wrong.empty() ? "" : "pushed along the axis it moved " + wrong);
    judge_.judge(kToldAsSent, is_told_in_time,
                 is_told_in_time ? "" : "the hand moves long after the force is told to act");
  }

  void push_other_points(LinkProbe& program, PushJudge& pushes) {
    const DeviceCapabilities& can = program.welcome().capabilities;
    const Eigen::Vector3d force_n = {push_n_, 0.0, 0.0};
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      if (!can.has_point(point) || point == static_cast<int>(point_)) continue;
      (void)program.arm(arm_number_++);
      const std::vector<core::HapticState> before =
          measured_in(program.talk(0.3, arm_number_ - 1, core::zero_vectors()));
      const std::vector<core::HapticState> pushed =
          measured_in(program.talk(0.15, arm_number_ - 1, push_of(point, force_n)));
      pushes.observe({.point = point, .force_n = force_n, .before = before, .during = pushed});
    }
    (void)program.talk(0.3, arm_number_ - 1, core::zero_vectors());
  }

  void judge_limits(LinkProbe& program) {
    if (!is_simulated_) {
      judge_.skip(kNoLimits, "a real device is never asked for too much");
      return;
    }
    (void)program.arm(arm_number_++);
    const States states = program.talk(
        0.03, arm_number_ - 1, push_of(static_cast<int>(point_), {kTooMuch_n, 0.0, 0.0}));
    constexpr double kSlew_n_per_s = 2000.0, kRounding_n = 1e-6;
    double most_n = 0.0, most_step_n = 0.0, last_n = 0.0;
    for (const Seen& seen : states) {
      const double told_n = seen.state.measured.acted_n[point_].norm();
      most_n = std::max(most_n, told_n);
      most_step_n = std::max(most_step_n, told_n - last_n);
      last_n = told_n;
    }
    // If states were lost, their steps add up.
    const bool is_slow = most_step_n <= 3.0 * kSlew_n_per_s / rate_hz_ + kRounding_n;
    if (most_n == 0.0) {
      judge_.skip(kNoLimits, kNothingActed);
    } else {
      judge_.judge(
          kNoLimits, most_n <= most_force_n_ + kRounding_n && is_slow,
          fmt::format("asked for {:g} N, {:.1f} N acted, at most {:.1f} N more in a tick",
                      kTooMuch_n, most_n, most_step_n));
    }
    (void)program.talk(0.5, arm_number_ - 1, core::zero_vectors());
  }

  /// Arms the device and pushes. Returns whether a force acted; if not, nothing is known of how
  /// it would end.
  bool acts_when_pushed(LinkProbe& program) {
    (void)program.arm(arm_number_++);
    const States& states = program.talk(0.04, arm_number_ - 1,
                                        push_of(static_cast<int>(point_), {push_n_, 0.0, 0.0}));
    return std::ranges::any_of(states, acts);
  }

  void judge_replay(LinkProbe& program) {
    if (!acts_when_pushed(program)) return judge_.skip(kReplay, kNothingActed);
    const std::vector<std::byte> old = program.last_command();
    (void)program.talk(0.1, arm_number_ - 1, core::zero_vectors());
    const States& states = program.talk(0.1, arm_number_ - 1, core::zero_vectors(),
                                        [&] { program.send_again(old); });
    judge_.judge(kReplay, std::ranges::none_of(states, acts), "");
  }

  void judge_silence(LinkProbe& program) {
    if (!acts_when_pushed(program)) {
      for (const DeviceRule& rule : {kSilence, kRearms, kHalt})
        judge_.skip(rule, kNothingActed);
      return;
    }
    const States told = program.listen(0.3);
    const double allowed_s = stand_in_s_ + kWayThere_s;
    const std::int64_t begin_ns = told.empty() ? 0 : told.front().came_ns;
    const auto over = std::ranges::find_if_not(told, is_armed_or_acts);
    const double took_s =
        over == told.end() ? 0.3 : 1e-9 * static_cast<double>(over->came_ns - begin_ns);
    judge_.judge(kSilence,
                 over != told.end() && took_s <= allowed_s &&
                     !any_after(told, static_cast<std::size_t>(over - told.begin())),
                 told.empty() ? "it fell silent, too"
                              : fmt::format("force for {:.0f} ms, {:.0f} ms are allowed",
                                            1e3 * took_s, 1e3 * allowed_s));
    const States again = program.talk(0.3, arm_number_ - 1,
                                      push_of(static_cast<int>(point_), {push_n_, 0.0, 0.0}));
    judge_.judge(kRearms, !any_after(again, kUnderWay), "");
    if (!acts_when_pushed(program)) return judge_.skip(kHalt, kNothingActed);
    program.halt();
    const States halted = program.talk(0.1, arm_number_ - 1,
                                       push_of(static_cast<int>(point_), {push_n_, 0.0, 0.0}));
    judge_.judge(kHalt, !any_after(halted, kUnderWay), "");
  }

  void judge_others(LinkProbe& program) {
    const auto port = check_.open_port();
    LinkProbe second(*port, check_.server, check_.key, token_++);
    (void)program.talk(0.2, 0, core::zero_vectors(), [&] { second.say_hello(); });
    judge_.judge(kBusy,
                 !second.is_connected() && second.refusal() == wire::RefusalReason::kBusy, "");
    if (second.is_connected()) second.say_goodbye();
    program.say_goodbye();
    port_pause(0.05);
    const auto next_port = check_.open_port();
    LinkProbe next(*next_port, check_.server, check_.key, token_++);
    const bool is_let_in = next.connect(2.0);
    judge_.judge(kGoodbye,
                 is_let_in && std::ranges::none_of(next.talk(0.1, 0, core::zero_vectors()),
                                                   is_armed_or_acts),
                 is_let_in ? "" : "it lets nobody in");
    if (!is_let_in) return;
    // The program behaves as if it had died.
    port_pause(kGoneAfter_s);
    const auto last_port = check_.open_port();
    LinkProbe last(*last_port, check_.server, check_.key, token_++);
    judge_.judge(kGone, last.connect(2.0), "");
    if (last.is_connected()) last.say_goodbye();
  }

  static constexpr char kNothingActed[] = "no force acted that could end";
  static constexpr double kLeastMoved_m = 0.0002, kLeastSpeed_m_per_s = 0.005;
  /// On a real device these limits end a push that gets out of control.
  static constexpr double kGentleSlew_n_per_s = 100.0, kGentleSpeed_m_per_s = 0.5;
  static constexpr double kTooMuch_n = 100.0, kWayThere_s = 0.030, kGoneAfter_s = 1.3;
  /// Number of states that may have been sent before.
  static constexpr std::size_t kUnderWay = 5;

  const NetworkCheck& check_;
  RuleJudge judge_;
  std::uint64_t token_ = 1;
  std::uint32_t arm_number_ = 3;
  double rate_hz_ = 1000.0, most_force_n_ = 0.0, stand_in_s_ = 0.0, push_n_ = 0.0;
  bool is_simulated_ = false, can_push_ = false;
  std::size_t point_ = 0;  ///< The point that is pushed.
};

}  // namespace

bool check_network_device(const NetworkCheck& check, const TellOutcome& tell) {
  return NetworkChecker(check, tell).run();
}

}  // namespace jnd::device
