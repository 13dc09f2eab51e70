#include "analysis/data/magnitude_means.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace jnd::analysis {
namespace {

MagnitudeAnswers answers_by(const std::vector<core::TrialRow>& trials,
                            std::optional<double> core::TrialRow::*x, double response_unit) {
  MagnitudeAnswers answers;
  for (const core::TrialRow& trial : trials) {
    if (!(trial.*x) || !trial.response) continue;
    answers[*(trial.*x)].push_back(*trial.response * response_unit);
  }
  return answers;
}

MagnitudeBlock block_of(const StudyData& data, const BlockDesign& block,
                        std::optional<double> core::TrialRow::*x, double response_unit) {
  MagnitudeBlock result;
  for (const ParticipantData& participant : data.participants) {
    MagnitudeAnswers answers = answers_by(participant.trials_in(block.block), x, response_unit);
    if (answers.empty()) {
      name_without_answers(result.excluded, participant, block.block);
      continue;
    }
    const LogAnswers logs = log_answers(answers, ZeroRule::kHalfSmallest);
    result.num_zeros += logs.num_zeros;
    result.names.push_back(participant.participant);
    result.means.push_back(means_of(answers));
    result.log_means.push_back(means_of(logs.logs));
    result.log_means_without_zeros.push_back(
        means_of(log_answers(answers, ZeroRule::kLeaveOut).logs));
    result.answers.push_back(std::move(answers));
  }
  return result;
}

/// Half the smallest answer above 0; absent if there is none.
std::optional<double> half_smallest(const MagnitudeAnswers& answers) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [x, values] : answers) {
    for (const double value : values) {
      if (value > 0.0) smallest = std::min(smallest, value);
    }
  }
  return std::isfinite(smallest) ? std::optional(0.5 * smallest) : std::nullopt;
}

/// The participants of `block` at the given indices.
MagnitudeBlock kept(const MagnitudeBlock& block, const std::vector<std::size_t>& places) {
  MagnitudeBlock result{.excluded = block.excluded};
  for (const std::size_t place : places) {
    result.names.push_back(block.names[place]);
    result.answers.push_back(block.answers[place]);
    result.means.push_back(block.means[place]);
    result.log_means.push_back(block.log_means[place]);
    result.log_means_without_zeros.push_back(block.log_means_without_zeros[place]);
    result.num_zeros += log_answers(block.answers[place], ZeroRule::kHalfSmallest).num_zeros;
  }
  return result;
}

}  // namespace

LogAnswers log_answers(const MagnitudeAnswers& answers, ZeroRule rule) {
  LogAnswers result;
  const std::optional<double> stand_in =
      rule == ZeroRule::kHalfSmallest ? half_smallest(answers) : std::nullopt;
  for (const auto& [x, values] : answers) {
    if (!(x > 0.0)) continue;
    std::vector<double> logs;
    for (const double value : values) {
      if (!(value > 0.0)) ++result.num_zeros;
      if (value > 0.0) {
        logs.push_back(std::log(value));
      } else if (stand_in) {
        logs.push_back(std::log(*stand_in));
      }
    }
    if (!logs.empty()) result.logs[x] = std::move(logs);
  }
  return result;
}

Means means_of(const MagnitudeAnswers& answers) {
  Means means;
  for (const auto& [x, values] : answers) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    means[x] = sum / static_cast<double>(values.size());
  }
  return means;
}

MagnitudeBlock estimation_block(const StudyData& data, const BlockDesign& block) {
  constexpr double kRatioPerPercent = 0.01;
  return block_of(data, block, &core::TrialRow::intensity, kRatioPerPercent);
}

MagnitudeBlock production_block(const StudyData& data, const BlockDesign& block) {
  return block_of(data, block, &core::TrialRow::target_percent, 1.0);
}

void keep_common(MagnitudeBlock& first, MagnitudeBlock& second) {
  std::vector<std::size_t> places_in_first, places_in_second;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto same = std::find(second.names.begin(), second.names.end(), first.names[i]);
    if (same == second.names.end()) continue;
    places_in_first.push_back(i);
    places_in_second.push_back(static_cast<std::size_t>(same - second.names.begin()));
  }
  first = kept(first, places_in_first);
  second = kept(second, places_in_second);
}

std::vector<Means> with_mean_above_zero(const std::vector<Means>& participants) {
  std::vector<Means> found;
  std::ranges::copy_if(participants, std::back_inserter(found), [](const Means& own) {
    return !own.empty() && own.rbegin()->first > 0.0;
  });
  return found;
}

Means group_means(const std::vector<Means>& participants,
                  const std::vector<std::size_t>& drawn) {
  std::map<double, std::pair<double, int>> sums;
  for (const std::size_t index : drawn) {
    for (const auto& [x, mean] : participants[index]) {
      sums[x].first += mean;
      ++sums[x].second;
    }
  }
  Means means;
  for (const auto& [x, sum] : sums) means[x] = sum.first / sum.second;
  return means;
}

std::vector<std::size_t> everyone(std::size_t num_participants) {
  std::vector<std::size_t> all(num_participants);
  for (std::size_t i = 0; i < num_participants; ++i) all[i] = i;
  return all;
}

std::optional<std::vector<double>> log_moduli(const MagnitudeBlock& block) {
  std::map<double, std::size_t> num_with;
  for (const Means& own : block.log_means) {
    for (const auto& [x, mean] : own) ++num_with[x];
  }
  std::erase_if(num_with, [&](const auto& one) { return one.second < block.size(); });
  if (num_with.empty()) return std::nullopt;
  std::vector<double> moduli;
  for (const Means& own : block.log_means) {
    double sum = 0.0;
    for (const auto& [x, num] : num_with) sum += own.at(x);
    moduli.push_back(sum / static_cast<double>(num_with.size()));
  }
  return moduli;
}

Means equalised_means(const std::vector<Means>& participants,
                      const std::vector<double>& own_log_moduli,
                      const std::vector<std::size_t>& drawn) {
  double common = 0.0;
  for (const std::size_t index : drawn) common += own_log_moduli[index];
  common /= static_cast<double>(drawn.size());
  std::map<double, std::pair<double, int>> sums;
  for (const std::size_t index : drawn) {
    const double factor = std::exp(common - own_log_moduli[index]);
    for (const auto& [x, mean] : participants[index]) {
      sums[x].first += factor * mean;
      ++sums[x].second;
    }
  }
  Means means;
  for (const auto& [x, sum] : sums) means[x] = sum.first / sum.second;
  return means;
}

}  // namespace jnd::analysis
