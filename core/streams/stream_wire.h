#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/stream_sample.h"

namespace jnd::core {

/// Samples as they travel, by protocol 1.10: a mark, a time where it is told, a value for each
/// channel. Not real time.

/// Whoever sends more for one channel is no recorder.
inline constexpr std::size_t kMostTextBytes = std::size_t{1} << 20;

/// Adds a sample with its time, little-endian. `values` or `texts` have one for each channel.
void append_sample(std::string& bytes, const StreamSample& sample, ChannelFormat format);

/// The sample that both sides know: an outlet begins with those of 4 and 2, by which an inlet
/// sees that it reads numbers as they were meant.
[[nodiscard]] StreamSample test_sample(ChannelFormat format, int channel_count, int offset);

/// What begins the bytes, where all of it is there.
struct TakenSample {
  StreamSample sample;
  bool has_time = true;  ///< Else it follows the one before by a period of the nominal rate.
  std::size_t num_bytes = 0;
};
/// None where the rest is still to come. `big_endian`: as the sender has its numbers; what is
/// returned is little-endian. Throws `Error` for what is no sample.
[[nodiscard]] std::optional<TakenSample> take_sample(std::string_view bytes,
                                                     ChannelFormat format, int channel_count,
                                                     bool big_endian);

}  // namespace jnd::core
