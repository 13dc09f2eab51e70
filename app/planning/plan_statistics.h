#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/participants/laboratory.h"
#include "experiments/session/order_statistics.h"
#include "experiments/session/plan.h"

namespace jnd::app {

/// Mean and spread over the participants of a plan.
struct Spread {
  /// The standard deviation of a single participant is 0.
  double mean = 0.0, standard_deviation = 0.0;
  double least = 0.0, most = 0.0;
};
[[nodiscard]] Spread spread_of(const std::vector<double>& values);

/// How long a trial of a block takes.
struct TrialLength {
  double expected_s = 0.0;  ///< `expected_trial_s` of the study.
  /// The time that simulated participants feel something, as the mean of their trials.
  Spread felt_s;
  /// True if they feel longer than the study expects a trial to take.
  [[nodiscard]] bool is_underrated() const noexcept { return felt_s.mean > expected_s; }
};

/// How often an adaptive block reaches the ends of its levels. A participant who is often there
/// has a threshold beyond.
struct LevelEnds {
  /// The shares of all trials that are at the lowest and at the highest level.
  double lowest_ratio = 0.0, highest_ratio = 0.0;
};

/// The numbers of a plan over all of its participants.
struct PlanStatistics {
  std::vector<experiments::OrderStatistics> orders;
  /// The answers decide how many trials some block has.
  bool adapts = false;
  /// Why no participants were simulated to find out how long blocks take, so that all durations
  /// are as expected; "" if they were.
  std::string not_simulated;
  std::vector<double> durations_s;              ///< The simulated duration of each participant.
  std::map<std::string, Spread> num_trials;     ///< Of each adaptive block, by its name.
  std::map<std::string, LevelEnds> level_ends;  ///< Of each adaptive block, by its name.
  std::map<std::string, TrialLength> trial_lengths;  ///< Of each block, by its name.
};

/// `seed` is the study's seed. Not real time.
[[nodiscard]] PlanStatistics plan_statistics(
    const experiments::Study& study, const std::vector<experiments::ParticipantPlan>& plans,
    const experiments::Laboratory& laboratory, std::uint64_t seed);

/// Adds the keys `order_statistics` and `durations`.
void add_to_json(const PlanStatistics& statistics, nlohmann::ordered_json& json);
/// Prints a line for each block, and one about durations.
void print(const PlanStatistics& statistics);

}  // namespace jnd::app
