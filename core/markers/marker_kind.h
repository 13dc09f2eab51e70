#pragma once

#include <optional>

#include "core/marker.h"
#include "core/storage/study_rows.h"

namespace jnd::core {

/// Which pulse an event has; none for most. It follows from the event's kind alone, so that
/// pulses unblind nobody. The end is no event: it is told before the last one is stored.
[[nodiscard]] std::optional<MarkerKind> marker_kind_of(const EventRow& event);

}  // namespace jnd::core
