#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/session/session_streams.h"
#include "experiments/study/study.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// The options as they were given: see `add_stream_options`.
struct StreamOptions {
  std::vector<std::string> out, channels, in, peers;
  std::string library;
};

/// Adds `--lsl-out`, `--lsl-channel`, `--lsl-in`, `--lsl-peer` and `--lsl-library`.
void add_stream_options(CLI::App& command, StreamOptions& options);

/// The streams that were asked for. Throws `UsageError` for what no session can have.
[[nodiscard]] WantedStreams streams_given(const StreamOptions& options);

/// Throws `UsageError` if this session cannot have the streams: in simulated time, or samples
/// of a study that hides its levels. `folder` need not exist. Says on stderr which streams
/// there will be, and which library carries them.
void require_streams_fit(const WantedStreams& wanted, bool is_realtime,
                         const experiments::Study& study, const std::filesystem::path& folder);

}  // namespace jnd::app
