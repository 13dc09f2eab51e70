#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/network/datagram_port.h"

namespace jnd::device {

/// The meaning of `HOST:PORT`, or of `[HOST]:PORT` for an IPv6 address.
struct Endpoint {
  std::string host;
  std::uint16_t port = 0;
};

/// Throws `core::Error` that says what a host and a port look like. Not real time.
[[nodiscard]] Endpoint endpoint_of(std::string_view text);

/// Prefers an IPv4 address: `localhost` often has both kinds, and servers listen at 127.0.0.1.
/// Throws `core::Error` if the system does not know the host. Not real time.
[[nodiscard]] Address resolved(const Endpoint& endpoint);

/// Whether the address leads to this machine only, so that nobody else can listen or speak. Not
/// real time.
[[nodiscard]] bool is_loopback(const Address& address) noexcept;

/// Returns "127.0.0.1:4700". Not real time.
[[nodiscard]] std::string text_of(const Address& address);

/// A UDP socket that never blocks, over IPv4 or IPv6. Its datagrams go before other traffic of
/// this machine, and have a mark for switches that regard it (DSCP 46, RFC 3246).
class UdpPort final : public DatagramPort {
 public:
  /// Receives at this address; port 0 is any free one. Throws `core::Error` if it is not
  /// available. Not real time.
  explicit UdpPort(const Address& local);
  /// Opens any free port to exchange datagrams with `peer` alone. The system drops what others
  /// send. Throws `DeviceUnreachable` if there is no route to it. Not real time.
  [[nodiscard]] static std::unique_ptr<UdpPort> connected_to(const Address& peer);
  ~UdpPort() override;
  UdpPort(const UdpPort&) = delete;
  UdpPort& operator=(const UdpPort&) = delete;

  /// From now on receives only what these hosts send, from any port. Everything else is dropped
  /// and counted. Not real time.
  void accept_only_from(std::vector<Address> hosts) { hosts_ = std::move(hosts); }
  [[nodiscard]] std::int64_t num_not_accepted() const noexcept { return num_not_accepted_; }

  /// Returns the address at which it receives, with the port that it got. Not real time.
  [[nodiscard]] Address local() const;

  bool send(std::span<const std::byte> datagram, const Address& to) noexcept override;
  [[nodiscard]] std::size_t receive(std::span<std::byte> bytes,
                                    Address& from) noexcept override;
  /// Uses the time stamp of the kernel.
  [[nodiscard]] std::int64_t arrived_ns() const noexcept override { return arrived_ns_; }
  [[nodiscard]] std::int64_t now_ns() const noexcept override;
  void pause(std::int64_t duration_ns) noexcept override;

 private:
  int socket_ = -1;
  std::vector<Address> hosts_;  ///< Empty allows any host.
  std::int64_t num_not_accepted_ = 0;
  std::int64_t arrived_ns_ = 0;
};

}  // namespace jnd::device
