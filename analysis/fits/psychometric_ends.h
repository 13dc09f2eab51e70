#pragma once

namespace jnd::analysis {

/// Between which shares of yes a curve rises: f = low + (high - low) F, by the rate of guesses,
/// which is known, and the lapse rate, which is known or fitted.
///
///     symmetric  f = guess + lapse + (1 - guess - 2 lapse) F
///     upper end  f = guess + (1 - guess - lapse) F
///
/// A guess rate that is free is fitted as the lapse rate of the upper end is, both below 0.5:
/// f = guess + (1 - guess - lapse) F. Without guesses the first is that of answers of yes and
/// no, lapse + (1 - 2 lapse) F; the second that of a forced choice, whose lapses are guesses
/// that chance makes right (Wichmann and Hill 2001).
struct PsychometricEnds {
  double guess = 0.0;        ///< [0, 1); 0 where it is free.
  bool symmetric = true;     ///< Lapses at both ends.
  double known_lapse = 0.0;  ///< Of a lapse rate that is not free: [0, `lapse_limit`).
  bool free_guess = false;   ///< Not with `symmetric`.

  /// The lapse rate at which nothing is left between the ends.
  [[nodiscard]] double lapse_limit() const noexcept {
    if (free_guess) return 0.5;
    return symmetric ? 0.5 * (1.0 - guess) : 1.0 - guess;
  }
  /// A little below it.
  [[nodiscard]] double largest_lapse() const noexcept { return lapse_limit() - 1e-9; }
  /// The same of a guess rate that is free.
  [[nodiscard]] double guess_limit() const noexcept {
    return known_lapse < 0.5 ? 0.5 : 1.0 - known_lapse;
  }
  [[nodiscard]] double largest_guess() const noexcept { return guess_limit() - 1e-9; }
  /// `free`: the guess rate where that is free, else 0.
  [[nodiscard]] double low(double lapse, double free = 0.0) const noexcept {
    return symmetric ? guess + lapse : guess + free;
  }
  /// high - low
  [[nodiscard]] double rise(double lapse, double free = 0.0) const noexcept {
    return 1.0 - guess - lapse_share() * lapse - free;
  }
  /// By how much the rise shrinks with the lapse rate.
  [[nodiscard]] double lapse_share() const noexcept { return symmetric ? 2.0 : 1.0; }
  /// Derivative of the lower end in the lapse rate.
  [[nodiscard]] double low_by_lapse() const noexcept { return symmetric ? 1.0 : 0.0; }
  /// df / dlapse where F = `lower` and 1 - F = `upper`.
  [[nodiscard]] double by_lapse(double lower, double upper) const noexcept {
    return symmetric ? upper - lower : -lower;
  }
  /// f at the pse, where F = 0.5.
  [[nodiscard]] double middle(double lapse) const noexcept {
    return low(lapse) + 0.5 * rise(lapse);
  }
  /// Whether the likelihood is that of the family itself, which is concave.
  [[nodiscard]] bool are_bare(bool free_lapse) const noexcept {
    return guess == 0.0 && !free_guess && !free_lapse && known_lapse == 0.0;
  }
  /// Whether a yes is possible where F = 0.
  [[nodiscard]] bool low_is_possible(bool free_lapse) const noexcept {
    return guess > 0.0 || free_guess || (symmetric && (free_lapse || known_lapse > 0.0));
  }
};

}  // namespace jnd::analysis
