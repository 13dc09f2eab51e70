#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// The type of the values in a stream of another recorder (docs/lab_streaming_layer.md).
enum class ChannelFormat : std::uint8_t {
  kFloat32,
  kDouble64,
  kString,
  kInt32,
  kInt16,
  kInt8,
  kInt64
};

inline constexpr std::string_view kChannelFormatNames[] = {
    "float32", "double64", "string", "int32", "int16", "int8", "int64"};

/// Returns "float32" and its like, as streams and files spell them.
[[nodiscard]] constexpr std::string_view name(ChannelFormat format) noexcept {
  return kChannelFormatNames[static_cast<std::size_t>(format)];
}

/// Returns none for a word that is no format.
[[nodiscard]] constexpr std::optional<ChannelFormat> channel_format_of(std::string_view word) {
  for (std::size_t i = 0; i < std::size(kChannelFormatNames); ++i) {
    if (kChannelFormatNames[i] == word) return static_cast<ChannelFormat>(i);
  }
  return std::nullopt;
}

/// Returns the size of one value, or 0 for texts, each of which has its own length.
[[nodiscard]] constexpr std::size_t value_bytes(ChannelFormat format) noexcept {
  switch (format) {
    case ChannelFormat::kFloat32:
    case ChannelFormat::kInt32:
      return 4;
    case ChannelFormat::kDouble64:
    case ChannelFormat::kInt64:
      return 8;
    case ChannelFormat::kInt16:
      return 2;
    case ChannelFormat::kInt8:
      return 1;
    case ChannelFormat::kString:
      break;
  }
  return 0;
}

/// One sample of a stream: a value for each channel.
struct StreamSample {
  double time_s = 0.0;  ///< By the sender's clock.
  /// Numbers in little-endian order, channel after channel, in the stream's format. They are
  /// kept as they came, so that nothing is rounded.
  std::string values;
  std::vector<std::string> texts;  ///< Texts, one for each channel.

  friend bool operator==(const StreamSample&, const StreamSample&) = default;
};

}  // namespace jnd::core
