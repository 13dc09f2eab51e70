#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::core {

/// Ticks from the first to the last, both among them.
struct TickRange {
  std::int64_t first_tick = 0, last_tick = 0;
  friend bool operator==(const TickRange&, const TickRange&) = default;
};

/// Ticks that an event speaks of: their samples were on disk before it was written, so a
/// recording that lacks them has lost something.
struct TickClaim {
  TickRange ticks;
  std::string kind;  ///< Of the event.
  std::optional<std::int64_t> trial;
};

/// Those of explored media and ended presentations, in the order of the events, also of events
/// that a later one took back.
[[nodiscard]] std::vector<TickClaim> tick_claims(const std::vector<EventRow>& events);

/// The same ticks as ascending ranges that do not touch.
[[nodiscard]] std::vector<TickRange> merged(std::vector<TickRange> ranges);

/// The parts of `ticks` that are in none of the ranges, which are as `merged` makes them.
[[nodiscard]] std::vector<TickRange> missing_in(const std::vector<TickRange>& ranges,
                                                TickRange ticks);

[[nodiscard]] std::int64_t num_ticks(const std::vector<TickRange>& ranges) noexcept;

}  // namespace jnd::core
