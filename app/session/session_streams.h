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

/// Splits a search such as "type=EEG" into "type" and "EEG". Throws `core::Error` if streams
/// cannot be searched by the key.
[[nodiscard]] std::pair<std::string, std::string> searched_for(const std::string& inlet);

/// Throws `core::Error` in a sentence for what a session cannot do: an unknown channel or key,
/// a library that cannot be loaded, and samples of a study whose levels are hidden, because a
/// force tells the level.
void require_possible(const WantedStreams& wanted, bool hides_levels);

/// The streams of one session (docs/lab_streaming_layer.md), on threads of their own: one sends
/// samples, one records what comes in. If a stream fails, an event tells so, and the session
/// goes on. Used by the session's thread, except for `take`. Not real time.
class SessionStreams {
 public:
  struct Parameters {
    WantedStreams wanted;
    core::SessionStreamFacts facts;
    double rate_hz = 1000.0;
    bool hides_levels = false;
    std::filesystem::path recording;  ///< Inlets are recorded beside this file.
    core::StreamNetwork network{};
  };

  /// Never throws for a stream that cannot be opened.
  explicit SessionStreams(const Parameters& parameters);
  ~SessionStreams();
  SessionStreams(const SessionStreams&) = delete;
  SessionStreams& operator=(const SessionStreams&) = delete;

  /// Takes a sample of the loop; called by the thread that stores samples. It never waits: what
  /// cannot be sent in time is dropped and counted.
  void take(const core::Sample& sample) noexcept;
  /// Tells a committed event.
  void tell(const core::EventRow& event);
  /// Commits what there is to tell about streams: opened or failed.
  void follow(experiments::Session& session);
  /// Ends the recording, and commits the outcome of each stream. Markers and samples go on
  /// until this object is destroyed. Call it once.
  void close(experiments::Session& session);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace jnd::app
