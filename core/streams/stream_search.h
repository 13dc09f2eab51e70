#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/streams/stream_info.h"
#include "core/streams/stream_network.h"

namespace jnd::core {

/// The streams that answer to a query (see `matches_query`) within this time, each once, with
/// the address that it answered from. Ends early once there are `enough` of them (0: never), or
/// `is_cancelled` says so. What answers something else is passed over. Throws `Error` where
/// there is no socket. Not real time.
[[nodiscard]] std::vector<StreamInfo> find_streams(
    const StreamNetwork& network, const std::string& query, double timeout_s, int enough = 0,
    const std::function<bool()>& is_cancelled = {});

/// "type='EEG'", and of this session of the network alone.
[[nodiscard]] std::string query_for(const StreamNetwork& network, const std::string& key,
                                    const std::string& value);

}  // namespace jnd::core
