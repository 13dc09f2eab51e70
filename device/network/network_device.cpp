#include "device/network/network_device.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/require.h"
#include "device/network/udp_port.h"

namespace jnd::device {
namespace {

using core::Fault;

/// More than come in a tick, and few enough that a flood costs no tick.
constexpr int kMostTaken = 64;
constexpr std::int64_t kHelloEvery_ns = 50'000'000;
/// Without a state for so long, the stream is given up.
constexpr std::int64_t kStreamOver_ns = 200'000'000;
/// From opening the device to the first ticks of a loop a program may take its time.
constexpr std::int64_t kGrace_ns = 200'000'000;

std::int64_t nanoseconds(double duration_s) { return std::llround(1e9 * duration_s); }

bool is_same(const wire::Welcome& a, const wire::Welcome& b) noexcept {
  const DeviceCapabilities& one = a.capabilities;
  const DeviceCapabilities& other = b.capabilities;
  return a.name == b.name && one.num_contact_points == other.num_contact_points &&
         one.rate_hz == other.rate_hz &&
         one.max_force_per_point_n == other.max_force_per_point_n &&
         one.max_total_force_n == other.max_total_force_n && one.simulated == other.simulated &&
         one.num_joints == other.num_joints && one.moves_by_itself == other.moves_by_itself;
}

std::string shown(double number) {
  std::string digits = std::to_string(number);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

}  // namespace

NetworkDevice::NetworkDevice(std::unique_ptr<DatagramPort> port, const Address& server,
                             const Parameters& parameters)
    : port_(std::move(port)),
      server_(server),
      parameters_(parameters),
      max_stale_ns_(nanoseconds(parameters.max_stale_s)),
      token_(parameters.token),
      quality_(parameters.quality),
      sequence_(parameters.first_sequence) {
  const auto positive = [](double value, const char* field) {
    core::require(value > 0.0 && std::isfinite(value), field, "a finite number > 0", value);
  };
  positive(parameters.rate_hz, "rate_hz");
  positive(parameters.max_stale_s, "max_stale_s");
  positive(parameters.patience_s, "patience_s");
}

NetworkDevice::~NetworkDevice() { close(); }

std::string_view NetworkDevice::served_name() const noexcept {
  if (!device_) return "";
  const auto end = std::find(device_->name.begin(), device_->name.end(), '\0');
  return {device_->name.data(), static_cast<std::size_t>(end - device_->name.begin())};
}

DeviceCapabilities NetworkDevice::capabilities() const noexcept {
  DeviceCapabilities can =
      device_ ? device_->capabilities : DeviceCapabilities{.rate_hz = parameters_.rate_hz};
  can.max_stale_s = std::max(can.max_stale_s, parameters_.max_stale_s);
  can.has_own_clock = true;
  return can;
}

SimulatedHand* NetworkDevice::simulated_hand() noexcept {
  const DeviceCapabilities can = capabilities();
  return can.simulated && can.moves_by_itself ? &hand_ : nullptr;
}

void NetworkDevice::ask() {
  device_.reset();
  const std::int64_t deadline_ns = port_->now_ns() + nanoseconds(parameters_.patience_s);
  last_hello_ns_ = 0;
  for (std::int64_t now_ns = port_->now_ns(); now_ns < deadline_ns; now_ns = port_->now_ns()) {
    take_in(now_ns);
    if (device_ || other_version_ != 0) break;
    say_hello(true, now_ns);
    port_->pause(1'000'000);
  }
  if (!device_) throw DeviceUnreachable(what_is_wrong());
}

/// The loop's rate and the device's own.
void NetworkDevice::require_same_rate() const {
  const double rate_hz = device_->capabilities.rate_hz;
  if (std::abs(rate_hz / parameters_.rate_hz - 1.0) <= 0.001) return;
  throw core::Error("network " + text_of(server_) + ": expected a device at " +
                    shown(parameters_.rate_hz) + " Hz, found " + std::string(served_name()) +
                    " at " + shown(rate_hz) +
                    " Hz; start it with the rate that the study asks for");
}

void NetworkDevice::open() {
  close();
  if (!device_) ask();
  require_same_rate();
  hand_.reset();
  ++token_;
  refusal_.reset();
  is_another_ = false;
  phase_ = Phase::kSeeking;
  last_hello_ns_ = 0;
  first_read_ns_ = 0;
  const std::int64_t deadline_ns = port_->now_ns() + nanoseconds(parameters_.patience_s);
  for (std::int64_t now_ns = port_->now_ns(); now_ns < deadline_ns; now_ns = port_->now_ns()) {
    take_in(now_ns);
    judge(now_ns);
    if (phase_ == Phase::kUp) return;
    speak(core::zero_vectors(), now_ns);
    port_->pause(nanoseconds(1.0 / parameters_.rate_hz));
  }
  const std::string why = what_is_wrong();
  close();
  throw DeviceUnreachable(why);
}

std::string NetworkDevice::what_is_wrong() const {
  const std::string place = "network " + text_of(server_) + ": expected ";
  if (other_version_ != 0) {
    return place + "datagrams of version " + std::to_string(wire::kVersion) +
           ", found version " + std::to_string(other_version_) +
           "; use the same release of this program on both sides";
  }
  if (is_another_) {
    return place + "the same device as before, found another; start the one that was there, " +
           "or this program anew";
  }
  if (phase_ == Phase::kArming) {
    const LinkCounts& counts = quality_.counts();
    if (quality_.is_settled() && !is_silent(port_->now_ns())) {
      return place + "the device to arm, found that it does not (" +
             std::string(newest_.fault == Fault::kNone ? device::name(newest_.level)
                                                       : core::name(newest_.fault)) +
             "); look at the device's own program";
    }
    return place + "a good connection, found an " +
           std::string(device::name(quality_.level())) + " one (" +
           std::to_string(counts.lost) + " of " +
           std::to_string(counts.lost + counts.received) + " datagrams lost, round trip " +
           shown(1e3 * quality_.round_trip_s()) + " ms); use a cable of its own";
  }
  if (refusal_ == wire::RefusalReason::kBusy) {
    return place + "a device that is free, found that another program uses it; end that one";
  }
  return place + "a device to answer, found none; start its program (`jnd device-simulator`) " +
         "and check address and port";
}

void NetworkDevice::close() noexcept {
  if (phase_ != Phase::kClosed) {
    // Twice, for there is no answer; the device would notice the silence, too.
    send(wire::Goodbye{}, port_->now_ns());
    send(wire::Goodbye{}, port_->now_ns());
  }
  phase_ = Phase::kClosed;
  fault_ = Fault::kNone;
  stream_id_ = 0;
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

/// Between `open` and the first ticks the device may have missed commands, and disarmed itself
/// before there was any force: nobody needs to know.
bool NetworkDevice::is_trusted(std::int64_t now_ns) const noexcept {
  if (phase_ == Phase::kUp) return true;
  return phase_ == Phase::kArming && fault_ == Fault::kLinkLost &&
         now_ns - first_read_ns_ < kGrace_ns;
}

bool NetworkDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  for (const Eigen::Vector3d& force : force_on_hand_n) {
    if (force.allFinite()) continue;
    // The device would refuse the datagram, and go on with the force before.
    lose(Fault::kNonFiniteForce, phase_ == Phase::kUp ? Phase::kArming : phase_);
  }
  const std::int64_t now_ns = port_->now_ns();
  speak(phase_ == Phase::kUp ? force_on_hand_n : core::zero_vectors(), now_ns);
  return is_trusted(now_ns);
}

void NetworkDevice::halt() noexcept {
  const std::uint64_t stream_id = stream_id_.load();
  if (stream_id == 0) return;
  const wire::Datagram datagram{.header = {.stream_id = stream_id,
                                           .sequence = sequence_.fetch_add(1),
                                           .sent_ns = port_->now_ns()},
                                .content = wire::Halt{}};
  std::array<std::byte, wire::kMaxBytes> bytes;
  const std::size_t size = wire::encode(datagram, bytes);
  port_->send(std::span(bytes).first(size), server_);
}

void NetworkDevice::take_in(std::int64_t now_ns) noexcept {
  std::array<std::byte, 2 * wire::kMaxBytes> bytes;
  Address from;
  for (int i = 0; i < kMostTaken; ++i) {
    const std::size_t size = port_->receive(bytes, from);
    if (size == 0) return;
    if (!(from == server_)) continue;
    const std::span<const std::byte> received = std::span(bytes).first(size);
    const wire::Problem problem = wire::decode(received, incoming_);
    if (problem != wire::Problem::kNone) {
      quality_.refused();
      if (problem == wire::Problem::kWrongVersion) other_version_ = wire::version_of(received);
      continue;
    }
    other_version_ = 0;
    std::visit([&](const auto& content) { take(incoming_.header, content, now_ns); },
               incoming_.content);
  }
}

void NetworkDevice::take(const wire::Header& header, const wire::Welcome& welcome,
                         std::int64_t now_ns) noexcept {
  if (welcome.token != token_) return;
  if (header.stream_id == 0) {
    if (!device_) device_ = welcome;
    return;
  }
  if (phase_ != Phase::kSeeking) return;
  is_another_ = !is_same(*device_, welcome);
  if (is_another_) return;
  refusal_.reset();
  stream_id_ = header.stream_id;
  quality_.restart();
  newest_.armed = false;
  newest_.armed_number = 0;
  newest_ns_ = now_ns;
  peer_sent_ns_ = last_echo_ns_ = 0;
  arm_number_ = 1;
  phase_ = Phase::kArming;
}

void NetworkDevice::take(const wire::Header& header, const wire::Refusal& refusal,
                         std::int64_t) noexcept {
  if (refusal.reason == wire::RefusalReason::kUnknownStream) {
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
  newest_ns_ = now_ns;
  peer_sent_ns_ = header.sent_ns;
  if (header.echo_ns != 0 && header.echo_ns != last_echo_ns_) {
    last_echo_ns_ = header.echo_ns;
    quality_.round_trip(now_ns - header.echo_ns);
  }
}

bool NetworkDevice::is_silent(std::int64_t now_ns) const noexcept {
  return now_ns - newest_ns_ >= max_stale_ns_;
}

/// It had granted the arming, and took it back.
bool NetworkDevice::has_disarmed() const noexcept {
  return !newest_.armed && newest_.armed_number == arm_number_;
}

void NetworkDevice::judge(std::int64_t now_ns) noexcept {
  if (phase_ == Phase::kUp) {
    if (is_silent(now_ns) || quality_.is_broken() ||
        quality_.level() == LinkLevel::kUnacceptable) {
      lose(Fault::kLinkLost, Phase::kArming);
    } else if (has_disarmed() || !newest_.is_measured) {
      lose(newest_.fault != Fault::kNone ? newest_.fault : Fault::kLinkLost, Phase::kArming);
    }
    return;
  }
  if (phase_ != Phase::kArming) return;
  if (now_ns - newest_ns_ >= kStreamOver_ns) {
    phase_ = Phase::kSeeking;
    ++token_;
  } else if (quality_.is_broken()) {
    quality_.restart();
  } else if (has_disarmed()) {
    ++arm_number_;
  } else if (newest_.armed && newest_.armed_number == arm_number_ && newest_.is_measured &&
             quality_.is_settled() && !is_silent(now_ns)) {
    phase_ = Phase::kUp;
    fault_ = Fault::kNone;
  }
}

void NetworkDevice::lose(Fault fault, Phase phase) noexcept {
  fault_ = fault;
  phase_ = phase;
  ++arm_number_;
  quality_.restart();
  if (phase == Phase::kSeeking) ++token_;
}

void NetworkDevice::speak(const core::PointVectors& force_on_hand_n,
                          std::int64_t now_ns) noexcept {
  if (phase_ == Phase::kClosed) return;
  if (phase_ == Phase::kSeeking) return say_hello(false, now_ns);
  send(wire::Command{.arm_number = arm_number_,
                     .answered_sequence = newest_sequence_,
                     .force_on_hand_n = force_on_hand_n},
       now_ns);
  if (const wire::Order* order = hand_.order_after(newest_)) send(*order, now_ns);
}

void NetworkDevice::say_hello(bool only_asks, std::int64_t now_ns) noexcept {
  if (last_hello_ns_ != 0 && now_ns - last_hello_ns_ < kHelloEvery_ns) return;
  last_hello_ns_ = now_ns;
  const wire::Datagram datagram{
      .header = {.sent_ns = now_ns},
      .content = wire::Hello{.token = token_, .only_asks = only_asks}};
  std::array<std::byte, wire::kMaxBytes> bytes;
  const std::size_t size = wire::encode(datagram, bytes);
  port_->send(std::span(bytes).first(size), server_);
}

void NetworkDevice::send(const wire::Content& content, std::int64_t now_ns) noexcept {
  const wire::Datagram datagram{.header = {.stream_id = stream_id_,
                                           .sequence = sequence_.fetch_add(1),
                                           .sent_ns = now_ns,
                                           .echo_ns = peer_sent_ns_},
                                .content = content};
  std::array<std::byte, wire::kMaxBytes> bytes;
  const std::size_t size = wire::encode(datagram, bytes);
  port_->send(std::span(bytes).first(size), server_);
}

}  // namespace jnd::device
