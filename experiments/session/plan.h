#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/order/counterbalance.h"
#include "experiments/procedures/expected_session.h"
#include "experiments/procedures/procedure.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// A block with its first trials in the order in which they will be drawn. These are all trials
/// unless the procedure adapts.
struct PlannedBlock {
  const Stage* stage = nullptr;
  std::int64_t stage_index = 0;  ///< Index into the participant's own list, as in events.
  int num_trials = 0;            ///< Expected number.
  std::vector<PlannedTrial> trials;
};

/// Blocks whose trials are mixed.
struct PlannedGroup {
  std::string name;
  Turns turns = Turns::kRounds;
  std::vector<const Stage*> blocks;
  /// The block of each trial in turn, as indices of `blocks`. Empty if answers determine how
  /// many trials a block has.
  std::vector<std::size_t> order;
};

/// What one participant will get.
struct ParticipantPlan {
  std::string participant;
  Cell cell;
  std::vector<StageInstance> stages;
  std::vector<PlannedBlock> blocks;
  std::vector<PlannedGroup> groups;
  double duration_s = 0.0;          ///< Expected duration.
  double longest_duration_s = 0.0;  ///< Duration if its blocks have as many trials as possible.
};

struct PlanRequest {
  /// Pseudonyms in the order in which the participants come.
  std::vector<std::string> participants;
  std::uint64_t seed = 0;                 ///< Seed of the study.
  std::int64_t num_earlier_sessions = 0;  ///< Sessions in the study folder, completed or not.
  std::vector<std::string> completed;     ///< Cells of the completed sessions.
  /// Fields that all of these participants have; if empty, they are drawn as for simulated
  /// ones.
  FieldValues fields{};
};

/// Returns cells and orders exactly as the sessions will draw them, if the participants come in
/// this sequence and all complete. The study must outlive the plan. Throws `Error` for a
/// procedure that lacks something. Not real time.
[[nodiscard]] std::vector<ParticipantPlan> plan_participants(const Study& study,
                                                             const PlanRequest& request);

/// Cells of the completed sessions of a study folder; neither pilots count nor sessions of
/// which every answer is set aside.
[[nodiscard]] std::vector<std::string> completed_cells(const core::StudyStore& store);

/// What the device can render, and how the hand is expected to move.
struct RangeLimits {
  double max_force_per_point_n = 0.0;  ///< > 0.
  double max_total_force_n = 0.0;      ///< > 0.
  /// Share of the total force at the point that carries most of it; > 0, at most 1.
  double largest_share_ratio = core::kAreaShareRatio[0];
  /// > 0; the hand is turned to where it feels the largest force.
  double expected_speed_m_per_s = 0.5;
  double expected_depth_m = 0.01;  ///< Depth of the hand in a solid surface, > 0.
};

/// One stimulus of the study compared with the limits.
struct RangeEntry {
  std::string stage;  ///< Name of the stage.
  MediumSetting setting;
  /// Force on the whole hand, at the expected speed or depth.
  double total_force_n = 0.0;
  double largest_point_force_n = 0.0;  ///< Force on the point with the largest share.
  bool fits = false;
  /// Speed up to which both limits hold, at most 1000 m/s; none for a medium that does not
  /// resist motion.
  std::optional<double> fits_up_to_m_per_s;
};

/// Returns every stimulus that any participant of the study can get, once for each stage, in
/// the order of the file. For an adjustment these are the starting values and its end, if it
/// has one.
[[nodiscard]] std::vector<RangeEntry> planned_range(const Study& study,
                                                    const RangeLimits& limits);

}  // namespace jnd::experiments
