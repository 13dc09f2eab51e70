#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/storage/study_rows.h"
#include "core/streams/stream_info.h"

namespace jnd::core {

/// Markers of a session, for other recorders beside it. A marker consists of numbers: session,
/// event, stage, trial, attempt and presentation. It never holds what was presented or
/// answered, whatever the study, so nobody who sees a marker is unblinded by it. Use one object
/// for each session and pass events in order. Not real time.
class SessionMarkers {
 public:
  /// Returns a line of JSON such as
  /// {"what":"presentation_started","session":12,"event":345,"trial":7,"attempt":1,"presentation":2},
  /// or none for an event without a marker.
  [[nodiscard]] std::optional<std::string> marker_of(const EventRow& event);

 private:
  std::int64_t trial_ = 0, attempt_ = 0, presentation_ = 0;
};

/// What the two streams of a session say about themselves, live and in files.
struct SessionStreamFacts {
  std::string study_id;  ///< The same in every backup of the study.
  std::string study;     ///< Name of the study.
  std::int64_t session = 0;
  std::string program_version;
};
[[nodiscard]] StreamInfo marker_stream_info(const SessionStreamFacts& facts);

}  // namespace jnd::core
