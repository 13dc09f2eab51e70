#include "experiments/session/plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>

#include "core/hand.h"
#include "core/random_stream.h"
#include "experiments/order/block_turns.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/session/event.h"
#include "experiments/session/session.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

/// Returns the largest force that a hand feels at this speed, over all angles of attack.
double moving_force_n(const core::MediumAmounts& amounts, const core::ForceMap* map,
                      double speed_m_per_s) {
  constexpr int kNumAngles = 90;
  double most_n = 0.0;
  for (int i = 0; i <= kNumAngles; ++i) {
    const double angle_rad = 0.5 * std::numbers::pi * i / kNumAngles;
    const core::HandMotion motion = {.velocity_m_per_s = {speed_m_per_s, 0.0, 0.0},
                                     .speed_m_per_s = speed_m_per_s,
                                     .sin_angle_of_attack = std::sin(angle_rad)};
    const double lift = map == nullptr ? 0.0 : map->at(angle_rad, speed_m_per_s).lift;
    most_n = std::max(most_n,
                      std::hypot(amounts.drag_n(motion, map),
                                 amounts.lift_kg_per_m * lift * speed_m_per_s * speed_m_per_s));
  }
  return most_n + amounts.ellipsoid_normal_n_s_per_m * speed_m_per_s;
}

/// Returns the speed at which the moving hand feels `most_n`, or none for a medium that does
/// not resist motion.
std::optional<double> fits_up_to_m_per_s(const core::MediumAmounts& amounts,
                                         const core::ForceMap* map, double most_n) {
  if (!(moving_force_n(amounts, map, 1.0) > 0.0)) return std::nullopt;
  double fits = 0.0;
  double too_fast = 1000.0;
  for (int halving = 0; halving < 80; ++halving) {
    const double speed = 0.5 * (fits + too_fast);
    (moving_force_n(amounts, map, speed) <= most_n ? fits : too_fast) = speed;
  }
  return fits;
}

/// Collects the settings of a study's stages, including those in arms, each once for a stage.
class RangeCollector {
 public:
  RangeCollector(const RangeLimits& limits, const core::ForceMap* map)
      : limits_(limits), map_(map) {}

  void add(const Stage& stage) {
    if (const auto* explore = std::get_if<Explore>(&stage.content)) {
      for (const Exploration& medium : explore->media) add(stage, medium.setting);
    } else if (const auto* training = std::get_if<Training>(&stage.content)) {
      for (const Exploration& example : training->examples) add(stage, example.setting);
    } else if (const auto* post = std::get_if<PostExperiment>(&stage.content)) {
      for (const PostExperimentItem& item : post->items) add(stage, item.setting);
    } else if (const auto* block = std::get_if<Block>(&stage.content)) {
      std::vector<double> intensities =
          procedure_named(block->procedure).possible_intensities(*block);
      if (block->reference_intensity) intensities.push_back(*block->reference_intensity);
      if (block->max_intensity) intensities.push_back(*block->max_intensity);
      std::sort(intensities.begin(), intensities.end());
      for (const double intensity : intensities) {
        add(stage, setting_of(*block, "test", intensity));
      }
      for (const double standard : block->standards) {
        add(stage, setting_of(*block, "reference", standard));
      }
    }
  }

  std::vector<RangeEntry> entries;

 private:
  void add(const Stage& stage, const MediumSetting& setting) {
    for (const RangeEntry& known : entries) {
      if (known.stage == stage.name && known.setting == setting) return;
    }
    const core::MediumAmounts amounts = amounts_of(setting);
    const double share = limits_.largest_share_ratio;
    RangeEntry entry;
    entry.stage = stage.name;
    entry.setting = setting;
    entry.total_force_n =
        moving_force_n(amounts, map_, limits_.expected_speed_m_per_s) + amounts.buoyancy_n +
        std::hypot(amounts.plane_stiffness_n_per_m, amounts.plane_friction_n_per_m) *
            limits_.expected_depth_m;
    entry.largest_point_force_n = share * entry.total_force_n;
    const double most_n =
        std::min(limits_.max_total_force_n, limits_.max_force_per_point_n / share);
    entry.fits = entry.total_force_n <= most_n;
    entry.fits_up_to_m_per_s = fits_up_to_m_per_s(amounts, map_, most_n - amounts.buoyancy_n);
    entries.push_back(entry);
  }

  const RangeLimits& limits_;
  const core::ForceMap* map_;
};

/// Returns the groups among a participant's stages, with their turns as the session will draw
/// them.
std::vector<PlannedGroup> planned_groups(const ParticipantPlan& plan, std::uint64_t seed) {
  std::vector<const Stage*> stages;
  for (const StageInstance& instance : plan.stages) stages.push_back(instance.stage);
  std::vector<PlannedGroup> groups;
  for (std::size_t first = 0, num = 1; first < stages.size(); first += num) {
    num = num_run_together(stages, first);
    if (num == 1) continue;
    PlannedGroup& group = groups.emplace_back();
    group.name = stages[first]->interleaving->name;
    group.turns = stages[first]->interleaving->turns;
    std::vector<int> num_trials;
    bool answers_decide = false;
    for (const PlannedBlock& block : plan.blocks) {
      const auto index = static_cast<std::size_t>(block.stage_index);
      if (index < first || index >= first + num) continue;
      group.blocks.push_back(block.stage);
      num_trials.push_back(static_cast<int>(block.trials.size()));
      answers_decide =
          answers_decide ||
          procedure_named(std::get<Block>(block.stage->content).procedure).adapts();
    }
    if (answers_decide) continue;
    group.order = all_turns(group.turns, num_trials, seed, static_cast<std::int64_t>(first));
  }
  return groups;
}

}  // namespace

std::vector<ParticipantPlan> plan_participants(const Study& study, const PlanRequest& request) {
  std::vector<Cell> cells =
      planned_cells(study, request.completed, request.seed, request.num_earlier_sessions,
                    static_cast<int>(request.participants.size()), request.fields);
  std::vector<ParticipantPlan> plans;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ParticipantPlan plan;
    plan.participant = request.participants[i];
    plan.stages = stages_of(study, cells[i]);
    plan.cell = std::move(cells[i]);
    const std::uint64_t seed = session_seed(request.seed, study.name, plan.participant);
    for (std::size_t index = 0; index < plan.stages.size(); ++index) {
      const Stage& stage = *plan.stages[index].stage;
      plan.duration_s += expected_duration_s(stage);
      plan.longest_duration_s += longest_duration_s(stage);
      const auto* block = std::get_if<Block>(&stage.content);
      if (block == nullptr) continue;
      const auto stage_index = static_cast<std::int64_t>(index);
      // This is the key of the draw that a session makes when it enters a block: 0 trials are
      // answered.
      core::RandomStream stream(seed, "order", {stage_index, 0});
      plan.blocks.push_back(
          {&stage, stage_index, expected_trials(*block),
           next_trials(block_of(stage, plan.stages[index].order_row), {}, stream)});
    }
    plan.groups = planned_groups(plan, seed);
    plans.push_back(std::move(plan));
  }
  return plans;
}

std::vector<std::string> completed_cells(const core::StudyStore& store) {
  std::set<std::int64_t> counted;
  for (const core::SessionOverview& one : store.overview()) {
    if (one.counts()) counted.insert(one.session);
  }
  std::vector<std::string> cells;
  for (const core::SessionRow& row : store.sessions()) {
    if (!row.pilot && counted.contains(row.session)) cells.push_back(row.cells);
  }
  return cells;
}

std::vector<RangeEntry> planned_range(const Study& study, const RangeLimits& limits) {
  const std::unique_ptr<const core::ForceMap> map = force_map_of(study.device);
  RangeCollector collector(limits, map.get());
  for_each_stage(study.stages, [&](const Stage& stage) { collector.add(stage); });
  return std::move(collector.entries);
}

}  // namespace jnd::experiments
