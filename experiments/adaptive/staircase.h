#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "experiments/adaptive/level_answer.h"
#include "experiments/adaptive/level_scale.h"

namespace jnd::experiments {

/// The rule of a staircase: transformed (Levitt 1971), weighted (Kaernbach 1991), or both.
struct StaircaseRule {
  int num_up = 1;    ///< Number of raising answers in a row that raise the level, >= 1.
  int num_down = 2;  ///< Number of lowering answers in a row that lower the level, >= 1.
  /// If true, "yes" lowers the level, as with the question whether the test is felt; otherwise
  /// "no" does.
  bool yes_lowers = true;
  LevelScale scale = LevelScale::kLinear;
  /// Steps upwards, > 0, in the unit or in ln; at least one. The first one holds until the
  /// first reversal, the next until the second, and the last one from then on.
  std::vector<double> step_sizes;
  double down_per_up_ratio = 1.0;  ///< Ratio of the step downwards to the step upwards, > 0.
  double start = 0.0;              ///< In the unit of the quantity, within the bounds.
  double lowest = 0.0;             ///< In the unit of the quantity.
  double highest = 0.0;            ///< In the unit of the quantity, > `lowest`.
  /// If not empty, these are the only levels. They are ascending, lie within the bounds and
  /// contain the start. Their ends replace the bounds. A step goes to the nearest level, but
  /// always to another one.
  std::vector<double> grid;
  int max_trials = 0;  ///< >= 1.
  /// >= 1; the staircase ends at whichever of the two comes first.
  std::optional<int> max_reversals;
  /// Ends the staircase after this many verdicts in a row, >= 1, to step past a bound.
  std::optional<int> max_blocked_in_a_row;
  /// How many of the last reversals are averaged, an even number >= 2.
  int num_reversals_averaged = 6;
};

/// A reversal of the levels. A step that a bound blocked does not move the level, so it makes
/// no reversal. A reversal at a bound is marked.
struct Reversal {
  std::size_t trial = 0;  ///< Index of the answer that turned the staircase.
  double level = 0.0;     ///< Level presented in that trial, in the unit of the quantity.
  bool at_bound = false;  ///< The staircase might have gone further without the bound.
};

enum class StaircaseEnd { kNotFinished, kReversals, kTrials, kBlocked };

/// The state of the staircase after the answers so far.
struct StaircaseState {
  double next_level = 0.0;  ///< In the unit of the quantity.
  StaircaseEnd end = StaircaseEnd::kNotFinished;
  std::vector<Reversal> reversals;
  int num_blocked = 0;  ///< Verdicts to step past a bound, in all.
  /// Answers behind the end, which decide nothing: a correction can put the end before them.
  int num_after_end = 0;

  [[nodiscard]] bool is_finished() const noexcept { return end != StaircaseEnd::kNotFinished; }
};

struct StaircaseThreshold {
  /// Mean in the scale of the staircase, in the unit of the quantity; none before two
  /// reversals.
  std::optional<double> level;
  int num_reversals = 0;  ///< Number of averaged reversals; even.
  /// How many of these are at a bound. If there are any, the bound biases the threshold.
  int num_at_bound = 0;
};

/// An adaptive staircase (Levitt 1971, J. Acoust. Soc. Am. 49, 467). It has no state: to take
/// an answer back, leave it out of the list. Not real time.
class Staircase {
 public:
  /// Throws `Error` naming the field of the rule that is wrong.
  explicit Staircase(StaircaseRule rule);

  /// Returns the rule. If it has a grid, its bounds are the grid's ends.
  [[nodiscard]] const StaircaseRule& rule() const noexcept { return rule_; }
  /// All from the start. Throws `Error` for a level that is none.
  [[nodiscard]] StaircaseState after(const std::vector<LevelAnswer>& answers) const;
  /// Averages the last reversals, as many as the rule says. If there are fewer, it takes the
  /// largest even number of them, so that peaks and valleys are equally many.
  [[nodiscard]] StaircaseThreshold threshold(const StaircaseState& state) const;
  /// Returns the probability of the lowering answer at the level about which the staircase
  /// settles.
  [[nodiscard]] double target_probability() const;

 private:
  /// What `after` remembers from trial to trial.
  struct Run {
    std::size_t num_trials = 0;
    int num_lowering = 0;          // Lowering answers in a row since the last verdict.
    int num_raising = 0;           // Raising answers in a row since the last verdict.
    int num_blocked_in_a_row = 0;  // Number of verdicts.
    // Direction of the last step that moved the level: -1 down, 1 up.
    int last_direction = 0;
  };
  [[nodiscard]] bool is_at_bottom(double level) const noexcept;
  [[nodiscard]] bool is_at_top(double level) const noexcept;
  [[nodiscard]] double allowed(double level) const noexcept;
  [[nodiscard]] double stepped(double level, bool down, std::size_t num_reversals) const;
  void move(double level, bool down, Run& run, StaircaseState& state) const;
  [[nodiscard]] StaircaseEnd end_of(const Run& run, const StaircaseState& state) const noexcept;

  StaircaseRule rule_;
  // A tolerance in the scale. A step that comes this close to a bound is on the bound.
  double rounding_ = 0.0;
};

/// Returns the probability p of a lowering answer at which steps up and down cancel: the
/// shorter step is more frequent in proportion. A run of d lowering answers comes before one of
/// u raising ones with the probability (Feller 1968, sec. VIII.1; q = 1 - p)
///
///   p^(d-1) (1 - q^u) / (p^(d-1) + q^(u-1) - p^(d-1) q^(u-1))
///
/// For 1-up 2-down, p^2 = 1/2, so p = 0.7071 (Levitt 1971). For 1-up 1-down, p = 1 / (1 +
/// ratio) (Kaernbach 1991). This holds for small steps. With large ones, runs at equal steps
/// settle about a point that also depends on the curve (Garcia-Perez 1998). Throws `Error`
/// unless all arguments are > 0.
[[nodiscard]] double staircase_target_probability(int num_up, int num_down,
                                                  double down_per_up_ratio);

/// Returns the step ratio that gives this `target_probability`, in (0, 1). For Kaernbach's
/// (1991) weighted up-down with one up and one down it is (1 - p) / p.
[[nodiscard]] double staircase_step_ratio(double target_probability, int num_up = 1,
                                          int num_down = 1);

/// Returns how many trials a staircase is expected to take, at most `max_trials`. The
/// observer's lowering answers follow a cumulative normal curve in the scale of the rule: half
/// of them at `threshold` (in the unit of the quantity), with a standard deviation of `spread`
/// > 0 (in the scale). The number is the sum of the way from the start to the level about which
/// it settles, in first steps, and for each reversal
///
///   trials of a verdict / probability that it turns,
///
/// both near that level. A verdict, which is a run of d lowering answers or of u raising ones,
/// takes (1 - p^d) (1 - q^u) / (p^d q + p q^u - p^d q^u) trials (Feller 1968, sec. XIII.7). If
/// verdicts were independent, they would turn with the probability 2 r / (1 + r)^2, where r is
/// the step down over the step up s. Because the curve drives the levels back, b s r / (1 + r)
/// is added, where b is how much the probability of a verdict downwards rises with the level.
/// This is the stationary covariance of neighbouring verdicts of a random walk with a linear
/// restoring drift. Bounds are ignored. The result is within 20 % of simulated participants (1
/// to 3 down, steps of 5 to 100 %, 6 to 14 reversals). Throws `Error` unless the rule's numbers
/// up and down and its ratio are valid.
[[nodiscard]] double expected_staircase_trials(const StaircaseRule& rule, double threshold,
                                               double spread);

}  // namespace jnd::experiments
