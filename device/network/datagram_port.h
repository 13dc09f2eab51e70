#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace jnd::device {

/// Where datagrams go to or come from; of interest to the port alone, but for its equality.
struct Address {
  std::array<std::byte, 28> bytes{};
  std::uint32_t num_bytes = 0;

  [[nodiscard]] friend bool operator==(const Address&, const Address&) noexcept = default;
};

/// A place to send datagrams from and to receive them at, with the clock beside it. A real one
/// is a socket, a test's one loses and confuses what it is given. Used by one thread, except
/// `send`, which any may call at any time.
class DatagramPort {
 public:
  virtual ~DatagramPort() = default;

  /// Does not wait. False: the system did not take it; the network may lose it anyway. Real
  /// time.
  virtual bool send(std::span<const std::byte> datagram, const Address& to) noexcept = 0;

  /// The size of the oldest datagram that waits, its first bytes in `bytes`; 0: none waits.
  /// Real time.
  [[nodiscard]] virtual std::size_t receive(std::span<std::byte> bytes,
                                            Address& from) noexcept = 0;

  /// When the last datagram that `receive` gave came to this machine, by `now_ns`. Real time.
  [[nodiscard]] virtual std::int64_t arrived_ns() const noexcept { return now_ns(); }

  /// Of a clock that never goes back. Real time.
  [[nodiscard]] virtual std::int64_t now_ns() const noexcept = 0;

  /// Lets this much time pass. Not real time.
  virtual void pause(std::int64_t duration_ns) noexcept = 0;
};

}  // namespace jnd::device
