#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/movement/force_by_speed.h"
#include "analysis/movement/presentation_movement.h"
#include "analysis/movement/recorded_strokes.h"
#include "analysis/movement/stroke_curves.h"
#include "analysis/movement/trajectory.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// The movement in one trial, over its presentations of test and reference together.
struct TrialMovement {
  std::int64_t session = 0, trial = 0;
  std::string block;
  std::int64_t repetition = 0;
  StrokeMeans strokes;
  std::optional<double> mean_height_m;
  MovementMarks marks;  ///< The marks of all its presentations, including free space.
};

/// The movement of one participant in one condition. A condition is a whole block (without
/// `intensity`; free space between stimuli is left out) or one of its intensities. With block
/// "" it is a medium that was explored outside of trials.
struct ConditionMovement {
  std::string block;
  std::string medium;
  std::optional<double> intensity;
  int num_presentations = 0;
  /// The number of presentations with missing ticks, lost contact, limited force or a fault.
  int num_marked = 0;
  StrokeMeans strokes;  ///< Means over all strokes of the condition.
  std::optional<double> mean_height_m;
  /// The height above the floor divided by the body height.
  std::optional<double> hand_height_ratio;
  StrokeCurves curves;  ///< The curves of strokes without gap, lost contact, fault and pause.
  ForceBySpeed force;
};

/// The movement of one participant. If nothing was recorded, everything is empty and `reason`
/// says why.
struct ParticipantMovement {
  std::string participant;
  /// Why there is nothing; "" if there is a recording.
  std::string reason;
  std::int64_t num_samples = 0;  ///< The number of samples that were analysed.
  /// The number of ticks that are missing from the whole recording.
  std::int64_t missing_ticks = 0;
  std::optional<double> body_height_m;  ///< The body height that the participant stated.
  /// The height of z = 0 above the floor, if it is known.
  std::optional<double> surface_height_m;
  /// The presentations whose answer is valid.
  std::vector<PresentationMovement> presentations;
  std::vector<TrialMovement> trials;
  std::vector<ConditionMovement> conditions;
  std::vector<Trajectory> trajectories;

  /// The condition; nullptr if there is none. Without `intensity` it is the whole block.
  [[nodiscard]] const ConditionMovement* find(
      const std::string& block, std::optional<double> intensity = std::nullopt) const;
};

/// The movement in all recordings of a study.
struct MovementAnalysis {
  bool simulated = false;
  std::vector<ParticipantMovement> participants;  ///< Sorted by pseudonym.

  /// Whether anybody's movement was recorded.
  [[nodiscard]] bool any() const noexcept;
};

struct MovementOptions {
  double hysteresis_m = 0.03;  ///< > 0, and less than half of any stroke that should count.
  /// The direction in which the palm faces, x and y of the workspace frame. Without it the
  /// direction is along x toward the end effector, because the palm pushes against what carries
  /// the fingers. It is +x if the end effector is less than 5 cm aside.
  std::optional<std::array<double, 2>> forward;
  double rest_speed_m_per_s = 0.02;  ///< Below this speed the hand rests. > 0.
  double shortest_pause_s = 0.15;    ///< A shorter rest belongs to a turning point. > 0.
  /// The height of the surface above the floor. Without it the height is that of a simulated
  /// laboratory, or unknown.
  std::optional<double> surface_height_m;
  bool pilot = false;    ///< Whether to include pilot sessions.
  bool explored = true;  ///< Whether to include media that were explored outside of trials.
  /// The number of recordings that are read at once, >= 1. The result does not depend on it.
  int jobs = 1;
  /// Receives the share of the work that is done, 0 to 1, from any of the jobs. An exception
  /// from it ends the analysis.
  std::function<void(double)> on_progress;
};

/// Reads every recording of the folder once from end to end. At most half a minute of each open
/// recording is in memory. Trials that were undone or set aside are left out. A damaged
/// recording leaves its participant empty, with the reason. The caller decides whether the
/// result may be seen (in double-blind studies). Throws `Error` for a damaged database and for
/// options out of range.
[[nodiscard]] MovementAnalysis analyse_movement(const core::StudyStore& store,
                                                const MovementOptions& options = {});

}  // namespace jnd::analysis
