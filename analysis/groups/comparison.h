#pragma once

#include <string>
#include <vector>

#include "analysis/fits/fit_status.h"

namespace jnd::analysis {

/// Outcome of a test, with the words of the JSON output. What is undefined is absent, and
/// `status` is kDegenerate: never a 0 or NaN in its place.
struct Comparison {
  enum class Kind {
    kPaired,
    kWelch,
    kPooled,
    kPearson,
    kWilcoxon,
    kOneSample,
    kRankSum,
    kSpearman
  };

  FitStatus status = FitStatus::kNotRun;
  Kind kind = Kind::kPaired;
  std::string reason;  ///< Why a value is undefined; "" if all are defined.
  std::string method;  ///< The test in words, with the approximation if any.
  /// Mean of a - b (also of the rank tests, which test `hodges_lehmann`), of the values, or
  /// the correlation.
  std::optional<double> estimate;
  Interval ci95;                    ///< Of the estimate.
  std::optional<double> statistic;  ///< t; Wilcoxon: the smaller sum of ranks; rank sum: U.
  std::optional<double> degrees_of_freedom;
  std::optional<double> p_value;   ///< Two-sided.
  std::optional<double> cohen_dz;  ///< Paired: mean difference over its standard deviation.
  Interval cohen_dz_ci95;          ///< By the noncentral t, as is that of Hedges' g.
  /// Difference of means over the standard deviation, without its bias (Hedges 1981): paired
  /// and one sample, of the differences; two groups, the pooled one, whose interval takes both
  /// groups' spreads for equal, whatever the test does.
  std::optional<double> hedges_g;
  Interval hedges_g_ci95;
  /// Wilcoxon, rank sum: how much more weight a > b has than a < b, -1 to 1 (Kerby 2014).
  /// Without an interval: one by Fisher's z, with the standard error of no effect, contradicts
  /// the exact test beside it and does not exist at -1 and 1.
  std::optional<double> rank_biserial;
  /// Wilcoxon: the median of all pairwise means of the differences; rank sum: of all
  /// differences a - b (Hodges and Lehmann 1963). With its distribution-free interval.
  std::optional<double> hodges_lehmann;
  Interval hodges_lehmann_ci95;
  int num_a = 0, num_b = 0;      ///< Values used.
  bool of_other_people = false;  ///< Of a model: nobody's answers are on both sides.
};

/// Effect sizes have intervals that take nearly all of a test's time.
enum class EffectSizes { kComputed, kLeftOut };

/// Student's t of the differences a[i] - b[i]. Throws `core::Error` if the lengths differ or a
/// value is not finite, as do all of these.
[[nodiscard]] Comparison paired_t_test(const std::vector<double>& a,
                                       const std::vector<double>& b,
                                       EffectSizes effects = EffectSizes::kComputed);

/// Welch's t (1947), unequal variances, degrees of freedom by Welch and Satterthwaite.
[[nodiscard]] Comparison welch_t_test(const std::vector<double>& a,
                                      const std::vector<double>& b,
                                      EffectSizes effects = EffectSizes::kComputed);

/// Pearson's correlation; p by t with n - 2 degrees of freedom, interval by Fisher's z (1921).
[[nodiscard]] Comparison pearson_correlation(const std::vector<double>& a,
                                             const std::vector<double>& b);

/// Wilcoxon's signed-rank test (1945). Differences of 0 are dropped. The distribution is exact
/// up to 50 differences without ties or zeros; otherwise normal with the variance corrected for
/// ties, without continuity correction. `method` says which.
[[nodiscard]] Comparison wilcoxon_test(const std::vector<double>& a,
                                       const std::vector<double>& b);

/// Student's t of one sample against 0.
[[nodiscard]] Comparison one_sample_t_test(const std::vector<double>& values);

/// Rank sum of Wilcoxon (1945), Mann and Whitney's U of a (1947). Exact without ties up to 50
/// values in all; otherwise normal with the variance corrected for ties, without continuity
/// correction. `method` says which.
[[nodiscard]] Comparison rank_sum_test(const std::vector<double>& a,
                                       const std::vector<double>& b);

/// Spearman's rank correlation, ties sharing the mean of their ranks; p by t with n - 2 degrees
/// of freedom, interval by Fisher's z with the standard error of Bonett and Wright (2000).
[[nodiscard]] Comparison spearman_correlation(const std::vector<double>& a,
                                              const std::vector<double>& b);

/// Student's t with pooled variance from published means and standard deviations: for
/// comparison with papers that print no raw data. Counts >= 2, deviations >= 0.
struct PublishedGroup {
  double mean = 0.0;
  double standard_deviation = 0.0;
  int num_values = 0;
};
[[nodiscard]] Comparison pooled_t_test(const PublishedGroup& a, const PublishedGroup& b);

}  // namespace jnd::analysis
