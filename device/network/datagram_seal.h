#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "device/network/datagram.h"
#include "device/network/device_key.h"
#include "device/network/hmac_sha256.h"

namespace jnd::device {

/// Converts datagrams to bytes and back, for one side of a connection. With a key it appends a
/// seal of 16 bytes to each, the first half of an HMAC-SHA-256 over all of it, and accepts only
/// what the other side has sealed. Datagrams of a stream are sealed by a key for that stream
/// and direction alone, which is made from the shared key, the program's token and the device's
/// stream ID. So nothing that was sent on another stream, or in the other direction, can be
/// replayed. One thread at a time may use it.
class DatagramSeal {
 public:
  static constexpr std::size_t kBytes = 16;
  static constexpr std::size_t kMostBytes = wire::kMaxBytes + kBytes;
  enum class Side { kProgram, kDevice };

  /// `side` is the side that uses this object.
  DatagramSeal(Side side, const std::optional<DeviceKey>& key) noexcept
      : side_(side), key_(key) {}

  [[nodiscard]] bool has_key() const noexcept { return key_.has_value(); }

  /// From now on states, commands, orders, halts and goodbyes are those of this stream. Real
  /// time.
  void begin_stream(std::uint64_t token, std::uint64_t stream_id) noexcept;

  /// Returns the number of written bytes. Real time.
  [[nodiscard]] std::size_t write(const wire::Datagram& datagram,
                                  std::span<std::byte, kMostBytes> bytes) const noexcept;

  /// Works like `wire::decode`, and returns `kOtherKey` if key or seal are not those of the
  /// other side. Real time.
  [[nodiscard]] wire::Problem read(std::span<const std::byte> bytes,
                                   wire::Datagram& datagram) const noexcept;

 private:
  [[nodiscard]] HmacCode code_of(std::span<const std::byte> bytes, Side sender) const noexcept;

  Side side_;
  std::optional<DeviceKey> key_;
  bool has_stream_ = false;
  DeviceKey to_device_{}, to_program_{};  ///< Keys of the stream for the two directions.
};

}  // namespace jnd::device
