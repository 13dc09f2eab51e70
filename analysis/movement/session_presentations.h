#pragma once

#include <optional>
#include <vector>

#include "analysis/movement/force_by_speed.h"
#include "analysis/movement/presentation_movement.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// A presentation before any sample is read.
struct PlannedPresentation {
  PresentationMovement movement;  ///< Only its identity is filled in.
  CommandedForce commanded;
  bool is_level = false;  ///< Whether its intensity is one of the block's design.
};

/// The presentations of trials whose answer is valid and, with `explored`, the media explored
/// outside of trials, by their first tick. Throws `Error` for damaged rows. Not real time.
[[nodiscard]] std::vector<PlannedPresentation> presentations_of(const core::StudyStore& store,
                                                                std::int64_t session,
                                                                bool explored);

/// The time that a change of the medium takes in the session's study.
[[nodiscard]] double ramp_s_of(const core::StudyStore& store, const core::SessionRow& session);

/// The height of z = 0 above the floor in a simulated laboratory. It is absent for sessions
/// with persons.
[[nodiscard]] std::optional<double> surface_height_m_of(const core::SessionRow& session);

/// The participant's answer to "body_height_m". It is absent unless it is a number in
/// [0.5, 2.5].
[[nodiscard]] std::optional<double> body_height_m_of(const core::StudyStore& store,
                                                     std::int64_t session);

}  // namespace jnd::analysis
