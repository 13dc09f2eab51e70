#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// One answered trial of an adaptive procedure.
struct TrackPoint {
  std::int64_t trial = 0;  ///< The number of the trial within the block, from 1.
  double level = 0.0;      ///< The presented level in the unit of the quantity.
  bool yes = false;
  bool is_reversal = false;  ///< Whether the staircase turned here.
  /// Whether it is one of the reversals whose mean is the threshold.
  bool is_averaged = false;
};

/// One staircase, one series of the method of limits, or all trials of QUEST+.
struct AdaptiveTrack {
  std::int64_t series = 1;  ///< The number of the series within the block, from 1.
  /// For a series of the method of limits: "ascending" or "descending"; "" otherwise.
  std::string direction;
  std::vector<TrackPoint> points;
  /// The mean of the reversals, or the transition, in the unit of the quantity.
  std::optional<double> threshold;
  int num_reversals = 0;  ///< The number of reversals that were averaged.
  int num_at_bound = 0;   ///< The number of these that lie at the least or largest level.
};

/// The result of the method of limits.
struct LimitsEstimate {
  /// Mean transitions in the unit of the quantity.
  std::optional<double> ascending, descending;
  /// The ascending mean minus the descending one, in the unit or in ln. Above 0, people stay
  /// with their answer (habituation); below 0, they change it early (expectation).
  std::optional<double> constant_error;
  int num_ascending = 0, num_descending = 0;  ///< The numbers of transitions.
};

/// What QUEST+ knows about a parameter at the end.
struct PosteriorEstimate {
  std::string parameter;  ///< "pse", "weber_fraction", "threshold" or "slope".
  /// The posterior mean. For a ratio it is the exponential of the mean of ln.
  double mean = 0.0;
  /// The standard deviation of the posterior. For a ratio it is that of ln.
  double sd = 0.0;
  /// The central 95 % of the posterior, as values of its grid. The ends are absent if the
  /// posterior reaches an end of any parameter's grid, because what lies beyond was excluded
  /// before the first answer.
  std::optional<double> low, high;
};

/// The result of a participant's answers in an adaptive block by the block's own rule. The rule
/// also saw trials that were set aside later.
struct AdaptiveRun {
  std::string participant, block, procedure;
  bool is_logarithmic = false;  ///< Whether means are taken in ln of the level.
  /// The rule of a staircase, such as "1 up, 2 down", and the probability of "yes" to which it
  /// converges.
  std::string rule;
  std::optional<double> target_probability;
  std::vector<AdaptiveTrack> tracks;
  std::optional<double> threshold;  ///< The mean over tracks, or over all transitions.
  LimitsEstimate limits;
  std::vector<PosteriorEstimate> posterior;
  /// For example "the lower end of `pse_viscosity_pa_s` (12)".
  std::vector<std::string> reached_ends;
  /// The number of trials that were set aside. Only QUEST+ leaves them out.
  int num_set_aside = 0;
  std::string problem;  ///< Why there is no result; "" if there is one.
};

}  // namespace jnd::analysis
