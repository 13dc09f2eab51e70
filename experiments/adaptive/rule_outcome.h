#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "experiments/adaptive/level_answer.h"

namespace jnd::experiments {

/// A trial that moved an adaptive procedure, and where it stands in its block.
struct LevelTrial {
  std::int64_t number = 0;  ///< In the block, from 1.
  int series = 0;           ///< 0 where there is but one.
  LevelAnswer answer;
  bool set_aside = false;  ///< Later, by somebody: the procedure saw it.
};

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

/// What the answers in a block come to by the block's own rule.
struct RuleOutcome {
  bool is_logarithmic = false;  ///< Means are taken in ln of the level.
  /// Of a staircase: "1 up, 2 down", and the probability of "yes" that it converges to.
  std::string rule;
  std::optional<double> target_probability;
  std::vector<AdaptiveTrack> tracks;
  std::optional<double> threshold;  ///< Mean over tracks, or of all transitions.
  LimitsEstimate limits;
  std::vector<PosteriorEstimate> posterior;
  std::vector<std::string> reached_ends;  ///< "the lower end of `pse_viscosity_pa_s` (12)".
};

[[nodiscard]] inline std::vector<LevelAnswer> answers_of(
    const std::vector<LevelTrial>& trials) {
  std::vector<LevelAnswer> answers;
  for (const LevelTrial& trial : trials) answers.push_back(trial.answer);
  return answers;
}

[[nodiscard]] inline std::vector<LevelTrial> of_series(const std::vector<LevelTrial>& trials,
                                                       int series) {
  std::vector<LevelTrial> own;
  std::ranges::copy_if(trials, std::back_inserter(own),
                       [series](const LevelTrial& trial) { return trial.series == series; });
  return own;
}

[[nodiscard]] inline AdaptiveTrack track_of(int series, const std::vector<LevelTrial>& trials) {
  AdaptiveTrack track{.series = series};
  for (const LevelTrial& trial : trials) {
    track.points.push_back(
        {.trial = trial.number, .level = trial.answer.level, .yes = trial.answer.yes});
  }
  return track;
}

/// Marks the last points of a track, which the rule did not need.
inline void mark_after_end(AdaptiveTrack& track, int num_after_end) {
  const std::size_t num =
      std::min(track.points.size(), static_cast<std::size_t>(num_after_end));
  for (std::size_t i = track.points.size() - num; i < track.points.size(); ++i) {
    track.points[i].is_after_end = true;
  }
}

}  // namespace jnd::experiments
