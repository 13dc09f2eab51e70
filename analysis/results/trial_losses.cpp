#include "analysis/results/trial_losses.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "analysis/results/discrimination_group.h"
#include "analysis/results/number_words.h"
#include "analysis/results/threshold_results.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// With more levels, a block's levels are set or follow from answers, and were not designed.
constexpr std::size_t kMostLevels = 32;

void add(LevelLoss& loss, const TrialRecord& record) {
  ++loss.num_drawn;
  loss.num_answered += record.is_answered ? 1 : 0;
  loss.num_set_aside += record.is_set_aside ? 1 : 0;
  loss.num_repeated += record.is_repeated() ? 1 : 0;
  loss.num_discarded += record.num_discarded > 0 ? 1 : 0;
  loss.num_faulted += record.is_faulted ? 1 : 0;
  loss.num_limited += record.is_limited ? 1 : 0;
  loss.num_strokeless += record.is_strokeless ? 1 : 0;
  loss.num_affected += record.is_affected() ? 1 : 0;
}

/// The affected trials with a valid answer.
std::set<std::pair<std::int64_t, std::int64_t>> affected_trials(
    const ParticipantData& participant, const std::set<std::string>& blocks) {
  std::set<std::pair<std::int64_t, std::int64_t>> trials;
  for (const TrialRecord& record : participant.records) {
    if (blocks.contains(record.block) && record.is_affected()) {
      trials.insert({record.session, record.trial});
    }
  }
  return trials;
}

/// The section with the block's primary values, as far as they depend on its answers alone.
ResultsSection section_of(const StudyData& data, const BlockDesign& block,
                          const ResultsOptions& options) {
  if (block.estimates()) return estimation_results(data, block, options);
  if (block.produces()) return production_results(data, block, options);
  if (block.matches()) return matching_results(data, block, options);
  if (block.rates()) return rating_results(data, block);
  ResultsSection section;
  if (block.compares()) {
    add_primary_estimate(section, data, block, options);
    return section;
  }
  if (block.identifies()) return identification_results(data, block);
  if (block.detects()) return detection_results(data, block, options);
  return block.tells_apart() ? same_different_results(data, block) : section;
}

/// For example "5.3 % of the answers come from trials that were repeated, faulted, ...".
std::string affected_words(double ratio) {
  return said(
      "{} % of the answers come from trials that were repeated, faulted, limited in force or "
      "without a whole stroke",
      number_words(100.0 * ratio, 1));
}

bool is_outside(double value, const Interval& ci95) {
  return (ci95.low && value < *ci95.low) || (ci95.high && value > *ci95.high);
}

/// Adds the primary values of `section` without the affected trials.
void compare(ResultsSection& section, const std::string& prefix, const ResultsSection& without,
             double ratio) {
  constexpr char kSuffix[] = ".without_affected_trials";
  std::vector<Estimate> added;
  for (Estimate& estimate : section.estimates) {
    if (!estimate.primary || !estimate.name.starts_with(prefix + ".")) continue;
    const auto found = std::ranges::find(without.estimates, estimate.name, &Estimate::name);
    Estimate other{.name = estimate.name + kSuffix,
                   .unit = estimate.unit,
                   .meaning = said("the same without them: {}", affected_words(ratio))};
    if (found == without.estimates.end()) {
      other.reason = said(
          "its rule saw these trials, and which came next followed from them, so that it has "
          "nothing to say without them");
    } else {
      other.value = found->value;
      other.ci95 = found->ci95;
      other.n = found->n;
      other.reason = found->reason;
      if (!other.value && other.reason.empty()) other.reason = said("too few answers are left");
      if (other.value && is_outside(*other.value, estimate.ci95)) {
        estimate.cautions.push_back(said("{}; without them it is {}, outside of the interval",
                                         affected_words(ratio), number_words(other.value)));
      }
    }
    added.push_back(std::move(other));
  }
  section.estimates.insert(section.estimates.end(), added.begin(), added.end());
}

ResultsSection* section_named(StudyResults& results, const std::string& name) {
  const auto found = std::ranges::find(results.sections, name, &ResultsSection::name);
  return found == results.sections.end() ? nullptr : &*found;
}

}  // namespace

std::vector<LevelLoss> level_losses(const StudyData& data) {
  std::vector<LevelLoss> losses;
  for (const BlockDesign& block : data.blocks) {
    std::set<double> levels;
    for (const ParticipantData& participant : data.participants) {
      for (const TrialRecord& record : participant.records) {
        if (record.block == block.block && !record.is_catch && record.level) {
          levels.insert(*record.level);
        }
      }
    }
    const bool by_level = levels.size() <= kMostLevels;
    std::map<std::pair<bool, std::optional<double>>, LevelLoss> counts;
    for (const ParticipantData& participant : data.participants) {
      for (const TrialRecord& record : participant.records) {
        if (record.block != block.block) continue;
        const auto level =
            by_level && !record.is_catch ? record.level : std::optional<double>();
        LevelLoss& loss = counts[{record.is_catch, level}];
        loss.block = block.block;
        loss.is_catch = record.is_catch;
        loss.level = level;
        add(loss, record);
      }
    }
    for (auto& [key, loss] : counts) losses.push_back(std::move(loss));
  }
  return losses;
}

double affected_ratio(const StudyData& data, const std::string& block) {
  int num_answered = 0, num_affected = 0;
  for (const ParticipantData& participant : data.participants) {
    for (const TrialRecord& record : participant.records) {
      if (record.block != block) continue;
      num_answered += record.is_answered ? 1 : 0;
      num_affected += record.is_affected() ? 1 : 0;
    }
  }
  return num_answered == 0 ? 0.0 : static_cast<double>(num_affected) / num_answered;
}

StudyData without_affected(const StudyData& data, const std::set<std::string>& blocks) {
  StudyData left = data;
  for (ParticipantData& participant : left.participants) {
    const auto affected = affected_trials(participant, blocks);
    const auto is_affected = [&](const core::TrialRow& row) {
      return affected.contains({row.session, row.trial});
    };
    std::erase_if(participant.trials, is_affected);
    std::erase_if(participant.catch_trials, is_affected);
  }
  return left;
}

void add_without_affected(StudyResults& results, const StudyData& data,
                          const ResultsOptions& options) {
  std::map<std::string, double> ratios;
  std::set<std::string> blocks;
  for (const BlockDesign& block : data.blocks) {
    ratios[block.block] = affected_ratio(data, block.block);
    if (ratios[block.block] > kMostAffected) blocks.insert(block.block);
  }
  if (blocks.empty()) return;
  const StudyData left = without_affected(data, blocks);
  const BlockDesign* estimation = nullptr;
  const BlockDesign* production = nullptr;
  for (const BlockDesign& block : left.blocks) {
    if (block.estimates()) estimation = &block;
    if (block.produces()) production = &block;
    if (!blocks.contains(block.block)) continue;
    const ResultsSection without = section_of(left, block, options);
    for (ResultsSection& section : results.sections) {
      compare(section, block.block, without, ratios[block.block]);
    }
  }
  ResultsSection* const combined = section_named(results, "combined");
  if (combined == nullptr || estimation == nullptr || production == nullptr) return;
  const double ratio = std::max(ratios[estimation->block], ratios[production->block]);
  if (ratio <= kMostAffected) return;
  compare(*combined, "combined", combined_results(left, *estimation, *production, options),
          ratio);
}

}  // namespace jnd::analysis
