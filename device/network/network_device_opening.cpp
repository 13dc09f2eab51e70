#include <cmath>
#include <span>
#include <string>

#include "core/error.h"
#include "core/require.h"
#include "device/network/network_device.h"
#include "device/network/udp_port.h"

// What a network device does outside of the tick, where it may wait and report what is wrong.

namespace jnd::device {
namespace {

using core::Fault;

std::int64_t nanoseconds(double duration_s) { return std::llround(1e9 * duration_s); }

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
      token_(parameters.token),
      seal_(DatagramSeal::Side::kProgram, parameters.key),
      sequence_(parameters.first_sequence) {
  core::require_positive(parameters.rate_hz, "rate_hz");
  core::require_positive(parameters.max_stale_s, "max_stale_s");
  core::require_positive(parameters.patience_s, "patience_s");
}

NetworkDevice::~NetworkDevice() { close(); }

void NetworkDevice::ask() {
  device_.reset();
  num_refused_ = 0;
  const std::int64_t deadline_ns = port_->now_ns() + nanoseconds(parameters_.patience_s);
  last_hello_ns_ = 0;
  for (std::int64_t now_ns = port_->now_ns(); now_ns < deadline_ns; now_ns = port_->now_ns()) {
    take_in(now_ns);
    // Anybody can claim another version or another key. If we have a key, we keep waiting.
    if (device_ || (!seal_.has_key() && (other_version_ != 0 || has_other_key_))) break;
    say_hello(true, now_ns);
    port_->pause(1'000'000);
  }
  if (!device_) throw DeviceUnreachable(what_is_wrong());
}

/// With a device slower than the loop, the loop would use the same measurement twice.
void NetworkDevice::require_rate() const {
  const double rate_hz = device_->capabilities.rate_hz;
  constexpr double kMostOff = 0.001;
  if (rate_hz >= (1.0 - kMostOff) * parameters_.rate_hz) return;
  throw core::Error("network " + text_of(server_) + ": expected a device at " +
                    shown(parameters_.rate_hz) + " Hz or faster, found " +
                    std::string(served_name()) + " at " + shown(rate_hz) +
                    " Hz; start it with the rate that the study asks for");
}

void NetworkDevice::open() {
  close();
  if (!device_) ask();
  require_rate();
  hand_.reset();
  ++token_;
  num_refused_ = 0;
  refusal_.reset();
  is_another_ = false;
  phase_ = Phase::kSeeking;
  last_hello_ns_ = 0;
  first_read_ns_ = 0;
  had_force_ = false;
  num_failed_sends_ = 0;
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
  if (has_other_key_) {
    return place + (seal_.has_key()
                        ? "a device with the same key, found one with another or none; use the "
                          "same file of `jnd device-key` on both machines"
                        : "a device that needs no key, found one that has one; name the key "
                          "after the address, as in HOST:PORT,key=NAME");
  }
  if (is_another_) {
    return place + "the same device as before, found another; start the one that was there, " +
           "or this program anew";
  }
  const bool are_states_good = phase_ == Phase::kArming && quality_.is_settled();
  if (num_refused_ > 0 && !are_states_good && !refusal_) {
    return place + "datagrams as device/network/README.md has them, found " +
           std::to_string(num_refused_) + " that are none, the last one " +
           wire::problem_words(std::span(refused_).first(refused_size_)) +
           "; mend what the device sends";
  }
  if (phase_ == Phase::kArming) {
    const LinkCounts& counts = quality_.counts();
    if (quality_.is_settled() && !is_silent(port_->now_ns()) && !newest_.is_measured) {
      return place +
             "states with a measurement, found that each says by `measured` 0 that the device "
             "could not be read; look at the robot and at its own program";
    }
    if (quality_.is_settled() && !is_silent(port_->now_ns())) {
      return place + "the device to arm on a command without force, found that it does not (" +
             (newest_.fault == Fault::kNone
                  ? "it tells no fault, and finds the connection " +
                        std::string(device::name(newest_.level))
                  : "it tells the fault " + std::string(core::name(newest_.fault))) +
             "); look at the device's own program, and try it with `jnd device-check`";
    }
    if (quality_.level() >= LinkLevel::kGood && !quality_.has_round_trip()) {
      return place +
             "states that repeat the newest clock of our commands, found that they do " +
             "not; look at the device's own program";
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
  return place +
         "a device to answer, found none; start its program, see that a key "
         "is on both sides or on none, and check address and port";
}

void NetworkDevice::close() noexcept {
  if (phase_ != Phase::kClosed) {
    // It is sent twice, because there is no answer. The device would also notice the silence.
    send(wire::Goodbye{}, port_->now_ns());
    send(wire::Goodbye{}, port_->now_ns());
  }
  phase_ = Phase::kClosed;
  fault_ = Fault::kNone;
  stream_id_ = 0;
}

}  // namespace jnd::device
