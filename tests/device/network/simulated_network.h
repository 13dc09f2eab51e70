#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "device/network/datagram.h"
#include "device/network/datagram_port.h"

namespace jnd::device {

using Bytes = std::vector<std::byte>;

inline constexpr std::int64_t kMs = 1'000'000;

inline Address address_number(std::uint32_t number) {
  Address address;
  std::memcpy(address.bytes.data(), &number, sizeof number);
  address.num_bytes = sizeof number;
  return address;
}

/// A network and a clock for tests. What is sent arrives at once and in order, unless the
/// test's own `on_send` does otherwise.
class SimulatedNetwork {
 public:
  struct Sent {
    Bytes bytes;
    Address from, to;
    std::int64_t arrives_ns = 0;
  };

  class Port final : public DatagramPort {
   public:
    Port(SimulatedNetwork& network, const Address& own) : network_(network), own_(own) {}

    bool send(std::span<const std::byte> datagram, const Address& to) noexcept override {
      if (network_.unplugged && *network_.unplugged == own_) return false;
      network_.carry({.bytes = {datagram.begin(), datagram.end()},
                      .from = own_,
                      .to = to,
                      .arrives_ns = network_.now_ns});
      return true;
    }
    std::size_t receive(std::span<std::byte> bytes, Address& from) noexcept override {
      return network_.deliver(own_, bytes, from);
    }
    std::int64_t now_ns() const noexcept override { return network_.now_ns; }
    void pause(std::int64_t duration_ns) noexcept override { network_.pass(duration_ns); }

   private:
    SimulatedNetwork& network_;
    Address own_;
  };

  std::unique_ptr<Port> port(const Address& own) { return std::make_unique<Port>(*this, own); }

  /// Puts a datagram on its way, whatever `on_send` would do.
  void post(const Sent& sent) { waiting_.push_back(sent); }

  void carry(const Sent& sent) {
    if (on_send) {
      on_send(sent);
    } else {
      post(sent);
    }
  }

  /// Lets time go on by whole milliseconds, and with it whatever the test has put beside it.
  void pass(std::int64_t duration_ns) {
    for (std::int64_t left_ns = duration_ns; left_ns > 0; left_ns -= 1'000'000) {
      now_ns += 1'000'000;
      if (on_millisecond) on_millisecond();
    }
  }

  std::int64_t now_ns = 1'000'000'000;
  std::function<void(const Sent&)> on_send;  ///< Posts what is to arrive, changed or unchanged.
  std::function<void()> on_millisecond;
  /// The address of the machine whose system takes nothing to send.
  std::optional<Address> unplugged;

 private:
  std::size_t deliver(const Address& to, std::span<std::byte> bytes, Address& from) {
    for (auto sent = waiting_.begin(); sent != waiting_.end(); ++sent) {
      if (!(sent->to == to) || sent->arrives_ns > now_ns) continue;
      const std::size_t size = sent->bytes.size();
      std::memcpy(bytes.data(), sent->bytes.data(), std::min(size, bytes.size()));
      from = sent->from;
      waiting_.erase(sent);
      return size;
    }
    return 0;
  }

  std::deque<Sent> waiting_;
};

inline Bytes encoded(const wire::Datagram& datagram) {
  std::array<std::byte, wire::kMaxBytes> bytes;
  const std::size_t size = wire::encode(datagram, bytes);
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace jnd::device
