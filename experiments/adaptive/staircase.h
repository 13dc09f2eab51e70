#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "experiments/adaptive/level_answer.h"
#include "experiments/adaptive/level_scale.h"

namespace jnd::experiments {

/// How a staircase goes up and down: transformed (Levitt 1971), weighted (Kaernbach 1991), or
/// both.
struct StaircaseRule {
  int num_up = 1;    ///< Raising answers in a row that raise the level, >= 1.
  int num_down = 2;  ///< Lowering answers in a row that lower the level, >= 1.
  /// A "yes" lowers the level, as when it is asked whether the test is felt; else a "no" does.
  bool yes_lowers = true;
  LevelScale scale = LevelScale::kLinear;
  /// Step upwards, > 0, in the unit or in ln; the first one until the first reversal, the next
  /// until the second, the last one from then on. At least one.
  std::vector<double> step_sizes;
  double down_per_up_ratio = 1.0;  ///< Step downwards over step upwards, > 0.
  double start = 0.0;              ///< Unit of the quantity, within the bounds.
  double lowest = 0.0;             ///< Unit of the quantity.
  double highest = 0.0;            ///< Unit of the quantity, > `lowest`.
  /// If not empty: the only levels, ascending, within the bounds and holding the start; its
  /// ends are then the bounds. A step goes to the nearest level, and to another one at least.
  std::vector<double> grid;
  int max_trials = 0;                ///< >= 1.
  std::optional<int> max_reversals;  ///< >= 1; whichever of both comes first.
  /// Ends the staircase after so many verdicts in a row, >= 1, to step past a bound.
  std::optional<int> max_blocked_in_a_row;
  int num_reversals_averaged = 6;  ///< The last ones, an even number >= 2.
};

/// A turning point of the levels. Steps that a bound blocked do not move the level, so they
/// make none; a turn that lies on a bound is one, and says so.
struct Reversal {
  std::size_t trial = 0;  ///< Index of the answer that turned the staircase.
  double level = 0.0;     ///< Presented in that trial, unit of the quantity.
  bool at_bound = false;  ///< It might have gone on, had there been a level.
};

enum class StaircaseEnd { kNotFinished, kReversals, kTrials, kBlocked };

/// What the answers so far come to.
struct StaircaseState {
  double next_level = 0.0;  ///< Unit of the quantity.
  StaircaseEnd end = StaircaseEnd::kNotFinished;
  std::vector<Reversal> reversals;
  int num_blocked = 0;  ///< Verdicts to step past a bound, in all.
  /// Answers behind the end, which decide nothing: a correction can put the end before them.
  int num_after_end = 0;

  [[nodiscard]] bool is_finished() const noexcept { return end != StaircaseEnd::kNotFinished; }
};

struct StaircaseThreshold {
  /// Mean in the scale of the staircase, unit of the quantity; none before two reversals.
  std::optional<double> level;
  int num_reversals = 0;  ///< That were averaged; even.
  int num_at_bound = 0;   ///< Of these; the threshold leans on the bound if there are any.
};

/// An adaptive staircase (Levitt 1971, J. Acoust. Soc. Am. 49, 467). Has no state of its own:
/// an answer taken back is one that is not passed in. Not real time.
class Staircase {
 public:
  /// Throws `Error` naming the field of the rule that is wrong.
  explicit Staircase(StaircaseRule rule);

  /// With the ends of the grid, if there is one, as its bounds.
  [[nodiscard]] const StaircaseRule& rule() const noexcept { return rule_; }
  /// All from the start. Throws `Error` for a level that is none.
  [[nodiscard]] StaircaseState after(const std::vector<LevelAnswer>& answers) const;
  /// From the last reversals, as many as the rule says; if there are fewer, from the largest
  /// even number of them, so that peaks and valleys are as many.
  [[nodiscard]] StaircaseThreshold threshold(const StaircaseState& state) const;
  /// Probability of the lowering answer at the level about which the staircase comes to swing.
  [[nodiscard]] double target_probability() const;

 private:
  /// What `after` remembers from trial to trial.
  struct Run {
    std::size_t num_trials = 0;
    int num_lowering = 0;          // In a row, since the last verdict.
    int num_raising = 0;           // The same.
    int num_blocked_in_a_row = 0;  // Verdicts.
    int last_direction = 0;        // Of the last step that moved the level: -1 down, 1 up.
  };
  [[nodiscard]] bool is_at_bottom(double level) const noexcept;
  [[nodiscard]] bool is_at_top(double level) const noexcept;
  [[nodiscard]] double allowed(double level) const noexcept;
  [[nodiscard]] double stepped(double level, bool down, std::size_t num_reversals) const;
  void move(double level, bool down, Run& run, StaircaseState& state) const;
  [[nodiscard]] StaircaseEnd end_of(const Run& run, const StaircaseState& state) const noexcept;

  StaircaseRule rule_;
  double rounding_ = 0.0;  // In the scale: steps that come this close to a bound are on it.
};

/// The probability p of a lowering answer at which steps up and down cancel: the step down is
/// as much more likely as it is shorter. A run of d lowering answers comes before one of u
/// raising ones with the probability (Feller 1968, sec. VIII.1; q = 1 - p)
///
///     p^(d-1) (1 - q^u) / (p^(d-1) + q^(u-1) - p^(d-1) q^(u-1))
///
/// 1-up 2-down: p^2 = 1/2, so 0.7071 (Levitt 1971); 1-up 1-down: 1 / (1 + ratio) (Kaernbach
/// 1991). It holds for small steps; with large ones, runs at equal steps swing about a point
/// that also depends on the curve (Garcia-Perez 1998). Throws `Error` unless all are > 0.
[[nodiscard]] double staircase_target_probability(int num_up, int num_down,
                                                  double down_per_up_ratio);

/// The step ratio for which that is `target_probability`, in (0, 1). Kaernbach's (1991)
/// weighted up-down with one up and one down: (1 - p) / p.
[[nodiscard]] double staircase_step_ratio(double target_probability, int num_up = 1,
                                          int num_down = 1);

/// How many trials a staircase takes, at most `max_trials`, with an observer whose lowering
/// answers follow a cumulative normal curve in the scale of the rule: half of them at
/// `threshold` (unit of the quantity), standard deviation `spread` > 0 (of the scale). The way
/// from the start to the level it swings about, in first steps, and for each reversal
///
///     trials of a verdict / probability that it turns,
///
/// both near that level. A verdict, a run of d lowering answers or of u raising ones, takes
/// (1 - p^d) (1 - q^u) / (p^d q + p q^u - p^d q^u) trials (Feller 1968, sec. XIII.7). Were
/// verdicts independent, they would turn with 2 r / (1 + r)^2, r being the step down over the
/// step up s; that the curve drives the levels back adds b s r / (1 + r), b being how much
/// the probability of a verdict downwards rises with the level: the stationary covariance of
/// neighbouring verdicts of a random walk with a linear restoring drift. Bounds are left out.
/// Within 20 % of simulated participants (1 to 3 down, steps of 5 to 100 %, 6 to 14 reversals).
/// Throws `Error` unless the rule's numbers up and down and its ratio are sound.
[[nodiscard]] double expected_staircase_trials(const StaircaseRule& rule, double threshold,
                                               double spread);

}  // namespace jnd::experiments
