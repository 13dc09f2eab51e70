#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// One answered trial of an adaptive procedure.
struct TrackPoint {
  std::int64_t trial = 0;  ///< Within the block, from 1.
  double level = 0.0;      ///< As it was presented, unit of the quantity.
  bool yes = false;
  bool is_reversal = false;   ///< It turned the staircase.
  bool is_averaged = false;   ///< One of the reversals that the threshold is the mean of.
  bool is_after_end = false;  ///< A correction put the end before it: it decides nothing.
};

/// One staircase, one series of the method of limits, or all trials of QUEST+.
struct AdaptiveTrack {
  std::int64_t series = 1;  ///< Within the block, from 1.
  std::string direction;    ///< Of a series: "ascending", "descending"; "" of others.
  std::vector<TrackPoint> points;
  /// Mean of the reversals, or the transition; unit of the quantity.
  std::optional<double> threshold;
  int num_reversals = 0;  ///< That were averaged.
  int num_at_bound = 0;   ///< Of these, turns at the least or the largest level.
};

/// What the method of limits comes to.
struct LimitsEstimate {
  std::optional<double> ascending, descending;  ///< Mean transitions, unit of the quantity.
  /// Ascending less descending, in the unit or in ln: above 0 people stay with the answer they
  /// gave (habituation), below 0 they change it early (expectation).
  std::optional<double> constant_error;
  int num_ascending = 0, num_descending = 0;  ///< Transitions.
};

/// What QUEST+ knows of a parameter at the end.
struct PosteriorEstimate {
  std::string parameter;  ///< "pse", "weber_fraction", "threshold", "slope".
  double mean = 0.0;      ///< Posterior mean; of a ratio the exponential of the mean of ln.
  double sd = 0.0;        ///< Standard deviation of the posterior; of a ratio that of ln.
  /// Central 95 % of the posterior, values of its grid; no ends where it reaches an end of any
  /// parameter's grid, as what lies beyond was ruled out before the first answer.
  std::optional<double> low, high;
};

/// What a participant's answers in an adaptive block come to by the block's own rule, which
/// saw trials that were set aside later as well.
struct AdaptiveRun {
  std::string participant, block, procedure;
  bool is_logarithmic = false;  ///< Means are taken in ln of the level.
  /// Of a staircase: "1 up, 2 down", and the probability of "yes" that it converges to.
  std::string rule;
  std::optional<double> target_probability;
  std::vector<AdaptiveTrack> tracks;
  std::optional<double> threshold;  ///< Mean over tracks, or of all transitions.
  LimitsEstimate limits;
  std::vector<PosteriorEstimate> posterior;
  std::vector<std::string> reached_ends;  ///< "the lower end of `pse_viscosity_pa_s` (12)".
  int num_set_aside = 0;                  ///< Trials; QUEST+ alone leaves them out.
  int num_after_end = 0;  ///< Trials that a correction put behind the end of the rule.
  std::string problem;    ///< Why nothing can be said; "" if it can.
};

}  // namespace jnd::analysis
