#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/statistics/fit_status.h"

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
    kSpearman,
    kKendall,
    kSign,
    kPermutation,
    kGroupPermutation,
    kDispersion  ///< Of standardised values of people, none of which should vary but by chance.
  };

  FitStatus status = FitStatus::kNotRun;
  Kind kind = Kind::kPaired;
  std::string reason;  ///< Why a value is undefined; "" if all are defined.
  std::string method;  ///< The test in words, with the approximation if any.
  /// Mean of a - b (also of the rank tests, which test `hodges_lehmann`), of the values, the
  /// correlation, or of a dispersion the mean square.
  std::optional<double> estimate;
  Interval ci95;  ///< 95 % interval of the estimate.
  std::optional<double> statistic;
  /// "t"; Wilcoxon "T", the smaller sum of ranks; rank sum "U" of a, which R calls W; Spearman
  /// "S" as R has it, (n^3 - n) (1 - r) / 6, the sum of squared differences of untied ranks.
  std::string statistic_name = "t";
  /// Wilcoxon: "V", the sum of the ranks with a > b; Spearman, where p is by t, that t.
  std::vector<std::pair<std::string, double>> other_statistics;
  /// Both, `statistic` last: what JSON calls `statistics`.
  [[nodiscard]] std::vector<std::pair<std::string, double>> all_statistics() const;
  std::optional<double> degrees_of_freedom;
  std::optional<double> p_value;   ///< Two-sided.
  std::optional<double> cohen_dz;  ///< Paired: mean difference over its standard deviation.
  Interval cohen_dz_ci95;          ///< By the noncentral t, as is that of Hedges' g.
  /// Difference of means over the standard deviation, without its bias (Hedges 1981): paired
  /// and one sample, of the differences; two groups, the root of the mean of their variances.
  std::optional<double> hedges_g;
  Interval hedges_g_ci95;
  /// Wilcoxon, rank sum: how much more weight a > b has than a < b, -1 to 1 (Kerby 2014).
  /// Without an interval: one by Fisher's z, with the standard error of no effect, contradicts
  /// the exact test beside it and does not exist at -1 and 1.
  std::optional<double> rank_biserial;
  /// Wilcoxon: the median of all pairwise means of the differences other than 0; rank sum: of
  /// all differences a - b (Hodges and Lehmann 1963). With its distribution-free interval.
  std::optional<double> hodges_lehmann;
  Interval hodges_lehmann_ci95;
  int num_a = 0, num_b = 0;      ///< Values used.
  int num_zeros = 0;             ///< Wilcoxon: of these pairs, differences of 0, left out.
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

/// Wilcoxon's signed-rank test (1945). Differences of 0 are left out, as R's wilcox.test and
/// SciPy's `zero_method="wilcox"` do; those that differ by no more than the rounding of a
/// subtraction are tied. Up to 50 other differences, tied or not, the distribution is exact:
/// over all signs of the ranks; beyond, normal, with the variance corrected for ties and with
/// continuity correction. Two-sided is twice the smaller tail, at most 1. `method` says which.
[[nodiscard]] Comparison wilcoxon_test(const std::vector<double>& a,
                                       const std::vector<double>& b);

/// Student's t of one sample against 0.
[[nodiscard]] Comparison one_sample_t_test(const std::vector<double>& values);

/// Rank sum of Wilcoxon (1945), Mann and Whitney's U of a (1947). Up to 50 values in all, tied
/// or not, exact: over all ways to share the ranks out; beyond, normal, with the variance
/// corrected for ties and with continuity correction. Two-sided is twice the smaller tail, at
/// most 1 (with ties the tails may differ). `method` says which.
[[nodiscard]] Comparison rank_sum_test(const std::vector<double>& a,
                                       const std::vector<double>& b);

/// Spearman's rank correlation, ties sharing the mean of their ranks; interval by Fisher's z
/// with the standard error of Bonett and Wright (2000), none at r = -1 and 1. Up to 14 pairs,
/// tied or not, p is exact: over all pairings of the ranks, twice the smaller tail, at most 1
/// (R's cor.test approximates it from 10 pairs on, Best and Roberts 1975). Beyond, by t with
/// n - 2 degrees of freedom; ranks that agree wholly are exact there, too. `method` says which.
[[nodiscard]] Comparison spearman_correlation(const std::vector<double>& a,
                                              const std::vector<double>& b);

/// Kendall's tau b (1938, 1945). Up to 50 pairs without ties p is exact, over all orders, and
/// the statistic is the number of concordant pairs; else normal, with the variance corrected
/// for ties and, as R's cor.test has it, without a continuity correction.
[[nodiscard]] Comparison kendall_correlation(const std::vector<double>& a,
                                             const std::vector<double>& b);

/// Sign test of the differences a[i] - b[i], exact: those of 0 are left out. The estimate is
/// the median of all of them, with its interval by their order, none below six.
[[nodiscard]] Comparison sign_test(const std::vector<double>& a, const std::vector<double>& b);

/// Whether the mean of the differences is 0, over all signs of them (Fisher 1935): exact up to
/// 20 pairs, beyond by 99,999 arrangements that are drawn, the same ones for the same data.
[[nodiscard]] Comparison permutation_test(const std::vector<double>& a,
                                          const std::vector<double>& b);

/// Whether two groups have the same mean, over all ways to share the values out (Pitman 1937):
/// exact up to 2^20 ways, beyond drawn as above.
[[nodiscard]] Comparison group_permutation_test(const std::vector<double>& a,
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
