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

/// One trial: what its presentations of test and reference come to together.
struct TrialMovement {
  std::int64_t session = 0, trial = 0;
  std::string block;
  std::int64_t repetition = 0;
  StrokeMeans strokes;
  std::optional<double> mean_height_m;
  MovementMarks marks;  ///< Of all its presentations, free space included.
};

/// One participant in one condition: a block as a whole (`intensity` absent, free space between
/// stimuli left out) or one intensity of it; with block "", a medium explored outside of
/// trials.
struct ConditionMovement {
  std::string block;
  std::string medium;
  std::optional<double> intensity;
  int num_presentations = 0;
  int num_marked = 0;   ///< Of them: ticks missing, contact lost, limited or at fault.
  StrokeMeans strokes;  ///< Over all strokes of the condition.
  std::optional<double> mean_height_m;
  std::optional<double> hand_height_ratio;  ///< Above the floor, of the body height.
  StrokeCurves curves;  ///< Of strokes without gap, lost contact, fault and pause.
  ForceBySpeed force;
};

/// One participant. Where nothing was recorded everything is empty and `reason` says why.
struct ParticipantMovement {
  std::string participant;
  std::string reason;                      ///< "" if there is a recording.
  std::int64_t num_samples = 0;            ///< Samples that were analysed.
  std::int64_t missing_ticks = 0;          ///< Ticks that are missing from the whole recording.
  std::optional<double> body_height_m;     ///< Body height that the participant told.
  std::optional<double> surface_height_m;  ///< Of z = 0 above the floor, if it is known.
  std::vector<PresentationMovement> presentations;  ///< Presentations whose answer stands.
  std::vector<TrialMovement> trials;
  std::vector<ConditionMovement> conditions;
  std::vector<Trajectory> trajectories;

  /// Nullptr if there is none. Without `intensity`: the block as a whole.
  [[nodiscard]] const ConditionMovement* find(
      const std::string& block, std::optional<double> intensity = std::nullopt) const;
};

/// Everything that the recordings of a study say about movement.
struct MovementAnalysis {
  bool simulated = false;
  std::vector<ParticipantMovement> participants;  ///< By pseudonym.

  /// Whether anybody's movement was recorded.
  [[nodiscard]] bool any() const noexcept;
};

struct MovementOptions {
  double hysteresis_m = 0.03;  ///< > 0; less than half of any stroke that shall count.
  /// Where the palm faces, x and y of the workspace frame. Absent: along x to the side of the
  /// end effector, for the palm pushes against what carries the fingers; +x where it is less
  /// than 5 cm aside.
  std::optional<std::array<double, 2>> forward;
  double rest_speed_m_per_s = 0.02;  ///< Below it the hand rests, > 0.
  double shortest_pause_s = 0.15;  ///< Rest shorter than that belongs to a turning point, > 0.
  /// Of the surface above the floor; absent: as a simulated laboratory says, else unknown.
  std::optional<double> surface_height_m;
  bool pilot = false;    ///< Pilot sessions as well.
  bool explored = true;  ///< Media explored outside of trials as well.
  int jobs = 1;          ///< Recordings at once, >= 1; the result is the same for any.
  /// Told how much is done, 0 to 1, from any of the jobs; what it throws ends the analysis.
  std::function<void(double)> on_progress;
};

/// Reads every recording of the folder once, from end to end; in memory is at most half a
/// minute of each that is being read. Trials that were undone or set aside are left out. A
/// damaged recording leaves its participant empty, with the reason. Whether it may be seen
/// (double-blind studies) is the caller's. Throws `Error` for a damaged database and for
/// options out of range.
[[nodiscard]] MovementAnalysis analyse_movement(const core::StudyStore& store,
                                                const MovementOptions& options = {});

}  // namespace jnd::analysis
