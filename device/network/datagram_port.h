#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace jnd::device {

/// Where datagrams go to or come from. Only the port reads its content; others only compare
/// addresses.
struct Address {
  std::array<std::byte, 28> bytes{};
  std::uint32_t num_bytes = 0;

  [[nodiscard]] friend bool operator==(const Address&, const Address&) noexcept = default;
};

/// A place to send and receive datagrams, with a clock. A real one is a socket; that of a test
/// loses and reorders datagrams. One thread may use it, but any thread may call `send` at any
/// time.
class DatagramPort {
 public:
  virtual ~DatagramPort() = default;

  /// Sends without waiting. Returns false if the system did not take the datagram; the network
  /// may lose it anyway. Real time.
  virtual bool send(std::span<const std::byte> datagram, const Address& to) noexcept = 0;

  /// Returns the size of the oldest waiting datagram and copies its first bytes to `bytes`.
  /// Returns 0 if none waits. Real time.
  [[nodiscard]] virtual std::size_t receive(std::span<std::byte> bytes,
                                            Address& from) noexcept = 0;

  /// Returns when the last datagram from `receive` arrived at this machine, by `now_ns`. Real
  /// time.
  [[nodiscard]] virtual std::int64_t arrived_ns() const noexcept { return now_ns(); }

  /// Returns the time of a clock that never goes back. Real time.
  [[nodiscard]] virtual std::int64_t now_ns() const noexcept = 0;

  /// Waits for this time. Not real time.
  virtual void pause(std::int64_t duration_ns) noexcept = 0;
};

}  // namespace jnd::device
