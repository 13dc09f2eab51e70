#include "core/streams/stream_wire.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/error.h"

namespace jnd::core {
namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers are sent as they lie in memory");

constexpr char kDeducedTime = 1, kToldTime = 2;
/// Time of a test sample.
constexpr double kTestTime_s = 123456.789;

template <typename Number>
void append_number(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

template <typename Number>
Number number_at(std::string_view bytes, bool big_endian) {
  char raw[sizeof(Number)];
  std::memcpy(raw, bytes.data(), sizeof raw);
  if (big_endian) std::reverse(raw, raw + sizeof raw);
  Number value;
  std::memcpy(&value, raw, sizeof value);
  return value;
}

/// Returns values that increase by one from channel to channel, with every other sign negative.
template <typename Number>
std::string test_values(int channel_count, std::int64_t first) {
  std::string bytes;
  for (int channel = 0; channel < channel_count; ++channel) {
    std::int64_t value = first + channel;
    if constexpr (std::is_integral_v<Number> && sizeof(Number) < 8) {
      value %= std::numeric_limits<Number>::max();
    }
    const auto number = static_cast<Number>(value);
    append_number(bytes, channel % 2 == 0 ? number : static_cast<Number>(-number));
  }
  return bytes;
}

/// Takes a text. Returns how many bytes it takes, including its length before it, or none if
/// more bytes have to come.
std::optional<std::size_t> take_text(std::string_view bytes, bool big_endian,
                                     std::string& text) {
  if (bytes.empty()) return std::nullopt;
  const auto width = static_cast<std::size_t>(static_cast<unsigned char>(bytes[0]));
  if (width != 1 && width != 2 && width != 4 && width != 8) {
    throw Error("stream: expected a length of 1, 2, 4 or 8 bytes before a text, found " +
                std::to_string(width));
  }
  if (bytes.size() < 1 + width) return std::nullopt;
  const std::string_view length = bytes.substr(1, width);
  const std::uint64_t size = width == 1   ? number_at<std::uint8_t>(length, false)
                             : width == 2 ? number_at<std::uint16_t>(length, big_endian)
                             : width == 4 ? number_at<std::uint32_t>(length, big_endian)
                                          : number_at<std::uint64_t>(length, big_endian);
  if (size > kMostTextBytes) {
    throw Error("stream: expected texts of at most " + std::to_string(kMostTextBytes) +
                " bytes, found one of " + std::to_string(size));
  }
  const std::size_t whole = 1 + width + static_cast<std::size_t>(size);
  if (bytes.size() < whole) return std::nullopt;
  text = bytes.substr(1 + width, static_cast<std::size_t>(size));
  return whole;
}

}  // namespace

void append_sample(std::string& bytes, const StreamSample& sample, ChannelFormat format) {
  bytes += kToldTime;
  append_number(bytes, sample.time_s);
  if (format != ChannelFormat::kString) {
    bytes += sample.values;
    return;
  }
  for (const std::string& text : sample.texts) {
    if (text.size() <= 0xFF) {
      bytes += char{1};
      append_number(bytes, static_cast<std::uint8_t>(text.size()));
    } else {
      bytes += char{4};
      append_number(bytes, static_cast<std::uint32_t>(text.size()));
    }
    bytes += text;
  }
}

StreamSample test_sample(ChannelFormat format, int channel_count, int offset) {
  StreamSample sample{.time_s = kTestTime_s};
  const std::int64_t base = offset;
  switch (format) {
    case ChannelFormat::kFloat32:
      sample.values = test_values<float>(channel_count, base);
      break;
    case ChannelFormat::kDouble64:
      sample.values = test_values<double>(channel_count, base + 16777217);
      break;
    case ChannelFormat::kInt8:
      sample.values = test_values<std::int8_t>(channel_count, base + 1);
      break;
    case ChannelFormat::kInt16:
      sample.values = test_values<std::int16_t>(channel_count, base + 257);
      break;
    case ChannelFormat::kInt32:
      sample.values = test_values<std::int32_t>(channel_count, base + 65537);
      break;
    case ChannelFormat::kInt64:
      sample.values = test_values<std::int64_t>(channel_count, base + 2147483649);
      break;
    case ChannelFormat::kString:
      for (int channel = 0; channel < channel_count; ++channel) {
        sample.texts.push_back(std::to_string((channel + 10) * (channel % 2 == 0 ? 1 : -1)));
      }
  }
  return sample;
}

std::optional<TakenSample> take_sample(std::string_view bytes, ChannelFormat format,
                                       int channel_count, bool big_endian) {
  if (bytes.empty()) return std::nullopt;
  TakenSample taken;
  if (bytes[0] != kDeducedTime && bytes[0] != kToldTime) {
    throw Error("stream: expected a sample with a mark of 1 or 2, found " +
                std::to_string(static_cast<unsigned char>(bytes[0])));
  }
  taken.has_time = bytes[0] == kToldTime;
  std::size_t at = 1;
  if (taken.has_time) {
    if (bytes.size() < at + sizeof(double)) return std::nullopt;
    taken.sample.time_s = number_at<double>(bytes.substr(at), big_endian);
    if (!std::isfinite(taken.sample.time_s)) {
      throw Error("stream: expected a sample with a time, found one that is no number");
    }
    at += sizeof(double);
  }
  const auto num_channels = static_cast<std::size_t>(channel_count);
  if (format == ChannelFormat::kString) {
    for (std::size_t channel = 0; channel < num_channels; ++channel) {
      std::string text;
      const auto size = take_text(bytes.substr(at), big_endian, text);
      if (!size) return std::nullopt;
      taken.sample.texts.push_back(std::move(text));
      at += *size;
    }
  } else {
    const std::size_t width = value_bytes(format);
    if (bytes.size() < at + num_channels * width) return std::nullopt;
    taken.sample.values = bytes.substr(at, num_channels * width);
    if (big_endian) {
      for (std::size_t i = 0; i < taken.sample.values.size(); i += width) {
        const auto first = taken.sample.values.begin() + static_cast<std::ptrdiff_t>(i);
        std::reverse(first, first + static_cast<std::ptrdiff_t>(width));
      }
    }
    at += num_channels * width;
  }
  taken.num_bytes = at;
  return taken;
}

}  // namespace jnd::core
