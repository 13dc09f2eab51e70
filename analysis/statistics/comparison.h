#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The outcome of a test, with the words of the JSON output. An undefined value is absent, and
/// `status` is then kDegenerate. It is never replaced by 0 or NaN.
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
    /// The dispersion of people's standardised values, which should vary only by chance.
    kDispersion
  };

  FitStatus status = FitStatus::kNotRun;
  Kind kind = Kind::kPaired;
  std::string reason;  ///< Why a value is undefined; "" if all are defined.
  std::string method;  ///< The test in words, with its approximation if there is one.
  /// The mean of a - b (also in rank tests, which test `hodges_lehmann`), the mean of the
  /// values, or the correlation. For a dispersion it is the mean square.
  std::optional<double> estimate;
  Interval ci95;  ///< The 95 % interval of the estimate.
  std::optional<double> statistic;
  /// "t" for most tests. Wilcoxon has "T", the smaller sum of ranks. The rank sum test has "U"
  /// of a, which R calls W. Spearman has "S" as in R, (n^3 - n) (1 - r) / 6, which is the sum
  /// of squared rank differences if there are no ties.
  std::string statistic_name = "t";
  /// Wilcoxon has "V", the sum of the ranks with a > b. Spearman has t if p is computed from
  /// it.
  std::vector<std::pair<std::string, double>> other_statistics;
  /// The other statistics and then `statistic`, which JSON lists as `statistics`.
  [[nodiscard]] std::vector<std::pair<std::string, double>> all_statistics() const;
  std::optional<double> degrees_of_freedom;
  std::optional<double> p_value;  ///< Two-sided.
  /// For pairs: the mean difference divided by its standard deviation.
  std::optional<double> cohen_dz;
  /// The interval uses the noncentral t, as does that of Hedges' g.
  Interval cohen_dz_ci95;
  /// The difference of means divided by the standard deviation, without bias (Hedges 1981). For
  /// pairs and one sample it is the standard deviation of the differences. For two groups it is
  /// the root of the mean of their variances.
  std::optional<double> hedges_g;
  Interval hedges_g_ci95;
  /// Wilcoxon and rank sum test: how much more weight a > b has than a < b, from -1 to 1 (Kerby
  /// 2014). It has no interval. An interval by Fisher's z, with the standard error under no
  /// effect, would contradict the exact test and would not exist at -1 and 1.
  std::optional<double> rank_biserial;
  /// Wilcoxon: the median of all pairwise means of the differences other than 0. Rank sum test:
  /// the median of all differences a - b (Hodges and Lehmann 1963). The interval is
  /// distribution-free.
  std::optional<double> hodges_lehmann;
  Interval hodges_lehmann_ci95;
  int num_a = 0, num_b = 0;  ///< The number of values used.
  /// Wilcoxon: the number of pairs with a difference of 0, which are left out.
  int num_zeros = 0;
  /// For a model: whether no participant has answers on both sides.
  bool of_other_people = false;
};

/// Whether to compute effect sizes. Their intervals take nearly all of a test's time.
enum class EffectSizes { kComputed, kLeftOut };

/// Student's t test of the differences a[i] - b[i]. Like all tests in this file it throws
/// `core::Error` if a value is not finite, and tests of pairs throw if the lengths differ.
[[nodiscard]] Comparison paired_t_test(const std::vector<double>& a,
                                       const std::vector<double>& b,
                                       EffectSizes effects = EffectSizes::kComputed);

/// Welch's t test (1947) for unequal variances, with the degrees of freedom of Welch and
/// Satterthwaite.
[[nodiscard]] Comparison welch_t_test(const std::vector<double>& a,
                                      const std::vector<double>& b,
                                      EffectSizes effects = EffectSizes::kComputed);

/// Pearson's correlation. p comes from t with n - 2 degrees of freedom, and the interval from
/// Fisher's z (1921).
[[nodiscard]] Comparison pearson_correlation(const std::vector<double>& a,
                                             const std::vector<double>& b);

/// Wilcoxon's signed-rank test (1945). Differences of 0 are left out, as in R's wilcox.test and
/// SciPy's `zero_method="wilcox"`. Differences that are equal except for the rounding of a
/// subtraction are tied. Up to 50 other differences, tied or not, the distribution is exact
/// over all signs of the ranks. For more it is normal, with the variance corrected for ties and
/// a continuity correction. The two-sided p is twice the smaller tail, at most 1. `method` says
/// which distribution was used.
[[nodiscard]] Comparison wilcoxon_test(const std::vector<double>& a,
                                       const std::vector<double>& b);

/// Student's t test of one sample against 0.
[[nodiscard]] Comparison one_sample_t_test(const std::vector<double>& values);

/// Wilcoxon's rank sum test (1945), with Mann and Whitney's U of a (1947). Up to 50 values in
/// all, tied or not, the distribution is exact over all ways to divide the ranks. For more it
/// is normal, with the variance corrected for ties and a continuity correction. The two-sided p
/// is twice the smaller tail, at most 1 (with ties the tails may differ). `method` says which
/// distribution was used.
[[nodiscard]] Comparison rank_sum_test(const std::vector<double>& a,
                                       const std::vector<double>& b);

/// Spearman's rank correlation with midranks. Its interval uses Fisher's z with the standard
/// error of Bonett and Wright (2000), and does not exist at r = -1 and 1. Up to 14 pairs, tied
/// or not, p is exact over all pairings of the ranks: twice the smaller tail, at most 1 (R's
/// cor.test approximates it from 10 pairs on, Best and Roberts 1975). For more pairs p comes
/// from t with n - 2 degrees of freedom, but stays exact if the ranks agree completely.
/// `method` says which was used.
[[nodiscard]] Comparison spearman_correlation(const std::vector<double>& a,
                                              const std::vector<double>& b);

/// Kendall's tau b (1938, 1945). Up to 50 pairs without ties p is exact over all orders, and
/// the statistic is the number of concordant pairs. Otherwise it is normal, with the variance
/// corrected for ties and, as in R's cor.test, no continuity correction.
[[nodiscard]] Comparison kendall_correlation(const std::vector<double>& a,
                                             const std::vector<double>& b);

/// The exact sign test of the differences a[i] - b[i]. Differences of 0 are left out of the
/// test. The estimate is the median of all differences. Its interval uses order statistics and
/// does not exist for fewer than six.
[[nodiscard]] Comparison sign_test(const std::vector<double>& a, const std::vector<double>& b);

/// Tests whether the mean of the differences is 0, over all arrangements of their signs (Fisher
/// 1935). It is exact up to 20 pairs. For more pairs it draws 99,999 arrangements, which are
/// the same for the same data.
[[nodiscard]] Comparison permutation_test(const std::vector<double>& a,
                                          const std::vector<double>& b);

/// Tests whether two groups have the same mean, over all ways to divide the values (Pitman
/// 1937). It is exact up to 2^20 ways. For more ways it draws arrangements as
/// `permutation_test` does.
[[nodiscard]] Comparison group_permutation_test(const std::vector<double>& a,
                                                const std::vector<double>& b);

/// Student's t test with pooled variance from published means and standard deviations, for
/// comparison with papers that print no raw data. Counts are >= 2, and standard deviations >=
/// 0.
struct PublishedGroup {
  double mean = 0.0;
  double standard_deviation = 0.0;
  int num_values = 0;
};
[[nodiscard]] Comparison pooled_t_test(const PublishedGroup& a, const PublishedGroup& b);

}  // namespace jnd::analysis
