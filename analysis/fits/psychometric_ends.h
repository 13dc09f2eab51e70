#pragma once

namespace jnd::analysis {

/// The shares of yes between which a curve rises, f = low + (high - low) F. They follow from
/// the guess rate, which is usually known, and the lapse rate, which is known or fitted.
///
///     symmetric  f = guess + lapse + (1 - guess - 2 lapse) F
///     upper end  f = guess + (1 - guess - lapse) F
///
/// Without guesses the first form is that of yes-no answers, lapse + (1 - 2 lapse) F. The
/// second is that of a forced choice, whose lapses are guesses that may be right by chance
/// (Wichmann and Hill 2001). A free guess rate is fitted like the lapse rate of the upper end.
/// Both are then below 0.5, and f = guess + (1 - guess - lapse) F.
struct PsychometricEnds {
  double guess = 0.0;        ///< The guess rate, in [0, 1). It is 0 if the guess rate is free.
  bool symmetric = true;     ///< Whether lapses occur at both ends.
  double known_lapse = 0.0;  ///< The lapse rate if it is not free, in [0, `lapse_limit`).
  bool free_guess = false;   ///< Whether the guess rate is free. This excludes `symmetric`.

  /// The lapse rate at which both ends meet.
  [[nodiscard]] double lapse_limit() const noexcept {
    if (free_guess) return 0.5;
    return symmetric ? 0.5 * (1.0 - guess) : 1.0 - guess;
  }
  /// The largest lapse rate that a search may use, a little below the limit.
  [[nodiscard]] double largest_lapse() const noexcept { return lapse_limit() - 1e-9; }
  /// The limit of a free guess rate.
  [[nodiscard]] double guess_limit() const noexcept {
    return known_lapse < 0.5 ? 0.5 : 1.0 - known_lapse;
  }
  [[nodiscard]] double largest_guess() const noexcept { return guess_limit() - 1e-9; }
  /// The lower end. `free` is the guess rate if that is free, and 0 otherwise.
  [[nodiscard]] double low(double lapse, double free = 0.0) const noexcept {
    return symmetric ? guess + lapse : guess + free;
  }
  /// The distance between the ends, high - low.
  [[nodiscard]] double rise(double lapse, double free = 0.0) const noexcept {
    return 1.0 - guess - lapse_share() * lapse - free;
  }
  /// The factor by which the lapse rate reduces the rise.
  [[nodiscard]] double lapse_share() const noexcept { return symmetric ? 2.0 : 1.0; }
  /// The derivative of the lower end by the lapse rate.
  [[nodiscard]] double low_by_lapse() const noexcept { return symmetric ? 1.0 : 0.0; }
  /// df / dlapse where F = `lower` and 1 - F = `upper`.
  [[nodiscard]] double by_lapse(double lower, double upper) const noexcept {
    return symmetric ? upper - lower : -lower;
  }
  /// f at the pse, where F = 0.5.
  [[nodiscard]] double middle(double lapse) const noexcept {
    return low(lapse) + 0.5 * rise(lapse);
  }
  /// Whether f is F itself, whose log-likelihood is concave.
  [[nodiscard]] bool are_bare(bool free_lapse) const noexcept {
    return guess == 0.0 && !free_guess && !free_lapse && known_lapse == 0.0;
  }
  /// Whether a yes is possible where F = 0.
  [[nodiscard]] bool low_is_possible(bool free_lapse) const noexcept {
    return guess > 0.0 || free_guess || (symmetric && (free_lapse || known_lapse > 0.0));
  }
};

}  // namespace jnd::analysis
