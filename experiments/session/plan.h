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

/// A block with the order in which its first trials will be drawn: all of them, unless the
/// procedure adapts.
struct PlannedBlock {
  const Stage* stage = nullptr;
  std::int64_t stage_index = 0;  ///< Into the participant's own list, as in events.
  int num_trials = 0;            ///< To be expected.
  std::vector<PlannedTrial> trials;
};

/// Blocks whose trials are mixed.
struct PlannedGroup {
  std::string name;
  Turns turns = Turns::kRounds;
  std::vector<const Stage*> blocks;
  /// Whose trials come one after the other, as indices of `blocks`; empty where answers decide
  /// how many trials a block has.
  std::vector<std::size_t> order;
};

/// What one participant will get.
struct ParticipantPlan {
  std::string participant;
  Cell cell;
  std::vector<StageInstance> stages;
  std::vector<PlannedBlock> blocks;
  std::vector<PlannedGroup> groups;
  double duration_s = 0.0;          ///< To be expected.
  double longest_duration_s = 0.0;  ///< With all trials that its blocks can have.
};

struct PlanRequest {
  std::vector<std::string> participants;  ///< Pseudonyms, in the order in which they come.
  std::uint64_t seed = 0;                 ///< Seed of the study.
  std::int64_t num_earlier_sessions = 0;  ///< In the study folder, completed or not.
  std::vector<std::string> completed;     ///< Cells of those completed.
  FieldValues fields{};  ///< What all of them bring; none: drawn, as simulated ones do.
};

/// Cells and orders exactly as the sessions will draw them, if they come in this sequence and
/// all complete. The study must outlive the plan. Throws `Error` for a procedure that lacks
/// something. Not real time.
[[nodiscard]] std::vector<ParticipantPlan> plan_participants(const Study& study,
                                                             const PlanRequest& request);

/// Cells of the completed sessions of a study folder; neither pilots count nor sessions of
/// which every answer is set aside.
[[nodiscard]] std::vector<std::string> completed_cells(const core::StudyStore& store);

/// What the device can render and how the hand is expected to move.
struct RangeLimits {
  double max_force_per_point_n = 0.0;  ///< > 0.
  double max_total_force_n = 0.0;      ///< > 0.
  /// Of the whole force, at the point that carries most of it; > 0, at most 1.
  double largest_share_ratio = core::kAreaShareRatio[0];
  double expected_speed_m_per_s = 0.5;  ///< > 0; the hand turned to where it feels the most.
  double expected_depth_m = 0.01;       ///< > 0; of the hand in a solid surface.
};

/// One stimulus of the study against the limits.
struct RangeEntry {
  std::string stage;  ///< Name.
  MediumSetting setting;
  double total_force_n = 0.0;          ///< On the whole hand, at the expected speed or depth.
  double largest_point_force_n = 0.0;  ///< On the point with the largest share.
  bool fits = false;
  /// The speed up to which both limits hold, at most 1000 m/s; none for a medium that does not
  /// resist motion.
  std::optional<double> fits_up_to_m_per_s;
};

/// Every stimulus that any participant of the study can be given, once for each stage, in the
/// order of the file; of an adjustment the starting values and its end, where it has one.
[[nodiscard]] std::vector<RangeEntry> planned_range(const Study& study,
                                                    const RangeLimits& limits);

}  // namespace jnd::experiments
