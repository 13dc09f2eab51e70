#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/stream_sample.h"

namespace jnd::core {

/// Samples as protocol 1.10 transmits them: a mark, a time if it is sent, and a value for each
/// channel. Not real time.

/// No recorder sends a longer text for one channel.
inline constexpr std::size_t kMostTextBytes = std::size_t{1} << 20;

/// Appends a sample with its time, little-endian. `values` or `texts` has an entry for each
/// channel.
void append_sample(std::string& bytes, const StreamSample& sample, ChannelFormat format);

/// Returns the sample that both sides know. An outlet begins with those of offsets 4 and 2, by
/// which an inlet checks that it reads numbers correctly.
[[nodiscard]] StreamSample test_sample(ChannelFormat format, int channel_count, int offset);

/// The first sample of some bytes.
struct TakenSample {
  StreamSample sample;
  /// If false, the sample follows the one before it by a period of the nominal rate.
  bool has_time = true;
  std::size_t num_bytes = 0;
};
/// Returns none if more bytes have to come. `big_endian` is the sender's byte order; the result
/// is little-endian. Throws `Error` for what is no sample.
[[nodiscard]] std::optional<TakenSample> take_sample(std::string_view bytes,
                                                     ChannelFormat format, int channel_count,
                                                     bool big_endian);

}  // namespace jnd::core
