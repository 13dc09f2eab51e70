#pragma once

namespace jnd::analysis {

/// Of a share s, Beta(a, b) with the density s^(a - 1) (1 - s)^(b - 1): both 1 or more, for
/// else the density has no bound at s = 0 or s = 1, and the largest would always be there.
struct BetaPrior {
  double a = 1.0, b = 1.0;

  /// Its density to the power of `weight`: 0 makes it level.
  [[nodiscard]] constexpr BetaPrior weighed(double weight) const noexcept {
    return {1.0 + weight * (a - 1.0), 1.0 + weight * (b - 1.0)};
  }
};

/// Of the posterior's free rates of lapses and guesses, where nothing else is asked for.
inline constexpr BetaPrior kUsualRatePrior = {1.0, 10.0};

/// What becomes of an estimate where the prior has another weight: it is left out, and it
/// counts half and twice. The estimate's own is 1.
inline constexpr double kOtherPriorWeights[] = {0.0, 0.5, 2.0};

}  // namespace jnd::analysis
