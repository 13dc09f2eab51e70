#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/sample.h"
#include "core/storage/study_rows.h"
#include "core/streams/session_markers.h"
#include "core/streams/stream_network.h"
#include "core/streams/wanted_streams.h"
#include "experiments/session/session.h"

namespace jnd::app {

using core::WantedStreams;

/// "type" and "EEG" of "type=EEG". Throws `core::Error` where the key is none that streams are
/// looked for by.
[[nodiscard]] std::pair<std::string, std::string> searched_for(const std::string& inlet);

/// Throws `core::Error` in a sentence for what no session can be asked for: an unknown channel
/// or key, a library that cannot be loaded, and samples of a study whose levels are hidden, for
/// a force tells the level.
void require_possible(const WantedStreams& wanted, bool hides_levels);

/// The streams of one session (docs/lab_streaming_layer.md), each on threads of its own: one
/// sends samples, one records what comes in. A stream that fails is told as an event, and the
/// session goes on. Used by the session's thread, but for `take`. Not real time.
class SessionStreams {
 public:
  struct Parameters {
    WantedStreams wanted;
    core::SessionStreamFacts facts;
    double rate_hz = 1000.0;
    bool hides_levels = false;
    std::filesystem::path recording;  ///< Beside which inlets are recorded.
    core::StreamNetwork network{};
  };

  /// Never throws for a stream that cannot be opened.
  explicit SessionStreams(const Parameters& parameters);
  ~SessionStreams();
  SessionStreams(const SessionStreams&) = delete;
  SessionStreams& operator=(const SessionStreams&) = delete;

  /// A sample of the loop, by the thread that stores them. Waits for nobody: what is not sent
  /// in time is dropped and counted.
  void take(const core::Sample& sample) noexcept;
  /// An event that was committed.
  void tell(const core::EventRow& event);
  /// Commits what there is to say of streams: opened, failed.
  void follow(experiments::Session& session);
  /// Ends what is recorded, and commits what became of each stream. Markers and samples go on
  /// until the end of this object. Once.
  void close(experiments::Session& session);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::app
