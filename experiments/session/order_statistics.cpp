#include "experiments/session/order_statistics.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

using Counts = std::vector<std::vector<int>>;

/// Returns the range of the counts on the diagonal, or of all others.
CountRange range_of(const Counts& counts, bool (*is_counted)(std::size_t, std::size_t)) {
  std::optional<CountRange> range;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (std::size_t j = 0; j < counts[i].size(); ++j) {
      if (!is_counted(i, j)) continue;
      const int count = counts[i][j];
      if (!range) range = {count, count};
      range = {std::min(range->fewest, count), std::max(range->most, count)};
    }
  }
  return range.value_or(CountRange{});
}

/// A matching has standards as stimuli, not the starting values of the adjustment.
bool is_match(const PlannedTrial& trial) {
  return trial.starting_intensity && trial.reference_intensity;
}

OrderStatistics nothing_counted(const PlannedBlock& planned) {
  const auto& block = std::get<Block>(planned.stage->content);
  OrderStatistics statistics{
      .block = planned.stage->name, .quantity = block.quantity, .stimuli = block.intensities};
  if (!planned.trials.empty() && is_match(planned.trials.front())) {
    statistics.quantity = quantity_of(block.standard_medium);
    statistics.stimuli = block.standards;
  }
  std::sort(statistics.stimuli.begin(), statistics.stimuli.end());
  const std::size_t n = statistics.stimuli.size();
  statistics.at_place.assign(n, std::vector<int>(n));
  statistics.followed_by = statistics.at_place;
  return statistics;
}

/// Returns the index of the trial's stimulus, or none for a trial without one.
std::optional<std::size_t> stimulus_of(const OrderStatistics& statistics,
                                       const PlannedTrial& trial) {
  const std::optional<double> value = trial.intensity   ? trial.intensity
                                      : is_match(trial) ? trial.reference_intensity
                                                        : trial.starting_intensity;
  const auto& stimuli = statistics.stimuli;
  const auto found = std::find(stimuli.begin(), stimuli.end(), value);
  if (!value || found == stimuli.end()) return std::nullopt;
  return static_cast<std::size_t>(found - stimuli.begin());
}

void count(const PlannedBlock& planned, OrderStatistics& statistics) {
  std::optional<std::size_t> last;
  for (const PlannedTrial& trial : planned.trials) {
    const std::optional<std::size_t> stimulus = stimulus_of(statistics, trial);
    if (stimulus) {
      std::vector<int>& places = statistics.at_place[*stimulus];
      const auto place = static_cast<std::size_t>(trial.position);
      if (places.size() < place) {
        for (std::vector<int>& row : statistics.at_place) row.resize(place);
      }
      ++statistics.at_place[*stimulus][place - 1];
      if (last) ++statistics.followed_by[*last][*stimulus];
    }
    last = stimulus;
  }
}

}  // namespace

CountRange places_range(const OrderStatistics& statistics) {
  return range_of(statistics.at_place, [](std::size_t, std::size_t) { return true; });
}

CountRange followers_range(const OrderStatistics& statistics) {
  return range_of(statistics.followed_by, [](std::size_t i, std::size_t j) { return i != j; });
}

CountRange repeats_range(const OrderStatistics& statistics) {
  return range_of(statistics.followed_by, [](std::size_t i, std::size_t j) { return i == j; });
}

std::vector<OrderStatistics> order_statistics(const std::vector<ParticipantPlan>& plans) {
  std::vector<OrderStatistics> all;
  for (const ParticipantPlan& plan : plans) {
    for (const PlannedBlock& planned : plan.blocks) {
      if (static_cast<int>(planned.trials.size()) != planned.num_trials) continue;
      auto its = std::find_if(all.begin(), all.end(), [&](const OrderStatistics& one) {
        return one.block == planned.stage->name;
      });
      if (its == all.end()) its = all.insert(all.end(), nothing_counted(planned));
      count(planned, *its);
    }
  }
  return all;
}

}  // namespace jnd::experiments
