#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "device/network/datagram.h"
#include "device/network/device_key.h"
#include "device/network/hmac_sha256.h"

namespace jnd::device {

/// Puts datagrams into bytes and back, for one side of a connection. With a key it seals each
/// by 16 bytes behind it, the first half of an HMAC-SHA-256 over all of it, and takes only what
/// the other side has sealed. What belongs to a stream is sealed by a key of that stream and
/// direction alone, made of the shared key, the program's token and the device's stream ID, so
/// that nothing that was said on another stream, or by oneself, can be said again. One thread
/// at a time.
class DatagramSeal {
 public:
  static constexpr std::size_t kBytes = 16;
  static constexpr std::size_t kMostBytes = wire::kMaxBytes + kBytes;
  enum class Side { kProgram, kDevice };

  /// Whose side this is.
  DatagramSeal(Side side, const std::optional<DeviceKey>& key) noexcept
      : side_(side), key_(key) {}

  [[nodiscard]] bool has_key() const noexcept { return key_.has_value(); }

  /// From now on states, commands, orders, halts and goodbyes are those of this stream. Real
  /// time.
  void begin_stream(std::uint64_t token, std::uint64_t stream_id) noexcept;

  /// Returns how many bytes were written. Real time.
  [[nodiscard]] std::size_t write(const wire::Datagram& datagram,
                                  std::span<std::byte, kMostBytes> bytes) const noexcept;

  /// As `wire::decode`; besides `kOtherKey`, where key or seal are not the other side's. Real
  /// time.
  [[nodiscard]] wire::Problem read(std::span<const std::byte> bytes,
                                   wire::Datagram& datagram) const noexcept;

 private:
  [[nodiscard]] HmacCode code_of(std::span<const std::byte> bytes, Side sender) const noexcept;

  Side side_;
  std::optional<DeviceKey> key_;
  bool has_stream_ = false;
  DeviceKey to_device_{}, to_program_{};  ///< Keys of the stream, one for each direction.
};

}  // namespace jnd::device
