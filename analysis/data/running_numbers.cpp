#include "analysis/data/running_numbers.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace jnd::analysis {

std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> running_numbers(
    const ParticipantData& participant, const std::string& block) {
  std::vector<const core::TrialRow*> by_time;
  for (const auto* trials :
       {&participant.trials, &participant.excluded_trials, &participant.catch_trials}) {
    for (const core::TrialRow& trial : *trials) {
      if (trial.block == block) by_time.push_back(&trial);
    }
  }
  std::vector<const core::TrialRow*> by_number = by_time;
  std::ranges::sort(by_time, {}, [](const core::TrialRow* trial) {
    return std::tuple(trial->session, trial->first_tick, trial->trial);
  });
  std::ranges::sort(by_number, {}, [](const core::TrialRow* trial) {
    return std::pair(trial->session, trial->trial);
  });
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> numbers;
  for (std::size_t i = 0; i < by_time.size(); ++i) {
    numbers[{by_time[i]->session, by_time[i]->trial}] = by_number[i]->trial;
  }
  return numbers;
}

}  // namespace jnd::analysis
