#pragma once

namespace jnd::analysis {

/// The prior Beta(a, b) of a share s, with the density s^(a - 1) (1 - s)^(b - 1). Both a and b
/// are at least 1, because otherwise the density is unbounded at s = 0 or s = 1 and the maximum
/// would always lie there.
struct BetaPrior {
  double a = 1.0, b = 1.0;

  /// The prior whose density is this one to the power of `weight`. A weight of 0 makes it
  /// uniform.
  [[nodiscard]] constexpr BetaPrior weighed(double weight) const noexcept {
    return {1.0 + weight * (a - 1.0), 1.0 + weight * (b - 1.0)};
  }
};

/// The posterior uses this prior for free lapse and guess rates unless another one is asked
/// for.
inline constexpr BetaPrior kUsualRatePrior = {1.0, 10.0};

/// The weights for which the effect of a prior on an estimate is shown: the prior is left out,
/// counts half, and counts twice. The estimate itself uses the weight 1.
inline constexpr double kOtherPriorWeights[] = {0.0, 0.5, 2.0};

}  // namespace jnd::analysis
