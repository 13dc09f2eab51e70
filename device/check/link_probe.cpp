#include "device/check/link_probe.h"

#include <algorithm>
#include <cmath>

namespace jnd::device {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

std::int64_t ns_of(double duration_s) { return std::llround(1e9 * duration_s); }

}  // namespace

LinkProbe::LinkProbe(DatagramPort& port, const Address& server,
                     const std::optional<DeviceKey>& key, std::uint64_t token)
    : port_(port), server_(server), seal_(DatagramSeal::Side::kProgram, key), token_(token) {}

void LinkProbe::begin_anew(std::uint64_t token) {
  token_ = token;
  challenge_ = 0;
  stream_id_ = 0;
  refusal_.reset();
  seen_.clear();
}

bool LinkProbe::connect(double timeout_s) {
  constexpr std::int64_t kHelloEvery_ns = 50 * kMillisecond_ns;
  const std::int64_t until_ns = port_.now_ns() + ns_of(timeout_s);
  std::int64_t hello_ns = 0;
  while (!is_connected() && port_.now_ns() < until_ns) {
    const std::uint64_t challenge = challenge_;
    if (port_.now_ns() >= hello_ns) {
      say_hello();
      hello_ns = port_.now_ns() + kHelloEvery_ns;
    }
    port_.pause(kMillisecond_ns);
    receive();
    // A new challenge is worth another hello at once.
    if (challenge != challenge_) hello_ns = 0;
  }
  return is_connected();
}

void LinkProbe::say_hello() {
  receive();
  (void)send(wire::Hello{.token = token_, .only_asks = false, .challenge = challenge_});
}

const std::vector<LinkProbe::Seen>& LinkProbe::talk(double duration_s, std::uint32_t arm_number,
                                                    const core::PointVectors& force_on_hand_n,
                                                    const std::function<void()>& also) {
  seen_.clear();
  const std::int64_t period_ns = ns_of(1.0 / welcome().capabilities.rate_hz);
  std::int64_t due_ns = port_.now_ns();
  const std::int64_t until_ns = due_ns + ns_of(duration_s);
  while (port_.now_ns() < until_ns) {
    receive();
    core::PointVectors force_n = force_on_hand_n;
    if (limiter_) limiter_->limit(measured_.attached, measured_.tip_velocity_m_per_s, force_n);
    last_ = send(wire::Command{
        .arm_number = arm_number, .answered_sequence = newest_, .force_on_hand_n = force_n});
    if (also) also();
    due_ns = std::max(due_ns + period_ns, port_.now_ns());
    if (due_ns > port_.now_ns()) port_.pause(due_ns - port_.now_ns());
  }
  receive();
  return seen_;
}

const std::vector<LinkProbe::Seen>& LinkProbe::listen(double duration_s) {
  seen_.clear();
  const std::int64_t until_ns = port_.now_ns() + ns_of(duration_s);
  while (port_.now_ns() < until_ns) {
    receive();
    port_.pause(kMillisecond_ns / 2);
  }
  return seen_;
}

bool LinkProbe::arm(std::uint32_t arm_number) {
  constexpr int kTries = 10;
  for (int i = 0; i < kTries; ++i) {
    const std::vector<Seen>& states = talk(0.1, arm_number, core::zero_vectors());
    if (!states.empty() && states.back().state.armed &&
        states.back().state.armed_number == arm_number) {
      return true;
    }
  }
  return false;
}

void LinkProbe::halt() { (void)send(wire::Halt{}); }

void LinkProbe::say_goodbye() {
  // It is sent twice, because nobody answers it.
  for (int i = 0; i < 2; ++i) (void)send(wire::Goodbye{});
  stream_id_ = 0;
}

void LinkProbe::send_again(const std::vector<std::byte>& bytes) { port_.send(bytes, server_); }

void LinkProbe::receive() {
  constexpr int kMost = 1024;
  std::array<std::byte, 2 * wire::kMaxBytes> bytes;
  Address from;
  wire::Datagram datagram;
  for (int i = 0; i < kMost; ++i) {
    const std::size_t size = port_.receive(bytes, from);
    if (size == 0) return;
    const wire::Problem problem = seal_.read(std::span(bytes).first(size), datagram);
    if (problem == wire::Problem::kNone) {
      take(datagram, port_.now_ns());
    } else {
      ++num_refused_;
      last_problem_ = problem;
      const std::size_t seal = seal_.has_key() ? DatagramSeal::kBytes : 0;
      refused_.assign(bytes.begin(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(size - std::min(seal, size)));
    }
  }
}

void LinkProbe::take(const wire::Datagram& datagram, std::int64_t now_ns) {
  if (const auto* welcome = std::get_if<wire::Welcome>(&datagram.content)) {
    if (welcome->token != token_) return;
    challenge_ = welcome->challenge;
    welcome_ = *welcome;
    if (datagram.header.stream_id == 0 || is_connected()) return;
    stream_id_ = datagram.header.stream_id;
    seal_.begin_stream(token_, stream_id_);
    sequence_ = 1;
  } else if (const auto* refused = std::get_if<wire::Refusal>(&datagram.content)) {
    if (refused->token == token_) refusal_ = refused->reason;
  } else if (const auto* state = std::get_if<wire::State>(&datagram.content)) {
    if (datagram.header.stream_id != stream_id_ || !is_connected()) return;
    seen_.push_back({datagram.header, *state, now_ns});
    newest_ = datagram.header.sequence;
    measured_ = state->measured;
    peer_sent_ns_ = datagram.header.sent_ns;
  }
}

std::vector<std::byte> LinkProbe::send(const wire::Content& content) {
  const bool is_hello = std::holds_alternative<wire::Hello>(content);
  wire::Datagram datagram{.header = {.sent_ns = port_.now_ns()}, .content = content};
  sent_ns_.insert(datagram.header.sent_ns);
  if (!is_hello) {
    datagram.header.stream_id = stream_id_;
    datagram.header.sequence = sequence_++;
    datagram.header.echo_ns = peer_sent_ns_;
  }
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const std::size_t size = seal_.write(datagram, bytes);
  port_.send(std::span(bytes).first(size), server_);
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace jnd::device
