#include "core/markers/marker_kind.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace jnd::core {
namespace {

constexpr std::array<std::pair<std::string_view, MarkerKind>, 5> kPulsedEvents = {
    {{"stage_entered", MarkerKind::kStage},
     {"trial_started", MarkerKind::kTrial},
     {"presentation_started", MarkerKind::kPresentation},
     {"trial_answered", MarkerKind::kAnswer},
     {"fault_raised", MarkerKind::kFault}}};

}  // namespace

std::optional<MarkerKind> marker_kind_of(const EventRow& event) {
  const auto* const found =
      std::ranges::find(kPulsedEvents, event.kind, [](const auto& row) { return row.first; });
  if (found == kPulsedEvents.end()) return std::nullopt;
  return found->second;
}

}  // namespace jnd::core
