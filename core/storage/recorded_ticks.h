#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::core {

/// The ticks from the first to the last, both included.
struct TickRange {
  std::int64_t first_tick = 0, last_tick = 0;
  friend bool operator==(const TickRange&, const TickRange&) = default;
};

/// Ticks to which an event refers. Their samples were on disk before the event was written, so
/// a recording that lacks them has lost something.
struct TickClaim {
  TickRange ticks;
  std::string kind;  ///< Kind of the event.
  std::optional<std::int64_t> trial;
};

/// Returns the ticks of explored media and ended presentations, in the order of the events.
/// Events that a later one took back count as well.
[[nodiscard]] std::vector<TickClaim> tick_claims(const std::vector<EventRow>& events);

/// Returns the same ticks as ascending ranges that do not touch.
[[nodiscard]] std::vector<TickRange> merged(std::vector<TickRange> ranges);

/// Returns the parts of `ticks` that are in none of the ranges, which must be as `merged`
/// returns them.
[[nodiscard]] std::vector<TickRange> missing_in(const std::vector<TickRange>& ranges,
                                                TickRange ticks);

[[nodiscard]] std::int64_t num_ticks(const std::vector<TickRange>& ranges) noexcept;

}  // namespace jnd::core
