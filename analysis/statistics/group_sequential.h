#pragma once

#include <cstddef>
#include <vector>

namespace jnd::analysis {

/// How the error of the first kind is spent over the looks of a group-sequential study (Lan and
/// DeMets 1983): boundaries like those of O'Brien and Fleming (1979), very strict at first, or
/// of Pocock (1977), nearly the same at every look.
enum class SpendingFunction { kObrienFleming, kPocock };

/// What is spent once this share of the information is there, of one side:
///     O'Brien-Fleming type  2 (1 - Phi(z_{1 - alpha/2} / sqrt(share)))
///     Pocock type           alpha ln(1 + (e - 1) share)
/// `alpha` in (0, 1), `share` in (0, 1]; at 1 it is alpha.
[[nodiscard]] double spent_alpha(SpendingFunction spending, double alpha, double share);

/// Paths of a standardised statistic over looks, by recursive integration (Armitage, McPherson
/// and Rowe 1969): at information I the score S = Z sqrt(I) is normal with mean drift I and
/// variance I, and its increments are independent. Only paths that have not been stopped are
/// kept. Information is in any unit, such as people; the drift is then the effect in standard
/// deviations. Not real time.
class SequentialPaths {
 public:
  /// `information` ascending, > 0. Throws `core::Error` otherwise.
  SequentialPaths(std::vector<double> information, double drift);

  /// The share of all paths that have gone on so far and whose Z at the next look is above or
  /// below z. There has to be a next look.
  [[nodiscard]] double above(double z) const;
  [[nodiscard]] double below(double z) const;
  /// Only paths with lower < Z < upper at the next look go on. The ends may be infinite.
  void go_on(double lower, double upper);

 private:
  /// Where a path is, and the share of all paths there.
  struct Node {
    double score = 0.0, share = 0.0;
  };
  [[nodiscard]] double step() const;

  std::vector<double> information_;
  double drift_;
  std::size_t num_taken_ = 0;
  std::vector<Node> nodes_;
};

/// Boundaries of Z at each look, so that without an effect what is spent of alpha until then is
/// the share of studies that have crossed one: above them alone, or `two_sided` beyond them on
/// either side, alpha / 2 each. `looks` are ascending numbers of people, the last of them is
/// the whole study. Infinite where next to nothing is spent. Not real time.
[[nodiscard]] std::vector<double> spending_boundaries(const std::vector<int>& looks,
                                                      SpendingFunction spending, double alpha,
                                                      bool two_sided);

}  // namespace jnd::analysis
