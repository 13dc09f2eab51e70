#include "core/storage/recorded_ticks.h"

#include <algorithm>

namespace jnd::core {

std::vector<TickClaim> tick_claims(const std::vector<EventRow>& events) {
  std::vector<TickClaim> claims;
  std::optional<std::int64_t> presentation_first;
  for (const EventRow& event : events) {
    if (event.kind == "presentation_started") presentation_first = event.first_tick;
    std::optional<std::int64_t> first;
    if (event.kind == "medium_explored") first = event.first_tick;
    if (event.kind == "presentation_ended") first = presentation_first;
    if (!first || *first < 0 || !event.last_tick) continue;
    claims.push_back({{*first, *event.last_tick}, event.kind, event.trial});
  }
  return claims;
}

std::vector<TickRange> merged(std::vector<TickRange> ranges) {
  std::ranges::sort(ranges, {}, &TickRange::first_tick);
  std::vector<TickRange> result;
  for (const TickRange& range : ranges) {
    if (range.last_tick < range.first_tick) continue;
    if (!result.empty() && range.first_tick <= result.back().last_tick + 1) {
      result.back().last_tick = std::max(result.back().last_tick, range.last_tick);
    } else {
      result.push_back(range);
    }
  }
  return result;
}

std::vector<TickRange> missing_in(const std::vector<TickRange>& ranges, TickRange ticks) {
  std::vector<TickRange> missing;
  std::int64_t next = ticks.first_tick;
  for (const TickRange& range : ranges) {
    if (range.last_tick < next) continue;
    if (range.first_tick > ticks.last_tick) break;
    if (range.first_tick > next) missing.push_back({next, range.first_tick - 1});
    next = range.last_tick + 1;
  }
  if (next <= ticks.last_tick) missing.push_back({next, ticks.last_tick});
  return missing;
}

std::int64_t num_ticks(const std::vector<TickRange>& ranges) noexcept {
  std::int64_t count = 0;
  for (const TickRange& range : ranges) count += range.last_tick - range.first_tick + 1;
  return count;
}

}  // namespace jnd::core
