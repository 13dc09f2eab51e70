#include "device/network/network_device.h"

#include <algorithm>
#include <cmath>

namespace jnd::device {
namespace {

using core::Fault;

/// More than arrive in a tick, but few enough that a flood costs no tick.
constexpr int kMostTakenByHost = 64;
constexpr std::int64_t kHelloEvery_ns = 50'000'000;
/// The stream is given up after this time without a state.
constexpr std::int64_t kStreamOver_ns = 200'000'000;
/// A program may take this time between opening the device and the first ticks of its loop.
constexpr std::int64_t kGrace_ns = 200'000'000;
/// This is added to the time for which states may be missing: some twenty lost commands, and
/// the way there and back.
constexpr std::int64_t kMostDeaf_ns = 40'000'000;
/// Commands in a row that the system does not take. They are fewer than the device's watchdog
/// needs.
constexpr int kMostFailedSends = 5;
/// For simulations, which cannot hurt anybody; simulated devices themselves use the same value.
constexpr double kSimulatedWatchdog_s = 0.250;
/// Limit of what a device may ask for, because a hand moves on while its measurement is reused.
constexpr double kMostStaleOfReal_s = 0.020;

bool has_force(const core::PointVectors& force_n) noexcept {
  return std::any_of(force_n.begin(), force_n.end(),
                     [](const Eigen::Vector3d& force) { return !force.isZero(0.0); });
}

std::string_view words_of(const wire::DeviceText& text) noexcept {
  const auto* const end = std::find(text.begin(), text.end(), '\0');
  return {text.data(), static_cast<std::size_t>(end - text.begin())};
}

bool is_same(const wire::Welcome& a, const wire::Welcome& b) noexcept {
  const DeviceCapabilities& one = a.capabilities;
  const DeviceCapabilities& other = b.capabilities;
  return a.name == b.name && a.serial == b.serial && one.share_ratio == other.share_ratio &&
         one.channels == other.channels && one.max_slew_n_per_s == other.max_slew_n_per_s &&
         one.max_speed_m_per_s == other.max_speed_m_per_s &&
         one.workspace.half_width_x_m == other.workspace.half_width_x_m &&
         one.workspace.half_width_y_m == other.workspace.half_width_y_m &&
         one.workspace.half_width_z_m == other.workspace.half_width_z_m &&
         one.rate_hz == other.rate_hz &&
         one.max_force_per_point_n == other.max_force_per_point_n &&
         one.max_total_force_n == other.max_total_force_n && one.simulated == other.simulated &&
         one.num_joints == other.num_joints && one.moves_by_itself == other.moves_by_itself &&
         one.takes_orders == other.takes_orders;
}

}  // namespace

std::string_view NetworkDevice::served_name() const noexcept {
  return device_ ? words_of(device_->name) : std::string_view();
}

DeviceIdentity NetworkDevice::identity() const {
  if (!device_) return {};
  return {.model = std::string(words_of(device_->name)),
          .serial = std::string(words_of(device_->serial)),
          .firmware = std::string(words_of(device_->firmware))};
}

DeviceCapabilities NetworkDevice::capabilities() const noexcept {
  DeviceCapabilities can =
      device_ ? device_->capabilities : DeviceCapabilities{.rate_hz = parameters_.rate_hz};
  can.says_simulated = can.simulated;
  can.simulated = can.simulated && parameters_.believes_simulated;
  can.max_stale_s = std::max(can.max_stale_s, parameters_.max_stale_s);
  if (!can.simulated) can.max_stale_s = std::min(can.max_stale_s, kMostStaleOfReal_s);
  can.has_own_clock = true;
  can.tells_acting_force = true;  // Every state reports it.
  if (can.simulated) can.watchdog_timeout_s = kSimulatedWatchdog_s;
  return can;
}

std::optional<LinkReport> NetworkDevice::link() const noexcept {
  const LinkCounts& counts = quality_.counts();
  const auto sent = static_cast<double>(counts.received + counts.lost);
  const LinkLevel level = std::min(quality_.level(), newest_.level);
  return LinkReport{.level = device::name(level),
                    .may_arm = level >= LinkLevel::kGood,
                    .may_give_force = level > LinkLevel::kUnacceptable,
                    .lost_ratio = sent > 0.0 ? static_cast<double>(counts.lost) / sent : 0.0,
                    .round_trip_s = quality_.round_trip_s()};
}

SimulatedHand* NetworkDevice::simulated_hand() noexcept {
  const DeviceCapabilities can = capabilities();
  return can.simulated && can.moves_by_itself && can.takes_orders ? &hand_ : nullptr;
}

bool NetworkDevice::read(core::HapticState& state) noexcept {
  const std::int64_t now_ns = port_->now_ns();
  if (first_read_ns_ == 0) first_read_ns_ = now_ns;
  take_in(now_ns);
  quality_.end_tick();
  judge(now_ns);
  if (!is_trusted(now_ns)) return false;
  state = newest_.measured;
  return true;
}

/// Between `open` and the first ticks the device may have missed commands and disarmed itself.
/// Before there was any force, this is not reported.
bool NetworkDevice::is_trusted(std::int64_t now_ns) const noexcept {
  if (phase_ == Phase::kUp) return true;
  return phase_ == Phase::kArming && fault_ == Fault::kLinkLost && !had_force_ &&
         now_ns - first_read_ns_ < kGrace_ns;
}

bool NetworkDevice::may_arm() const noexcept {
  return phase_ == Phase::kUp && quality_.is_settled() && newest_.level >= LinkLevel::kGood;
}

bool NetworkDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  had_force_ |= has_force(force_on_hand_n);
  for (const Eigen::Vector3d& force : force_on_hand_n) {
    if (force.allFinite()) continue;
    // The device would refuse the datagram and continue with the force before.
    lose(Fault::kNonFiniteForce, phase_ == Phase::kUp ? Phase::kArming : phase_);
  }
  const std::int64_t now_ns = port_->now_ns();
  speak(phase_ == Phase::kUp ? force_on_hand_n : core::zero_vectors(), now_ns);
  return is_trusted(now_ns);
}

void NetworkDevice::halt() noexcept {
  const std::uint64_t stream_id = stream_id_.load();
  if (stream_id == 0) return;
  // `seal_` belongs to the loop's thread, so this needs one of its own.
  DatagramSeal seal(DatagramSeal::Side::kProgram, parameters_.key);
  seal.begin_stream(stream_token_.load(), stream_id);
  const wire::Datagram datagram{.header = {.stream_id = stream_id,
                                           .sequence = sequence_.fetch_add(1),
                                           .sent_ns = port_->now_ns()},
                                .content = wire::Halt{}};
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const std::size_t size = seal.write(datagram, bytes);
  port_->send(std::span(bytes).first(size), server_);
}

void NetworkDevice::take_in(std::int64_t now_ns) noexcept {
  std::array<std::byte, 2 * wire::kMaxBytes> bytes;
  Address from;
  for (int i = 0; i < kMostTakenByHost; ++i) {
    const std::size_t size = port_->receive(bytes, from);
    if (size == 0) return;
    if (!(from == server_)) continue;
    const std::span<const std::byte> received = std::span(bytes).first(size);
    const wire::Problem problem = seal_.read(received, incoming_);
    if (problem != wire::Problem::kNone) {
      quality_.refused();
      if (problem != wire::Problem::kOtherKey && phase_ != Phase::kUp) keep_refused(received);
      has_other_key_ |= problem == wire::Problem::kOtherKey;
      if (problem == wire::Problem::kWrongVersion) other_version_ = wire::version_of(received);
      continue;
    }
    other_version_ = 0;
    has_other_key_ = false;
    wire::visit_content(incoming_.content,
                        [&](const auto& content) { take(incoming_.header, content, now_ns); });
  }
}

/// So that it can be said what was wrong with it.
void NetworkDevice::keep_refused(std::span<const std::byte> bytes) noexcept {
  ++num_refused_;
  // Without the seal, which was sound.
  const std::size_t seal = seal_.has_key() ? DatagramSeal::kBytes : 0;
  refused_size_ = std::min(bytes.size() - std::min(seal, bytes.size()), refused_.size());
  std::copy_n(bytes.begin(), refused_size_, refused_.begin());
}

void NetworkDevice::take(const wire::Header& header, const wire::Welcome& welcome,
                         std::int64_t now_ns) noexcept {
  if (welcome.token != token_) return;
  // A new challenge is worth another hello at once.
  if (challenge_ != welcome.challenge) last_hello_ns_ = 0;
  challenge_ = welcome.challenge;
  if (header.stream_id == 0) {
    if (!device_) device_ = welcome;
    return;
  }
  if (phase_ != Phase::kSeeking) return;
  is_another_ = !is_same(*device_, welcome);
  if (is_another_) return;
  refusal_.reset();
  stream_id_ = header.stream_id;
  stream_token_ = token_;
  seal_.begin_stream(token_, header.stream_id);
  quality_.restart(device_->capabilities.rate_hz);
  newest_.armed = false;
  newest_.armed_number = 0;
  newest_.measured.arrived_ns = port_->arrived_ns();
  newest_.measured.channels.bits = device_->capabilities.channels;
  newest_ns_ = now_ns;
  peer_sent_ns_ = 0;
  arm_number_ = 1;
  phase_ = Phase::kArming;
}

void NetworkDevice::take(const wire::Header& header, const wire::Refusal& refusal,
                         std::int64_t) noexcept {
  if (refusal.reason == wire::RefusalReason::kOtherKey) {
    has_other_key_ = true;
  } else if (refusal.reason == wire::RefusalReason::kUnknownStream) {
    if (seal_.has_key()) return;  // Whoever heard us could have provoked it.
    if (header.stream_id != stream_id_ || phase_ == Phase::kClosed) return;
    if (phase_ != Phase::kSeeking) lose(Fault::kLinkLost, Phase::kSeeking);
  } else if (refusal.token == token_) {
    refusal_ = refusal.reason;
  }
}

void NetworkDevice::take(const wire::Header& header, const wire::Goodbye&,
                         std::int64_t) noexcept {
  if (header.stream_id != stream_id_) return;
  if (phase_ == Phase::kArming || phase_ == Phase::kUp) lose(Fault::kLinkLost, Phase::kSeeking);
}

void NetworkDevice::take(const wire::Header& header, const wire::State& state,
                         std::int64_t now_ns) noexcept {
  if (header.stream_id != stream_id_) return;
  if (phase_ != Phase::kArming && phase_ != Phase::kUp) return;
  if (quality_.received(header.sequence) != LinkQuality::Verdict::kNewest) return;
  newest_ = state;
  newest_sequence_ = header.sequence;
  newest_.measured.arrived_ns = port_->arrived_ns();
  newest_.measured.channels.bits = device_->capabilities.channels;
  newest_ns_ = now_ns;
  peer_sent_ns_ = header.sent_ns;
  quality_.echoed(header.echo_ns, now_ns);
}

/// The device may ask for more patience than we have.
std::int64_t NetworkDevice::max_stale_ns() const noexcept {
  return std::llround(1e9 * capabilities().max_stale_s);
}

bool NetworkDevice::is_silent(std::int64_t now_ns) const noexcept {
  return now_ns - newest_ns_ >= max_stale_ns();
}

/// Whether states arrive that have seen nothing of what we sent.
bool NetworkDevice::is_deaf(std::int64_t now_ns) const noexcept {
  return now_ns - quality_.last_echo_ns() >= max_stale_ns() + kMostDeaf_ns;
}

/// Judges by the number that we requested, because an arming with another number is not ours.
bool NetworkDevice::is_armed() const noexcept {
  return newest_.armed && newest_.armed_number == arm_number_;
}

/// Whether the device had granted the arming and took it back.
bool NetworkDevice::has_disarmed() const noexcept {
  return !newest_.armed && newest_.armed_number == arm_number_;
}

void NetworkDevice::judge(std::int64_t now_ns) noexcept {
  if (phase_ == Phase::kUp) {
    if (is_silent(now_ns) || is_deaf(now_ns) || quality_.is_broken() ||
        quality_.level() == LinkLevel::kUnacceptable) {
      lose(Fault::kLinkLost, Phase::kArming);
    } else if (!is_armed() || !newest_.is_measured) {
      lose(newest_.fault != Fault::kNone ? newest_.fault : Fault::kLinkLost, Phase::kArming);
    }
    return;
  }
  if (phase_ != Phase::kArming) return;
  if (now_ns - newest_ns_ >= kStreamOver_ns) {
    phase_ = Phase::kSeeking;
    ++token_;
  } else if (quality_.is_broken()) {
    quality_.judge_anew();
  } else if (has_disarmed()) {
    ++arm_number_;
  } else if (is_armed() && newest_.is_measured && quality_.is_settled() && !is_silent(now_ns) &&
             !is_deaf(now_ns)) {
    phase_ = Phase::kUp;
    fault_ = Fault::kNone;
  }
}

void NetworkDevice::lose(Fault fault, Phase phase) noexcept {
  // A heartbeat exists only on this side. If the device reports its loss, the force is already
  // gone there and must not merely fade.
  fault_ = fault == Fault::kHeartbeatLost ? Fault::kLinkLost : fault;
  phase_ = phase;
  ++arm_number_;
  quality_.judge_anew();
  if (phase == Phase::kSeeking) ++token_;
}

void NetworkDevice::speak(const core::PointVectors& force_on_hand_n,
                          std::int64_t now_ns) noexcept {
  if (phase_ == Phase::kClosed) return;
  if (phase_ == Phase::kSeeking) return say_hello(false, now_ns);
  const bool sent = send(wire::Command{.arm_number = arm_number_,
                                       .answered_sequence = newest_sequence_,
                                       .force_on_hand_n = force_on_hand_n},
                         now_ns);
  num_failed_sends_ = sent ? 0 : std::min(num_failed_sends_ + 1, kMostFailedSends);
  if (num_failed_sends_ == kMostFailedSends && phase_ == Phase::kUp) {
    lose(Fault::kLinkLost, Phase::kArming);
  }
  if (const wire::Order* order = hand_.order_after(newest_)) send(*order, now_ns);
}

void NetworkDevice::say_hello(bool only_asks, std::int64_t now_ns) noexcept {
  if (last_hello_ns_ != 0 && now_ns - last_hello_ns_ < kHelloEvery_ns) return;
  last_hello_ns_ = now_ns;
  const wire::Datagram datagram{.header = {.sent_ns = now_ns},
                                .content = wire::Hello{.token = token_,
                                                       .only_asks = only_asks,
                                                       .challenge = challenge_,
                                                       .rate_hz = parameters_.rate_hz}};
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const std::size_t size = seal_.write(datagram, bytes);
  port_->send(std::span(bytes).first(size), server_);
}

bool NetworkDevice::send(const wire::Content& content, std::int64_t now_ns) noexcept {
  const wire::Datagram datagram{.header = {.stream_id = stream_id_,
                                           .sequence = sequence_.fetch_add(1),
                                           .sent_ns = now_ns,
                                           .echo_ns = peer_sent_ns_},
                                .content = content};
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const std::size_t size = seal_.write(datagram, bytes);
  return port_->send(std::span(bytes).first(size), server_);
}

}  // namespace jnd::device
