#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/results/study_sections.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// The median time of a participant's answers in a block; absent without any.
std::optional<double> median_time_s(const ParticipantData& participant,
                                    const std::string& block) {
  std::vector<double> times_s;
  for (const core::TrialRow& trial : participant.trials_in(block)) {
    const std::optional<double>& time_s = trial.measures.response_time_s;
    if (time_s && *time_s > 0.0) times_s.push_back(*time_s);
  }
  return summary_of(times_s).median;
}

std::optional<double> back(const std::optional<double>& log) {
  return log ? std::optional(std::exp(*log)) : std::nullopt;
}

}  // namespace

std::optional<ResultsSection> response_time_results(const StudyData& data) {
  ResultsSection section{.name = "response_times"};
  for (const BlockDesign& block : data.blocks) {
    const std::string name = block.block + ".response_time_s";
    std::vector<double> logs;
    for (const ParticipantData& participant : data.participants) {
      const std::optional<double> time_s = median_time_s(participant, block.block);
      if (!time_s) continue;
      section.participants.push_back({participant.participant, name, time_s, {}, ""});
      logs.push_back(std::log(*time_s));
    }
    if (logs.empty()) continue;
    const Summary summary = summary_of(logs);
    section.estimates.push_back(
        {.name = name,
         .value = back(summary.mean),
         .ci95 = {back(summary.mean_ci95.low), back(summary.mean_ci95.high)},
         .unit = "s",
         .meaning = said("response time: geometric mean over the participants of each one's "
                         "median, from the start of the last stimulus to the answer"),
         .n = summary.num_values});
  }
  if (section.estimates.empty()) return std::nullopt;
  return section;
}

}  // namespace jnd::analysis
