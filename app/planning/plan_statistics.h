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
  double mean = 0.0, standard_deviation = 0.0;  ///< The latter 0 of a single participant.
  double least = 0.0, most = 0.0;
};
[[nodiscard]] Spread spread_of(const std::vector<double>& values);

/// How long a trial of a block takes.
struct TrialLength {
  double expected_s = 0.0;  ///< `expected_trial_s` of the study.
  Spread felt_s;            ///< By simulated participants, of each the mean of their trials.
  /// They feel longer than the study expects a trial to take.
  [[nodiscard]] bool is_underrated() const noexcept { return felt_s.mean > expected_s; }
};

/// Where the levels of an adaptive block end: who is there often has a threshold beyond.
struct LevelEnds {
  double lowest_ratio = 0.0,
         highest_ratio = 0.0;  ///< Shares of all trials that lie at either end.
};

/// What a plan comes to over all of its participants.
struct PlanStatistics {
  std::vector<experiments::OrderStatistics> orders;
  bool adapts = false;  ///< Some block's number of trials depends on the answers.
  /// Why there are no simulated participants to tell how long blocks take, so that all is as
  /// expected; "" where there are.
  std::string not_simulated;
  std::vector<double> durations_s;                   ///< Of each participant, simulated.
  std::map<std::string, Spread> num_trials;          ///< Of each adaptive block, by its name.
  std::map<std::string, LevelEnds> level_ends;       ///< Of each adaptive block, by its name.
  std::map<std::string, TrialLength> trial_lengths;  ///< Of each block.
};

/// `seed`: of the study. Not real time.
[[nodiscard]] PlanStatistics plan_statistics(
    const experiments::Study& study, const std::vector<experiments::ParticipantPlan>& plans,
    const experiments::Laboratory& laboratory, std::uint64_t seed);

/// Keys `order_statistics` and `durations`.
void add_to_json(const PlanStatistics& statistics, nlohmann::ordered_json& json);
/// A line for each block, and one of durations.
void print(const PlanStatistics& statistics);

}  // namespace jnd::app
