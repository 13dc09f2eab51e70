#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/streams/stream_info.h"
#include "core/streams/stream_network.h"

namespace jnd::core {

/// Returns the streams that answer a query (see `matches_query`) within this time, each once,
/// with the address from which it answered. It ends early once there are `enough` of them (0:
/// never) or `is_cancelled` returns true. It ignores other answers. Throws `Error` if there is
/// no socket. Not real time.
[[nodiscard]] std::vector<StreamInfo> find_streams(
    const StreamNetwork& network, const std::string& query, double timeout_s, int enough = 0,
    const std::function<bool()>& is_cancelled = {});

/// Returns a query such as "type='EEG'", limited to this network's session id.
[[nodiscard]] std::string query_for(const StreamNetwork& network, const std::string& key,
                                    const std::string& value);

}  // namespace jnd::core
