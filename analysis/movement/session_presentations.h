#pragma once

#include <optional>
#include <vector>

#include "analysis/movement/force_by_speed.h"
#include "analysis/movement/presentation_movement.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What was presented when, before any sample is read.
struct PlannedPresentation {
  PresentationMovement movement;  ///< Its identity alone.
  CommandedForce commanded;
  bool is_level = false;  ///< Its intensity is one that the block was designed with.
};

/// Presentations of trials whose answer stands, and with `explored` the media explored outside
/// of trials, by their first tick. Throws `Error` for damaged rows. Not real time.
[[nodiscard]] std::vector<PlannedPresentation> presentations_of(const core::StudyStore& store,
                                                                std::int64_t session,
                                                                bool explored);

/// Time that a change of the medium takes, as the session's study says.
[[nodiscard]] double ramp_s_of(const core::StudyStore& store, const core::SessionRow& session);

/// Height of z = 0 above the floor in a simulated laboratory; nothing with persons.
[[nodiscard]] std::optional<double> surface_height_m_of(const core::SessionRow& session);

/// What the participant answered to "body_height_m"; nothing without a number in [0.5, 2.5].
[[nodiscard]] std::optional<double> body_height_m_of(const core::StudyStore& store,
                                                     std::int64_t session);

}  // namespace jnd::analysis
