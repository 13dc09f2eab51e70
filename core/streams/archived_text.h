#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/streams/stream_wire.h"

namespace jnd::core {

/// Samples of texts by protocol 1.00, which older outlets fall back to where their machine has
/// texts of another size in memory than ours: numbers are a length and as many bytes, the
/// smallest first, and nothing for 0. Numbers as samples never come so. Not real time.

/// What begins such a feed: the outlet's description.
struct ArchivedHeader {
  std::string xml;
  std::size_t num_bytes = 0;
};
/// None where the rest is still to come. Throws `Error` for what is no such beginning.
[[nodiscard]] std::optional<ArchivedHeader> take_archived_header(std::string_view bytes);

/// As `take_sample`.
[[nodiscard]] std::optional<TakenSample> take_archived_sample(std::string_view bytes,
                                                              int channel_count);

}  // namespace jnd::core
