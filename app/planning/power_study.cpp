#include "app/planning/power_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "analysis/results/sequential_results.h"
#include "app/command_line/command.h"
#include "app/planning/plan_statistics.h"
#include "app/session/pseudonym.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random_stream.h"
#include "core/storage/sha256.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/median_person.h"
#include "experiments/procedures/contrast_conditions.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/procedures/task.h"
#include "experiments/session/plan.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace {

using namespace experiments;
using analysis::PlannedAnalysis;
using analysis::PlannedAnswers;
using analysis::PlannedBlock;
using analysis::PlannedPerson;
using analysis::PlannedQuantity;

constexpr double kRatioPerPercent = 0.01;

/// Decides for what a block's answers are analysed; no other place does.
PlannedQuantity quantity_of(const Block& block) {
  const TrialForm form = procedure_named(block.procedure).form(block);
  switch (form.answer) {
    case AnswerKind::kYesNo:
    case AnswerKind::kInterval:
      return PlannedQuantity::kWeberFraction;
    case AnswerKind::kMatch:
      return form.has_reference ? PlannedQuantity::kMatch
                                : PlannedQuantity::kProductionExponent;
    case AnswerKind::kStep:
      return PlannedQuantity::kRating;
    case AnswerKind::kPercent:
    case AnswerKind::kNumber:
      break;
  }
  return PlannedQuantity::kEstimationExponent;
}

PlannedAnswers answers_of(const std::vector<AnsweredTrial>& trials, PlannedQuantity quantity) {
  PlannedAnswers answers;
  std::map<std::pair<double, double>, analysis::AnswerCount> counts;
  for (const auto& [planned, response] : trials) {
    if (planned.is_catch || !response) continue;
    if (quantity == PlannedQuantity::kWeberFraction) {
      const double order = analysis::order_of(planned.test_interval);
      analysis::AnswerCount& count = counts[{planned.intensity.value(), order}];
      count.intensity = *planned.intensity;
      count.order = order;
      count.num_yes += *response > 0.5 ? 1 : 0;
      ++count.num_trials;
    } else if (quantity == PlannedQuantity::kProductionExponent) {
      answers.magnitudes[planned.target_percent.value()].push_back(*response);
    } else if (quantity == PlannedQuantity::kMatch) {
      answers.magnitudes[planned.reference_intensity.value()].push_back(*response);
    } else if (quantity == PlannedQuantity::kRating) {
      answers.magnitudes[planned.intensity.value()].push_back(*response);
    } else {
      answers.magnitudes[planned.intensity.value()].push_back(*response * kRatioPerPercent);
    }
  }
  for (const auto& [key, count] : counts) answers.counts.push_back(count);
  return answers;
}

/// One person's answers in every block of the analysis.
PlannedPerson person_of(const PlannedAnalysis& analysis,
                        const std::vector<AnsweredBlock>& answered) {
  PlannedPerson person(analysis.blocks.size());
  for (const AnsweredBlock& block : answered) {
    for (std::size_t place = 0; place < analysis.blocks.size(); ++place) {
      if (analysis.blocks[place].name != block.stage->name) continue;
      person[place] = answers_of(block.trials, analysis.blocks[place].quantity);
      const auto& written = std::get<Block>(block.stage->content);
      person[place].at_grid_end =
          procedure_named(written.procedure).rule() == AdaptiveRule::kQuestPlus &&
          !procedure_named(written.procedure).caution(written, block.trials).empty();
    }
  }
  return person;
}

/// True for magnitudes, matches, ratings and comparisons. False for practice, and for tasks
/// that ask whether anything is there or different, or which of three intervals it is.
bool is_planned_for(const Block& block) {
  if (block.practice) return false;
  return !block.settings.has("task") || task_of(block) == Task::kReminder ||
         task_of(block) == Task::kTwoInterval;
}

/// The blocks that any participant gets, each once, in the order of the study file.
std::vector<const Stage*> blocks_of(const Study& study) {
  std::vector<const Stage*> blocks;
  for (const Cell& cell : cells_of(study)) {
    for (const StageInstance& instance : stages_of(study, cell)) {
      const auto* block = std::get_if<Block>(&instance.stage->content);
      if (block == nullptr || !is_planned_for(*block)) continue;
      const bool known = std::any_of(blocks.begin(), blocks.end(), [&](const Stage* other) {
        return other->name == instance.stage->name;
      });
      if (!known) blocks.push_back(instance.stage);
    }
  }
  // The order of the file counts, whichever block some participants begin with.
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const Stage* a, const Stage* b) { return a->line < b->line; });
  return blocks;
}

/// The other blocks without practice, in the order of the study's cells, with their tasks.
std::vector<std::string> left_out_of(const Study& study) {
  std::vector<std::string> names;
  for (const Cell& cell : cells_of(study)) {
    for (const StageInstance& instance : stages_of(study, cell)) {
      const auto* block = std::get_if<Block>(&instance.stage->content);
      if (block == nullptr || block->practice || is_planned_for(*block)) continue;
      const std::string task =
          block->settings.has("task") ? ", " + block->settings.word("task") : "";
      const std::string name = instance.stage->name + " (" + block->procedure + task + ")";
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// The message for a study that has no block to plan for.
std::string unplanned_words(const Study& study) {
  std::string blocks;
  for (const std::string& name : left_out_of(study)) {
    blocks += (blocks.empty() ? "" : ", ") + name;
  }
  return study.name +
         ": expected a block to plan for, one that estimates, produces, matches or rates, or "
         "compares by the task `reminder` or `two_interval`, found " +
         (blocks.empty() ? "no block at all; add one"
                         : "only " + blocks +
                               "; simulate the study with several numbers of people, and look "
                               "how wide the intervals of `jnd results` are");
}

const Block& block_of(const Stage& stage) { return std::get<Block>(stage.content); }

bool can_be_compared(const Stage& stage) {
  return quantity_of(block_of(stage)) == PlannedQuantity::kWeberFraction &&
         block_of(stage).reference_intensity.has_value();
}

std::string names_of(const std::vector<const Stage*>& blocks) {
  std::string names;
  for (const Stage* stage : blocks) names += (names.empty() ? "" : ", ") + stage->name;
  return names;
}

std::size_t place_of(const std::vector<const Stage*>& blocks, const std::string& name) {
  for (std::size_t place = 0; place < blocks.size(); ++place) {
    if (blocks[place]->name == name) return place;
  }
  throw UsageError("--compare: expected two of the study's blocks, " + names_of(blocks) +
                   ", found `" + name + "`");
}

std::optional<std::pair<std::size_t, std::size_t>> compared_places(
    const std::vector<const Stage*>& blocks, const PowerRequest& request) {
  if (!request.compare) {
    for (std::size_t a = 0; a < blocks.size(); ++a) {
      if (!can_be_compared(*blocks[a])) continue;
      for (std::size_t b = a + 1; b < blocks.size(); ++b) {
        if (can_be_compared(*blocks[b]) &&
            block_of(*blocks[a]).quantity == block_of(*blocks[b]).quantity) {
          return std::pair(a, b);
        }
      }
    }
    return std::nullopt;
  }
  const std::pair places(place_of(blocks, request.compare->first),
                         place_of(blocks, request.compare->second));
  if (places.first == places.second) {
    throw UsageError("--compare: expected two different blocks, found `" +
                     request.compare->first + "` twice");
  }
  for (const std::size_t place : {places.first, places.second}) {
    if (!can_be_compared(*blocks[place])) {
      throw UsageError(
          "--compare: expected blocks that give a Weber fraction, yes or no against a "
          "reference, found `" +
          blocks[place]->name + "`, a " + block_of(*blocks[place]).procedure);
    }
  }
  const Block& first = block_of(*blocks[places.first]);
  const Block& second = block_of(*blocks[places.second]);
  if (first.quantity != second.quantity) {
    throw UsageError("--compare: expected two blocks of the same quantity, found " +
                     first.quantity + " in `" + request.compare->first + "` and " +
                     second.quantity + " in `" + request.compare->second + "`");
  }
  return places;
}

/// True if some participant gets both blocks.
bool somebody_gets_both(const Study& study, const std::string& first,
                        const std::string& second) {
  for (const Cell& cell : cells_of(study)) {
    int num = 0;
    for (const StageInstance& instance : stages_of(study, cell)) {
      num += instance.stage->name == first || instance.stage->name == second ? 1 : 0;
    }
    if (num == 2) return true;
  }
  return false;
}

/// The value that the same fit finds for very many people of the laboratory. Unlike a Weber
/// fraction, an exponent is not a person's own apart from its procedure: noise, lapses and
/// settings that end short of the target (Stevens and Greenbaum 1966) are part of what is
/// measured.
std::optional<double> value_of_everybody(const Study& study, const Laboratory& laboratory,
                                         const PlannedBlock& block) {
  constexpr std::uint64_t kPeople = 1000;
  const AnswerSimulator simulator(study, laboratory);
  const PlannedAnalysis of_all{.blocks = {block}, .sizes = {static_cast<int>(kPeople)}};
  for (const Cell& cell : cells_of(study)) {
    std::vector<StageInstance> stages = stages_of(study, cell);
    std::erase_if(stages, [&](const StageInstance& instance) {
      return instance.stage->name != block.name;
    });
    if (stages.empty()) continue;
    std::vector<PlannedPerson> people;
    for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
      people.push_back(person_of(of_all, simulator.answers(stages, seed)));
    }
    return analysis::analyse_run(of_all, people).sizes.front().estimates.front().value;
  }
  return std::nullopt;
}

/// The durations as `jnd plan` tells them; for adaptive blocks, those of simulated
/// participants.
std::vector<PlannedDuration> durations_of(const Study& study, const Laboratory& laboratory,
                                          const PowerRequest& request) {
  PlanRequest plan{
      .participants = next_participants(std::set<std::string>{}, request.sizes.back()),
      .seed = request.seed};
  const std::vector<double> each_s =
      plan_statistics(study, plan_participants(study, plan), laboratory, request.seed)
          .durations_s;
  std::vector<PlannedDuration> durations;
  for (const int size : request.sizes) {
    PlannedDuration duration;
    for (int i = 0; i < size; ++i) duration.total_s += each_s[static_cast<std::size_t>(i)];
    duration.mean_s = duration.total_s / size;
    durations.push_back(duration);
  }
  return durations;
}

std::string contrast_meaning(const PlannedContrast& plan) {
  std::string meaning =
      std::string(plan.primary ? "primary" : "secondary") + ", in the " + measure_words(plan);
  if (plan.direction != ContrastDirection::kEither) meaning += ", one-sided";
  if (plan.correction != Correction::kNone) {
    meaning += ", p by " +
               std::string(plan.correction == Correction::kHolm ? "Holm" : "Bonferroni") +
               " within the family " + plan.family;
  }
  return meaning + "; Student's t of people's own contrasts";
}

/// The contrasts of the study file. Those whose blocks are not simulated are added to
/// `left_out`.
std::vector<analysis::PowerContrast> contrasts_of(const Study& study,
                                                  const std::vector<const Stage*>& blocks,
                                                  std::vector<std::string>& left_out) {
  std::vector<analysis::PowerContrast> contrasts;
  for (const PlannedContrast& plan : study.contrasts) {
    const ContrastConditions found = contrast_conditions(study, plan);
    if (plan.measure == ContrastMeasure::kQuestion) {
      left_out.push_back("contrast " + plan.name + " (of a question after the trials)");
      continue;
    }
    if (plan.measure == ContrastMeasure::kResponseTime || !found.problem.empty()) {
      left_out.push_back("contrast " + plan.name + " (simulated people have no " +
                         measure_words(plan) + ")");
      continue;
    }
    analysis::PowerContrast one{.name = plan.name,
                                .meaning = contrast_meaning(plan),
                                .alpha = plan.alpha,
                                .is_ratio = is_ratio(plan.measure),
                                .measure = plan.measure,
                                .tail = analysis::tail_of(plan),
                                .family = plan.family,
                                .correction = plan.correction,
                                .weights = found.weights};
    if (plan.smallest_effect) {
      one.margin = one.is_ratio ? std::log(*plan.smallest_effect) : *plan.smallest_effect;
    }
    bool is_whole = true;
    for (const ContrastCondition& condition : found.conditions) {
      std::vector<std::size_t>& places = one.conditions.emplace_back();
      for (const std::string& name : condition.blocks) {
        const auto place = std::ranges::find(blocks, name, &Stage::name);
        is_whole &= place != blocks.end();
        places.push_back(static_cast<std::size_t>(place - blocks.begin()));
      }
    }
    for (const ContrastGroup& group : found.groups) one.groups.push_back(group.levels);
    if (is_whole) {
      contrasts.push_back(std::move(one));
    } else {
      left_out.push_back("contrast " + plan.name + " (of blocks that are not planned for)");
    }
  }
  return contrasts;
}

/// The looks of the study file. If the deciding contrast is left out, they are added to
/// `left_out`.
std::optional<analysis::PlannedSequential> sequential_of(
    const Study& study, const std::vector<analysis::PowerContrast>& contrasts,
    std::vector<std::string>& left_out) {
  if (!study.sequential) return std::nullopt;
  const std::string& name = study.sequential->contrast;
  if (std::ranges::find(contrasts, name, &analysis::PowerContrast::name) == contrasts.end()) {
    left_out.push_back("looks at the contrast " + name);
    return std::nullopt;
  }
  return analysis::PlannedSequential{
      .contrast = name,
      .boundaries = analysis::boundaries_of(analysis::sequential_rule(study))};
}

/// A laboratory in which two blocks have the same Weber fraction.
Laboratory null_laboratory(const Laboratory& laboratory, const Block& first,
                           const Block& second, const core::ForceMap* map) {
  const double common = std::sqrt(median_weber_fraction(laboratory, first, map) *
                                  median_weber_fraction(laboratory, second, map));
  Laboratory alike = laboratory;
  alike.device.mechanical_viscosity_n_s_per_m = 0.0;
  alike.effects.clear();
  alike.perceiver.weber_fraction = common;
  if (alike.pressing) alike.pressing->weber_fraction = common;
  return alike;
}

}  // namespace

std::uint64_t run_seed(std::uint64_t seed, std::int64_t run) {
  return core::derived_seed(seed, "power run", {run});
}

std::vector<std::int64_t> PowerShard::runs_of(std::int64_t num_runs) const {
  std::vector<std::int64_t> runs;
  for (std::int64_t run = index; run < num_runs; run += count) runs.push_back(run);
  return runs;
}

PowerStudy::PowerStudy(const Study& study, const Laboratory& laboratory,
                       const PowerRequest& request)
    : study_(study), laboratory_(laboratory) {
  const std::vector<const Stage*> blocks = blocks_of(study);
  if (blocks.empty()) {
    throw UsageError(unplanned_words(study));
  }
  const std::unique_ptr<const core::ForceMap> map = force_map_of(study.device);
  PlannedAnalysis planned{.sizes = request.sizes,
                          .free_pse = request.free_pse,
                          .hierarchical = request.hierarchical};
  std::vector<std::string> left_out = left_out_of(study);
  planned.contrasts = contrasts_of(study, blocks, left_out);
  planned.sequential = sequential_of(study, planned.contrasts, left_out);
  // Planned contrasts take precedence over two blocks that nobody asked to compare.
  if (request.compare || planned.contrasts.empty()) {
    planned.compared = compared_places(blocks, request);
  }
  if (planned.compared) {
    const auto& [a, b] = *planned.compared;
    planned.paired = somebody_gets_both(study, blocks[a]->name, blocks[b]->name);
    if (request.null_hypothesis) {
      laboratory_ =
          null_laboratory(laboratory, block_of(*blocks[a]), block_of(*blocks[b]), map.get());
    }
  } else if (request.null_hypothesis && !planned.contrasts.empty()) {
    laboratory_.device.mechanical_viscosity_n_s_per_m = 0.0;
    laboratory_.effects.clear();
  } else if (request.null_hypothesis) {
    throw UsageError("--null: expected a study with two blocks to compare, found none in " +
                     study.name);
  }
  for (const Stage* stage : blocks) {
    PlannedBlock one{.name = stage->name, .quantity = quantity_of(block_of(*stage))};
    if (one.quantity == PlannedQuantity::kWeberFraction) {
      one.reference = block_of(*stage).reference_intensity.value_or(0.0);
      one.either_interval =
          experiments::task_of(block_of(*stage)) == experiments::Task::kTwoInterval;
      one.true_value =
          median_curve_fraction(laboratory_, experiments::block_of(*stage, 0, {}), map.get());
    } else {
      one.true_value = value_of_everybody(study, laboratory_, one);
    }
    planned.blocks.push_back(std::move(one));
  }
  design_ = {.study = study.name,
             .study_sha256 = core::sha256(study.text),
             .laboratory = laboratory.name,
             .laboratory_sha256 = core::sha256(laboratory.text),
             .program_version = JND_VERSION,
             .request = request,
             .analysis = std::move(planned),
             .durations = durations_of(study, laboratory, request),
             .left_out = std::move(left_out)};
  if (design_.analysis.compared) {
    const auto& [a, b] = *design_.analysis.compared;
    design_.request.compare = {blocks[a]->name, blocks[b]->name};
  }
}

std::vector<analysis::PlannedRun> PowerStudy::run(const Work& work) const {
  const AnswerSimulator simulator(study_, laboratory_);
  const int num_people = design_.analysis.num_people();
  const std::vector<std::string> names = next_participants(std::set<std::string>{}, num_people);
  std::map<std::string, std::vector<StageInstance>> stages;
  for (const Cell& cell : cells_of(study_)) stages[to_string(cell)] = stages_of(study_, cell);
  const std::vector<std::int64_t> runs = work.shard.runs_of(design_.request.num_runs);
  std::vector<analysis::PlannedRun> outcomes(runs.size());
  std::atomic<std::size_t> num_done{0};
  core::for_each_index(runs.size(), work.jobs, [&](std::size_t i) {
    if (work.is_cancelled && work.is_cancelled()) {
      throw core::Error("power: stopped before all runs were done; nothing was kept");
    }
    const std::uint64_t seed = run_seed(design_.request.seed, runs[i]);
    const std::vector<Cell> cells = planned_cells(study_, {}, seed, 0, num_people);
    std::vector<PlannedPerson> people;
    std::vector<Levels> levels;
    for (std::size_t person = 0; person < cells.size(); ++person) {
      levels.push_back(people_levels(cells[person]));
      people.push_back(person_of(
          design_.analysis, simulator.answers(stages.at(to_string(cells[person])),
                                              session_seed(seed, study_.name, names[person]))));
    }
    outcomes[i] = analysis::analyse_run(design_.analysis, people, levels);
    if (work.on_progress) {
      work.on_progress(static_cast<double>(++num_done) / static_cast<double>(runs.size()));
    }
  });
  return outcomes;
}

}  // namespace jnd::app
