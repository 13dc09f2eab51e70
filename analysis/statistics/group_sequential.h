#pragma once

#include <cstddef>
#include <vector>

namespace jnd::analysis {

/// How the type I error is spent over the looks of a group-sequential study (Lan and DeMets
/// 1983). The boundaries resemble those of O'Brien and Fleming (1979), which are very strict at
/// first, or those of Pocock (1977), which are nearly the same at every look.
enum class SpendingFunction { kObrienFleming, kPocock };

/// The one-sided alpha that is spent when this share of the information is available:
///
///     O'Brien-Fleming type  2 (1 - Phi(z_{1 - alpha/2} / sqrt(share)))
///     Pocock type           alpha ln(1 + (e - 1) share)
///
/// `alpha` is in (0, 1), and `share` in (0, 1]. At a share of 1 the result is alpha.
[[nodiscard]] double spent_alpha(SpendingFunction spending, double alpha, double share);

/// The paths of a standardised statistic over the looks, by recursive integration (Armitage,
/// McPherson and Rowe 1969). At information I the score S = Z sqrt(I) is normal with mean drift
/// I and variance I, and its increments are independent. Only paths that have not been stopped
/// are kept. Information has any unit, such as people; the drift is then the effect in standard
/// deviations. Not real time.
class SequentialPaths {
 public:
  /// `information` is > 0 and ascending. Throws `core::Error` otherwise.
  SequentialPaths(std::vector<double> information, double drift);

  /// The share of all paths that have continued so far and whose Z at the next look is above or
  /// below z. There must be a next look.
  [[nodiscard]] double above(double z) const;
  [[nodiscard]] double below(double z) const;
  /// Keeps only the paths with lower < Z < upper at the next look. The bounds may be infinite.
  void go_on(double lower, double upper);

 private:
  /// A place where paths are, and the share of all paths there.
  struct Node {
    double score = 0.0, share = 0.0;
  };
  [[nodiscard]] double step() const;

  std::vector<double> information_;
  double drift_;
  std::size_t num_taken_ = 0;
  std::vector<Node> nodes_;
};

/// The boundaries of Z at each look. Without an effect, the share of studies that have crossed
/// a boundary by then equals the alpha spent by then. The boundaries are above, or with
/// `two_sided` on both sides with alpha / 2 each. `looks` are ascending numbers of people, of
/// which the last is the whole study. A boundary is infinite if almost nothing is spent.
/// Not real time.
[[nodiscard]] std::vector<double> spending_boundaries(const std::vector<int>& looks,
                                                      SpendingFunction spending, double alpha,
                                                      bool two_sided);

}  // namespace jnd::analysis
