#pragma once

#include <optional>

#include "core/marker.h"
#include "core/storage/study_rows.h"

namespace jnd::core {

/// Returns the pulse of an event; most events have none. It depends on the event's kind alone,
/// so that pulses unblind nobody. The end of a session is no event: its pulse is sent before
/// the last event is stored.
[[nodiscard]] std::optional<MarkerKind> marker_kind_of(const EventRow& event);

}  // namespace jnd::core
