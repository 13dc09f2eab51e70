#include "experiments/session/plan.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/hand.h"
#include "core/random_stream.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/session/event.h"
#include "experiments/session/session.h"
#include "experiments/session/stimulus.h"

namespace jnd::experiments {
namespace {

double total_duration_s(const std::vector<Exploration>& explorations) {
  double duration_s = 0.0;
  for (const Exploration& exploration : explorations) duration_s += exploration.duration_s;
  return duration_s;
}

/// Collects the settings of a study's stages, arms included, each once for a stage.
class RangeCollector {
 public:
  explicit RangeCollector(const RangeLimits& limits) : limits_(limits) {}

  void add(const std::vector<Stage>& stages) {
    for (const Stage& stage : stages) add(stage);
  }

  std::vector<RangeEntry> entries;

 private:
  void add(const Stage& stage) {
    if (const auto* explore = std::get_if<Explore>(&stage.content)) {
      for (const Exploration& medium : explore->media) add(stage, medium.setting);
    } else if (const auto* training = std::get_if<Training>(&stage.content)) {
      for (const Exploration& example : training->examples) add(stage, example.setting);
    } else if (const auto* post = std::get_if<PostExperiment>(&stage.content)) {
      for (const PostExperimentItem& item : post->items) add(stage, item.setting);
    } else if (const auto* block = std::get_if<Block>(&stage.content)) {
      std::vector<double> intensities = block->intensities;
      if (block->reference_intensity) intensities.push_back(*block->reference_intensity);
      if (block->max_intensity) intensities.push_back(*block->max_intensity);
      std::sort(intensities.begin(), intensities.end());
      for (const double intensity : intensities) {
        add(stage, {block->medium, block->quantity, intensity});
      }
    } else if (const auto* counterbalance = std::get_if<Counterbalance>(&stage.content)) {
      for (const Counterbalance::Arm& arm : counterbalance->arms) add(arm.stages);
      add(counterbalance->between);
    }
  }

  void add(const Stage& stage, const MediumSetting& setting) {
    for (const RangeEntry& known : entries) {
      if (known.stage == stage.name && known.setting.medium == setting.medium &&
          known.setting.intensity == setting.intensity) {
        return;
      }
    }
    const core::MediumAmounts amounts = amounts_of(setting);
    const core::HandMotion motion = {
        .velocity_m_per_s = {limits_.expected_speed_m_per_s, 0.0, 0.0},
        .speed_m_per_s = limits_.expected_speed_m_per_s,
        .sin_angle_of_attack = 1.0};
    const double share =
        *std::max_element(core::kAreaShareRatio.begin(), core::kAreaShareRatio.end());
    RangeEntry entry;
    entry.stage = stage.name;
    entry.setting = setting;
    entry.total_force_n =
        amounts.drag_n(motion) + amounts.plane_stiffness_n_per_m * limits_.expected_depth_m;
    entry.largest_point_force_n = share * entry.total_force_n;
    const double most_n =
        std::min(limits_.max_total_force_n, limits_.max_force_per_point_n / share);
    entry.fits = entry.total_force_n <= most_n;
    // quadratic v^2 + linear v = most, in the form that keeps its digits where one is 0.
    const double quadratic =
        amounts.quadratic_kg_per_m * core::WaterDrag::drag_coefficient(1.0);
    const double linear = amounts.damping_n_s_per_m;
    if (quadratic > 0.0 || linear > 0.0) {
      entry.fits_up_to_m_per_s =
          2.0 * most_n / (linear + std::sqrt(linear * linear + 4.0 * quadratic * most_n));
    }
    entries.push_back(entry);
  }

  const RangeLimits& limits_;
};

}  // namespace

double expected_duration_s(const Stage& stage, const ExpectedTimes& times) {
  return std::visit(
      [&](const auto& content) -> double {
        using Content = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<Content, Checklist>) {
          return times.checklist_item_s * static_cast<double>(content.items.size());
        } else if constexpr (std::is_same_v<Content, Consent>) {
          return times.consent_paragraph_s * static_cast<double>(content.paragraphs.size());
        } else if constexpr (std::is_same_v<Content, Explore>) {
          return total_duration_s(content.media);
        } else if constexpr (std::is_same_v<Content, Training>) {
          return total_duration_s(content.examples);
        } else if constexpr (std::is_same_v<Content, Block>) {
          return (content.free_space_between_s + content.expected_trial_s) *
                 procedure_named(content.procedure).expected_trials(content);
        } else if constexpr (std::is_same_v<Content, Break>) {
          return content.duration_s;
        } else if constexpr (std::is_same_v<Content, PostExperiment>) {
          return times.post_experiment_item_s * static_cast<double>(content.items.size());
        } else if constexpr (std::is_same_v<Content, Questionnaire>) {
          return times.questionnaire_item_s * static_cast<double>(content.items.size());
        } else {
          return 0.0;  // A counterbalance is resolved before anything takes time.
        }
      },
      stage.content);
}

std::vector<ParticipantPlan> plan_participants(const Study& study, const PlanRequest& request) {
  std::vector<Cell> cells =
      planned_cells(study, request.completed, request.seed, request.num_earlier_sessions,
                    static_cast<int>(request.participants.size()));
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
      const auto* block = std::get_if<Block>(&stage.content);
      if (block == nullptr) continue;
      const auto stage_index = static_cast<std::int64_t>(index);
      // The key of the draw that a session makes on entering a block: 0 trials answered.
      core::RandomStream stream(seed, "order", {stage_index, 0});
      const Procedure& procedure = procedure_named(block->procedure);
      plan.blocks.push_back({&stage, stage_index, procedure.expected_trials(*block),
                             procedure.draw_next(*block, {}, stream)});
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

std::vector<std::string> completed_cells(const core::StudyStore& store) {
  std::vector<std::string> cells;
  for (const core::SessionRow& row : store.sessions()) {
    if (!row.pilot && store.completed(row.session)) cells.push_back(row.cells);
  }
  return cells;
}

std::vector<RangeEntry> planned_range(const Study& study, const RangeLimits& limits) {
  RangeCollector collector(limits);
  collector.add(study.stages);
  return std::move(collector.entries);
}

}  // namespace jnd::experiments
