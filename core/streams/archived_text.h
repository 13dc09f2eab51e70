#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/streams/stream_wire.h"

namespace jnd::core {

/// Text samples of protocol 1.00. Older outlets fall back to it if their machine's texts have
/// another size in memory than ours. A number is a length and as many bytes, the smallest
/// first; 0 has no bytes. Numeric samples never use this protocol. Not real time.

/// The beginning of such a feed: the outlet's description.
struct ArchivedHeader {
  std::string xml;
  std::size_t num_bytes = 0;
};
/// Returns none if more bytes have to come. Throws `Error` for bytes that are no such
/// beginning.
[[nodiscard]] std::optional<ArchivedHeader> take_archived_header(std::string_view bytes);

/// Like `take_sample`.
[[nodiscard]] std::optional<TakenSample> take_archived_sample(std::string_view bytes,
                                                              int channel_count);

}  // namespace jnd::core
