#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/storage/study_rows.h"
#include "core/streams/stream_info.h"

namespace jnd::core {

/// What happens in a session, for whoever records something else beside it. A marker is made of
/// columns that number things: session, event, stage, trial, attempt, presentation. What was
/// presented and what was answered is in none of them, whatever the study, so nobody who sees a
/// marker is unblinded by it. One for each session; events come in their order. Not real time.
class SessionMarkers {
 public:
  /// As a line of JSON: {"what":"presentation_started","session":12,"event":345,"trial":7,
  /// "attempt":1,"presentation":2}. None for an event that is nobody else's business.
  [[nodiscard]] std::optional<std::string> marker_of(const EventRow& event);

 private:
  std::int64_t trial_ = 0, attempt_ = 0, presentation_ = 0;
};

/// What the two streams of a session say of themselves, live and in files.
struct SessionStreamFacts {
  std::string study_id;  ///< The same in every backup of the study.
  std::string study;     ///< Its name.
  std::int64_t session = 0;
  std::string program_version;
};
[[nodiscard]] StreamInfo marker_stream_info(const SessionStreamFacts& facts);

}  // namespace jnd::core
