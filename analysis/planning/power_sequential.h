#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/sequential_test.h"

namespace jnd::analysis {

/// The looks of the study file in the form in which simulated studies are analysed.
struct PlannedSequential {
  std::string contrast;  ///< The contrast that decides.
  SequentialBoundaries boundaries;
};

/// How a simulated study ended under its looks.
struct SequentialRun {
  std::size_t look = 0;      ///< The look that ended it, counted from 0.
  bool significant = false;  ///< Whether it crossed the boundary.
  /// Whether the same test without looks would be significant, with as many people as at the
  /// first look, with one more, and so on up to the last look.
  std::vector<bool> fixed_significant;
};
/// `people` are as many as the last look needs, in the order in which they take part.
[[nodiscard]] SequentialRun sequential_run(
    const PlannedSequential& planned, const std::vector<std::optional<PersonScore>>& people,
    std::size_t num_groups);

/// A summary over all runs.
struct SequentialPower {
  std::int64_t num_runs = 0;
  /// For each look, the number of runs that ended there.
  std::vector<std::int64_t> num_ended;
  /// For each look, the number of these that crossed the boundary.
  std::vector<std::int64_t> num_significant;
  double power = 0.0;  ///< The share of runs that crossed any boundary.
  /// The 95 % Wilson interval of the power for this number of runs.
  double power_low = 0.0, power_high = 1.0;
  double mean_participants = 0.0;  ///< The expected sample size.
  /// The standard error of that mean over the runs.
  double standard_error = 0.0;
  double fixed_power = 0.0;  ///< The power without looks, with all people.
  /// The smallest number of people, from that of the first look on, with which a study without
  /// looks has at least that power. It is absent if all of them are not enough.
  std::optional<int> fixed_participants;
};
/// Absent if no looks are planned. Throws `core::Error` without runs.
[[nodiscard]] std::optional<SequentialPower> sequential_power(
    const std::optional<PlannedSequential>& planned, const std::vector<SequentialRun>& runs);

/// For a laboratory without a difference: a sentence if the rule finds a difference more often
/// than alpha and there are enough runs to tell. "" otherwise.
[[nodiscard]] std::string sequential_doubt(const PlannedSequential& planned,
                                           const SequentialPower& power);

}  // namespace jnd::analysis
