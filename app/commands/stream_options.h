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

/// As they were given: see `add_stream_options`.
struct StreamOptions {
  std::vector<std::string> out, channels, in, peers;
  std::string library;
};

/// `--lsl-out`, `--lsl-channel`, `--lsl-in`, `--lsl-peer` and `--lsl-library`.
void add_stream_options(CLI::App& command, StreamOptions& options);

/// What was given. Throws `UsageError` for what no session can be asked for.
[[nodiscard]] WantedStreams streams_given(const StreamOptions& options);

/// Throws `UsageError` where streams are asked for that this session cannot have: in simulated
/// time, or samples of a study that hides its levels. `folder` need not be there. Says on
/// stderr which streams there will be, and who carries them.
void require_streams_fit(const WantedStreams& wanted, bool is_realtime,
                         const experiments::Study& study, const std::filesystem::path& folder);

}  // namespace jnd::app
