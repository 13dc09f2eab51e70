#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/sequential_test.h"

namespace jnd::analysis {

/// The looks of the study file as simulated studies are analysed for them.
struct PlannedSequential {
  std::string contrast;  ///< The one that decides.
  SequentialBoundaries boundaries;
};

/// How a simulated study ended by its looks.
struct SequentialRun {
  std::size_t look = 0;      ///< That ended it, from 0.
  bool significant = false;  ///< With the boundary crossed.
  /// Whether the same test without looks would have found something, with as many people as at
  /// the first look, one more, and so on to those of the last.
  std::vector<bool> fixed_significant;
};
/// `people`: as many as the last look asks for, in the order in which they come.
[[nodiscard]] SequentialRun sequential_run(
    const PlannedSequential& planned, const std::vector<std::optional<PersonScore>>& people,
    std::size_t num_groups);

/// Over all runs.
struct SequentialPower {
  std::int64_t num_runs = 0;
  std::vector<std::int64_t> num_ended;        ///< By look: that ended there.
  std::vector<std::int64_t> num_significant;  ///< By look: of these, with the boundary crossed.
  double power = 0.0;                         ///< Share of runs that crossed any.
  double power_low = 0.0, power_high = 1.0;   ///< 95 %, Wilson: how well so many runs tell it.
  double mean_participants = 0.0;             ///< Expected size of the sample.
  double standard_error = 0.0;                ///< Of that mean, over the runs.
  double fixed_power = 0.0;                   ///< Without looks, with all people.
  /// The fewest people, from the first look's number on, with whom a study without looks has at
  /// least that power; none where not even all of them are enough.
  std::optional<int> fixed_participants;
};
/// None where no looks are planned. Throws `core::Error` without runs.
[[nodiscard]] std::optional<SequentialPower> sequential_power(
    const std::optional<PlannedSequential>& planned, const std::vector<SequentialRun>& runs);

/// Where nothing differs: a sentence if the rule finds a difference more often than alpha, and
/// the runs are enough to tell; "" otherwise.
[[nodiscard]] std::string sequential_doubt(const PlannedSequential& planned,
                                           const SequentialPower& power);

}  // namespace jnd::analysis
