#include "analysis/results/trial_correlations.h"

#include <algorithm>

#include "analysis/data/magnitude_means.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// One participant's answers in one repetition, by intensity.
Means repetition_curve(const std::vector<core::TrialRow>& trials, std::int64_t repetition) {
  Means curve;
  for (const core::TrialRow& trial : trials) {
    if (trial.repetition == repetition && trial.intensity && trial.response) {
      curve[*trial.intensity] = *trial.response;
    }
  }
  return curve;
}

/// The correlation over the intensities that both repetitions have.
Comparison correlation_of(const Means& first, const Means& second) {
  std::vector<double> a;
  std::vector<double> b;
  for (const auto& [intensity, response] : first) {
    const auto other = second.find(intensity);
    if (other == second.end()) continue;
    a.push_back(response);
    b.push_back(other->second);
  }
  return pearson_correlation(a, b);
}

std::int64_t num_repetitions(const std::vector<std::vector<core::TrialRow>>& trials) {
  std::int64_t largest = 0;
  for (const std::vector<core::TrialRow>& own : trials) {
    for (const core::TrialRow& trial : own) largest = std::max(largest, trial.repetition);
  }
  return largest;
}

std::string name_of(std::int64_t first, std::int64_t second) {
  return "trial_correlation.t" + std::to_string(first) + "_t" + std::to_string(second);
}

/// Adds the median of the correlations of all pairs and participants.
void add_median(ResultsSection& section, const std::vector<std::vector<double>>& by_participant,
                const ResultsOptions& options) {
  const auto median = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    std::vector<double> all;
    for (const std::size_t i : drawn) {
      all.insert(all.end(), by_participant[i].begin(), by_participant[i].end());
    }
    if (all.empty()) return std::nullopt;
    return summary_of(all).median;
  };
  Estimate estimate{.name = "trial_correlation_median",
                    .value = median(everyone(by_participant.size())),
                    .unit = "1",
                    .meaning = said("median of the correlations of all participants and pairs"),
                    .n = static_cast<int>(by_participant.size())};
  if (!estimate.value) return;
  estimate.ci95 =
      resample_participants(by_participant.size(), options.num_resamples, options.seed, median)
          .ci95;
  section.estimates.push_back(std::move(estimate));
}

}  // namespace

void add_trial_correlations(ResultsSection& section, const StudyData& data,
                            const BlockDesign& block, const ResultsOptions& options) {
  std::vector<std::vector<core::TrialRow>> trials;
  for (const ParticipantData& participant : data.participants) {
    trials.push_back(participant.trials_in(block.block));
  }
  std::vector<std::vector<double>> by_participant(trials.size());
  const std::int64_t num = num_repetitions(trials);
  for (std::int64_t first = 1; first <= num; ++first) {
    for (std::int64_t second = first + 1; second <= num; ++second) {
      const std::string name = name_of(first, second);
      std::vector<double> correlations;
      for (std::size_t i = 0; i < trials.size(); ++i) {
        if (trials[i].empty()) continue;
        const Comparison own = correlation_of(repetition_curve(trials[i], first),
                                              repetition_curve(trials[i], second));
        section.participants.push_back({data.participants[i].participant, name, own.estimate,
                                        own.ci95, own.estimate ? "" : own.reason});
        if (!own.estimate) continue;
        correlations.push_back(*own.estimate);
        by_participant[i].push_back(*own.estimate);
      }
      const Summary summary = summary_of(correlations);
      section.estimates.push_back(
          {.name = name,
           .value = summary.mean,
           // The interval is over resampled participants, because Student's t would leave
           // [-1, 1].
           .ci95 = resampled(correlations, options,
                             [](const Summary& sample) { return sample.mean; }),
           .unit = "1",
           .meaning = said("correlation of two repetitions, mean of the participants"),
           .n = summary.num_values});
    }
  }
  add_median(section, by_participant, options);
}

std::map<std::string, double> own_trial_correlations(
    const std::vector<core::TrialRow>& trials) {
  std::map<std::string, double> correlations;
  const std::int64_t num = num_repetitions({trials});
  for (std::int64_t first = 1; first <= num; ++first) {
    for (std::int64_t second = first + 1; second <= num; ++second) {
      const Comparison own =
          correlation_of(repetition_curve(trials, first), repetition_curve(trials, second));
      if (own.estimate) correlations[name_of(first, second)] = *own.estimate;
    }
  }
  return correlations;
}

}  // namespace jnd::analysis
