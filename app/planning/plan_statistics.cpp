#include "app/planning/plan_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "app/command_line/json_text.h"
#include "core/error.h"
#include "experiments/participants/simulated_duration.h"

namespace jnd::app {
namespace {

using namespace experiments;
using nlohmann::ordered_json;

bool adapts(const PlannedBlock& block) {
  return static_cast<int>(block.trials.size()) != block.num_trials ||
         std::get<Block>(block.stage->content).practice;
}

/// The decimals of seconds and of numbers of trials.
constexpr int kNumDecimals = 6;

ordered_json to_json(const Spread& spread) {
  return {{"mean", to_decimals(spread.mean, kNumDecimals)},
          {"standard_deviation", to_decimals(spread.standard_deviation, kNumDecimals)},
          {"least", to_decimals(spread.least, kNumDecimals)},
          {"most", to_decimals(spread.most, kNumDecimals)}};
}

ordered_json to_json(const OrderStatistics& orders) {
  return {{"block", orders.block},
          {"quantity", orders.quantity},
          {"stimuli", orders.stimuli},
          {"at_place", orders.at_place},
          {"followed_by", orders.followed_by}};
}

std::string times(const CountRange& range) {
  return range.fewest == range.most ? fmt::format("{} times", range.most)
                                    : fmt::format("{} to {} times", range.fewest, range.most);
}

/// Warns of an adaptive block if simulated people are often at the end of its levels.
void print_ends(const std::string& block, int width,
                const std::map<std::string, LevelEnds>& all) {
  constexpr double kOften = 1.0 / 3.0;
  const auto found = all.find(block);
  if (found == all.end()) return;
  const auto warn = [&](double ratio, const char* end, const char* beyond) {
    if (ratio <= kOften) return;
    fmt::print(
        "  {:<{}} {:.0f} % of its trials are at its {} level: thresholds of simulated "
        "participants lie {} it\n",
        block, width, 100.0 * ratio, end, beyond);
  };
  warn(found->second.lowest_ratio, "lowest", "below");
  warn(found->second.highest_ratio, "highest", "above");
}

}  // namespace

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  Spread spread;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  spread.least = *least;
  spread.most = *most;
  const auto n = static_cast<double>(values.size());
  spread.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() == 1) return spread;
  double sum = 0.0;
  for (const double value : values) sum += std::pow(value - spread.mean, 2.0);
  spread.standard_deviation = std::sqrt(sum / (n - 1.0));
  return spread;
}

PlanStatistics plan_statistics(const Study& study, const std::vector<ParticipantPlan>& plans,
                               const Laboratory& laboratory, std::uint64_t seed) {
  PlanStatistics statistics{.orders = order_statistics(plans)};
  std::map<std::string, std::vector<double>> num_trials;  // By the name of an adaptive block.
  std::map<std::string, std::vector<double>> felt_s;      // The time of a trial, by block.
  for (const ParticipantPlan& plan : plans) {
    for (const PlannedBlock& block : plan.blocks) {
      if (adapts(block)) num_trials.try_emplace(block.stage->name);
      statistics.trial_lengths[block.stage->name].expected_s =
          std::get<Block>(block.stage->content).expected_trial_s;
    }
    statistics.durations_s.push_back(plan.duration_s);
  }
  statistics.adapts = !num_trials.empty();
  try {
    const AnswerSimulator simulator(study, laboratory);
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const SimulatedDuration simulated = simulated_duration(plans[i], simulator, study, seed);
      statistics.durations_s[i] = simulated.duration_s;
      for (const auto& [block, done] : simulated.blocks) {
        if (done.num_trials > 0) felt_s[block].push_back(done.felt_s / done.num_trials);
        const auto adaptive = num_trials.find(block);
        if (adaptive == num_trials.end()) continue;
        adaptive->second.push_back(done.num_trials);
        LevelEnds& ends = statistics.level_ends[block];
        ends.lowest_ratio += done.num_at_lowest;
        ends.highest_ratio += done.num_at_highest;
      }
    }
  } catch (const core::Error& error) {
    statistics.not_simulated = error.what();
    return statistics;
  }
  for (const auto& [block, numbers] : num_trials) {
    statistics.num_trials[block] = spread_of(numbers);
    LevelEnds& ends = statistics.level_ends[block];
    const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
    if (sum == 0.0) continue;
    ends.lowest_ratio /= sum;
    ends.highest_ratio /= sum;
  }
  for (const auto& [block, lengths_s] : felt_s) {
    statistics.trial_lengths[block].felt_s = spread_of(lengths_s);
  }
  return statistics;
}

void add_to_json(const PlanStatistics& statistics, ordered_json& json) {
  json["order_statistics"] = ordered_json::array();
  for (const OrderStatistics& orders : statistics.orders) {
    json["order_statistics"].push_back(to_json(orders));
  }
  auto blocks = ordered_json::array();
  for (const auto& [block, spread] : statistics.num_trials) {
    ordered_json one = {{"block", block}};
    one["num_trials"] = to_json(spread);
    const LevelEnds& ends = statistics.level_ends.at(block);
    one["lowest_ratio"] = to_decimals(ends.lowest_ratio, kNumDecimals);
    one["highest_ratio"] = to_decimals(ends.highest_ratio, kNumDecimals);
    blocks.push_back(std::move(one));
  }
  auto trials = ordered_json::array();
  for (const auto& [block, length] : statistics.trial_lengths) {
    ordered_json one = {{"block", block}, {"expected_trial_s", length.expected_s}};
    if (statistics.not_simulated.empty()) one["felt_s"] = to_json(length.felt_s);
    trials.push_back(std::move(one));
  }
  std::vector<double> durations_s;
  for (const double duration_s : statistics.durations_s) {
    durations_s.push_back(to_decimals(duration_s, kNumDecimals));
  }
  json["durations"] = {{"duration_s", to_json(spread_of(statistics.durations_s))},
                       {"of_participants_s", durations_s},
                       {"simulated", statistics.not_simulated.empty()},
                       {"not_simulated", statistics.not_simulated},
                       {"adaptive_blocks", std::move(blocks)},
                       {"trials", std::move(trials)}};
}

void print(const PlanStatistics& statistics) {
  std::size_t longest = 24;
  for (const auto& [block, length] : statistics.trial_lengths) {
    longest = std::max(longest, block.size());
  }
  const auto width = static_cast<int>(longest);
  if (!statistics.orders.empty()) fmt::print("\nOrders over all participants\n");
  for (const OrderStatistics& orders : statistics.orders) {
    if (orders.stimuli.size() < 2) continue;
    fmt::print(
        "  {:<{}} each stimulus {} at each place, {} after each other one, {} after "
        "itself\n",
        orders.block, width, times(places_range(orders)), times(followers_range(orders)),
        times(repeats_range(orders)));
  }
  const Spread all = spread_of(statistics.durations_s);
  fmt::print("\nDuration: {:.0f} min on average, {:.0f} to {:.0f} min\n", all.mean / 60.0,
             all.least / 60.0, all.most / 60.0);
  for (const auto& [block, spread] : statistics.num_trials) {
    fmt::print(
        "  {:<{}} {:.1f} trials on average (standard deviation {:.1f}), {:g} to {:g}; "
        "by simulated participants\n",
        block, width, spread.mean, spread.standard_deviation, spread.least, spread.most);
    print_ends(block, width, statistics.level_ends);
  }
  for (const auto& [block, length] : statistics.trial_lengths) {
    if (!length.is_underrated()) continue;
    fmt::print(
        "  {:<{}} `expected_trial_s` is {:g} s, but simulated participants feel the stimuli of "
        "a trial for {:.0f} s on average; counted with those\n",
        block, width, length.expected_s, length.felt_s.mean);
  }
  if (!statistics.not_simulated.empty()) {
    fmt::print("  as expected, not simulated: {}\n", statistics.not_simulated);
  }
}

}  // namespace jnd::app
