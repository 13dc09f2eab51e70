#include "analysis/results/study_results.h"

#include <algorithm>
#include <iterator>

#include "analysis/results/catch_results.h"
#include "analysis/results/exploratory_results.h"
#include "analysis/results/inverted_answers.h"
#include "analysis/results/missing_values.h"
#include "analysis/results/primary_results.h"
#include "analysis/results/published_comparison.h"
#include "analysis/results/study_sections.h"
#include "analysis/results/test_families.h"
#include "analysis/results/threshold_results.h"
#include "analysis/results/trial_losses.h"
#include "analysis/results/unanswered_results.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

std::vector<BlockDesign> blocks_that(bool (BlockDesign::*measure)() const,
                                     const StudyData& data) {
  std::vector<BlockDesign> found;
  std::ranges::copy_if(data.blocks, std::back_inserter(found), measure);
  return found;
}

/// Adds the sections of a block that are not about a psychometric function over comparisons.
void add_threshold_sections(std::vector<ResultsSection>& sections, const StudyData& data,
                            const BlockDesign& block, const ResultsOptions& options) {
  if (block.detects()) sections.push_back(detection_results(data, block, options));
  if (block.tells_apart()) sections.push_back(same_different_results(data, block));
  if (block.identifies()) sections.push_back(identification_results(data, block));
  if (block.is_adaptive()) sections.push_back(adaptive_results(data, block));
  if (block.compares() && has_intervals(data, block)) {
    sections.push_back(interval_results(data, block));
  }
  // In three equal intervals no choice is a false alarm. The choices are reported anyway.
  if (!block.identifies() && has_catch_trials(data, block))
    sections.push_back(catch_results(data, block));
}

/// Whether the laboratory's list names the estimate. If two studies share the name, the list
/// has the study before a slash.
bool is_named(const std::vector<std::string>& list, const StudyData& data,
              const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end() ||
         std::find(list.begin(), list.end(), data.study + "/" + name) != list.end();
}

/// Adds a section for each block whose answers were all set aside. It has no numbers but says
/// why.
void add_blocks_set_aside(std::vector<ResultsSection>& sections, const StudyData& data) {
  for (const BlockDesign& block : data.blocks) {
    int num_standing = 0, num_set_aside = 0;
    for (const ParticipantData& participant : data.participants) {
      const auto in_block = [&](const core::TrialRow& trial) {
        return trial.block == block.block;
      };
      num_standing += static_cast<int>(std::ranges::count_if(participant.trials, in_block));
      num_set_aside +=
          static_cast<int>(std::ranges::count_if(participant.excluded_trials, in_block));
    }
    if (num_standing > 0 || num_set_aside == 0) continue;
    const auto found = std::ranges::find(sections, block.block, &ResultsSection::name);
    ResultsSection& section = found == sections.end()
                                  ? sections.emplace_back(ResultsSection{.name = block.block})
                                  : *found;
    section.excluded.push_back(
        {"everyone",
         said("every answer in {} is set aside by `jnd exclude`, so that there is no value",
              block.block)});
  }
}

/// The number of people, without those whose answers were all set aside.
int num_heard(const StudyData& data) {
  return static_cast<int>(std::ranges::count_if(data.participants, [](const auto& participant) {
    return !participant.trials.empty() || participant.excluded_trials.empty();
  }));
}

}  // namespace

const Estimate* StudyResults::find(const std::string& name) const {
  for (const ResultsSection& section : sections) {
    for (const Estimate& estimate : section.estimates) {
      if (estimate.name == name) return &estimate;
    }
  }
  return nullptr;
}

StudyResults results_of(const StudyData& data, const Published& published,
                        const ResultsOptions& options) {
  StudyResults results{.study = data.study,
                       .simulated = data.simulated,
                       .laboratory = data.laboratory,
                       .citation = published.citation,
                       .num_participants = num_heard(data),
                       .sessions = data.sessions,
                       .losses = level_losses(data),
                       .contrasts = planned_contrasts(data)};
  const std::vector<BlockDesign> estimations = blocks_that(&BlockDesign::estimates, data);
  const std::vector<BlockDesign> productions = blocks_that(&BlockDesign::produces, data);
  const std::vector<BlockDesign> discriminations = comparing_blocks(data);
  for (const BlockDesign& block : estimations) {
    results.sections.push_back(estimation_results(data, block, options));
  }
  for (const BlockDesign& block : productions) {
    results.sections.push_back(production_results(data, block, options));
  }
  for (const BlockDesign& block : blocks_that(&BlockDesign::matches, data)) {
    results.sections.push_back(matching_results(data, block, options));
  }
  for (const BlockDesign& block : blocks_that(&BlockDesign::rates, data)) {
    results.sections.push_back(rating_results(data, block));
  }
  if (estimations.size() == 1 && productions.size() == 1 &&
      estimations[0].quantity == productions[0].quantity && estimations[0].counts_in_water()) {
    results.sections.push_back(combined_results(data, estimations[0], productions[0], options));
  }
  // The fits of groups and of all participants take nearly all of the time.
  const std::vector<ComparedBlocks> pairs = compared_blocks(discriminations, options.compared);
  const auto num_parts = static_cast<double>(2 * discriminations.size() + pairs.size() + 1);
  double num_done = 0.0;
  for (const BlockDesign& block : discriminations) {
    ResultsOptions of_block = options;
    of_block.on_progress =
        core::part_of(options.on_progress, num_done / num_parts, (num_done + 2.0) / num_parts);
    results.sections.push_back(discrimination_results(data, block, of_block));
    num_done += 2.0;
  }
  for (const BlockDesign& block : data.blocks) {
    add_threshold_sections(results.sections, data, block, options);
  }
  for (const BlockDesign& block : data.blocks) {
    if (block.written.questions.empty()) continue;
    results.sections.push_back(question_results(data, block));
  }
  add_blocks_set_aside(results.sections, data);
  for (const ComparedBlocks& pair : pairs) {
    results.sections.push_back(discrimination_comparison(data, pair));
    core::tell(options.on_progress, ++num_done, num_parts);
  }
  results.sections.push_back(movement_results(data));
  if (ResultsSection exploratory = exploratory_results(data, results.sections);
      !exploratory.estimates.empty() || !exploratory.comparisons.empty()) {
    results.sections.push_back(std::move(exploratory));
  }
  for (const auto section_of : kStudySections) {
    if (auto section = section_of(data)) results.sections.push_back(std::move(*section));
  }

  caution_of_inverted(results, data);
  caution_of_unanswered(results, data);
  explain_missing(results);
  mark_primary(results, data);
  add_without_affected(results, data, options);
  mark_movement_family(results.sections);
  if (data.written.contrasts.empty()) {
    mark_pairs_family(results.sections, !options.compared.empty());
  } else {
    mark_pairs_beside_plan(results.sections);
  }
  adjust_by_family(results.sections);
  add_published(results, data, published, options);
  for (ResultsSection& section : results.sections) {
    for (Estimate& estimate : section.estimates) {
      estimate.calibrated = data.simulated && is_named(data.calibrated_on, data, estimate.name);
      estimate.implied = data.simulated && is_named(data.implied, data, estimate.name);
    }
  }
  return results;
}

}  // namespace jnd::analysis
