#include "analysis/report/test_methods.h"
#include "analysis/words/said.h"

#include <algorithm>

namespace jnd::analysis {
namespace {

using Kind = Comparison::Kind;

class Tests {
 public:
  Tests(const std::vector<const NamedComparison*>& comparisons,
        const std::function<std::string(const std::string&)>& cite)
      : comparisons_(comparisons), cite_(cite) {}

  [[nodiscard]] std::string t_tests() const {
    std::string names;
    const auto also = [&names](const std::string& test) {
      names += (names.empty() ? "" : ", ") + test;
    };
    // The hierarchical tests are left out, because they have words of their own.
    const bool any_paired = any([](const NamedComparison& one) {
      return one.comparison.method.starts_with("paired t");
    });
    if (any_paired) also(said("paired"));
    if (has(Kind::kOneSample)) also(said("of one sample against 0"));
    if (has(Kind::kWelch))
      also(said("Welch’s for unequal variances ({})", cite_("Welch 1947")));
    if (has(Kind::kPooled)) also(said("with pooled variance, as Schmidt (2018) has them"));
    return names.empty() ? "" : said(" t tests: {}; the statistic is t.", names);
  }

  [[nodiscard]] std::string rank_tests() const {
    std::string text;
    if (has(Kind::kWilcoxon)) {
      text += said(
          " Wilcoxon’s signed ranks ({}): V is the sum of the ranks of differences above 0, T "
          "the smaller sum of ranks; differences of 0 are left out before ranking.",
          cite_("Wilcoxon 1945"));
    }
    if (has(Kind::kRankSum)) {
      text += said(" Rank sums ({}): U is that of the group named first.",
                   cite_("Mann and Whitney 1947"));
    }
    if (!text.empty()) {
      text += said(
          " Both are exact up to 50 ranks, with ties, too, by counting all arrangements of the "
          "midranks ({}); beyond, normal with the variance corrected for ties and with "
          "continuity correction. As difference they give the estimate of Hodges and Lehmann "
          "({}) with its distribution-free interval, which with ties holds at least as often "
          "as it says ({}).",
          cite_("Streitberg and Röhmel 1986"), cite_("Hodges and Lehmann 1963"),
          cite_("Noether 1967"));
    }
    if (has(Kind::kSpearman)) {
      text += said(
          " Spearman’s correlation: p is exact over all pairings of the ranks up to 14 pairs, "
          "beyond by t; S = (n³ − n)(1 − r) / 6, for ranks without ties the sum of their "
          "squared differences; the interval is that of {}.",
          cite_("Bonett and Wright 2000"));
    }
    if (!text.empty()) {
      text += said(" A two-sided p value of ranks is twice the smaller tail, at most 1.");
    }
    return text;
  }

  [[nodiscard]] std::string others() const {
    std::string text;
    if (has(Kind::kPearson)) {
      text += said(" Pearson’s correlation has Fisher’s z interval ({}) and a t test.",
                   cite_("Fisher 1921"));
    }
    return text;
  }

  [[nodiscard]] std::string adjustment() const {
    const bool adjusted =
        any([](const NamedComparison& one) { return one.p_value_holm.has_value(); });
    return adjusted ? said(
                          " p values adjusted by Holm ({}) have a column of their own, each "
                          "for the family named in brackets; all others are not adjusted.",
                          cite_("Holm 1979"))
                    : said(" No p value is adjusted for their number.");
  }

  [[nodiscard]] std::string effects() const {
    std::string text;
    const bool d_z =
        any([](const NamedComparison& one) { return one.comparison.cohen_dz.has_value(); });
    const bool g = any([](const NamedComparison& one) {
      const Comparison& c = one.comparison;
      return c.hedges_g && (c.kind == Kind::kWelch || c.kind == Kind::kPooled);
    });
    const bool r_rb = any(
        [](const NamedComparison& one) { return one.comparison.rank_biserial.has_value(); });
    if (d_z) {
      text +=
          said(" d_z is the mean difference over the standard deviation of the differences.");
    }
    if (g) {
      text += said(
          " g is the difference of two means over the root of the mean of their variances, "
          "without its bias ({}; {}).",
          cite_("Hedges 1981"), cite_("Delacre et al. 2021"));
    }
    if (d_z || g) {
      text += said(" Their intervals are by the noncentral t ({}).",
                   cite_("Steiger and Fouladi 1997"));
    }
    if (r_rb) {
      text += said(
          " r_rb is the rank-biserial correlation ({}): the share of ranks or pairs for a > b "
          "minus that for a < b.",
          cite_("Kerby 2014"));
    }
    return text.empty() ? "" : text.substr(1);
  }

 private:
  template <typename Predicate>
  [[nodiscard]] bool any(const Predicate& predicate) const {
    return std::ranges::any_of(comparisons_,
                               [&](const NamedComparison* named) { return predicate(*named); });
  }
  [[nodiscard]] bool has(Kind kind) const {
    return any([kind](const NamedComparison& one) { return one.comparison.kind == kind; });
  }

  const std::vector<const NamedComparison*>& comparisons_;
  const std::function<std::string(const std::string&)>& cite_;
};

}  // namespace

void add_test_methods(const std::vector<const NamedComparison*>& comparisons, bool compares,
                      const std::function<std::string(const std::string&)>& cite,
                      const std::function<void(const std::string&, const std::string&)>& add) {
  if (comparisons.empty()) return;
  const Tests tests(comparisons, cite);
  std::string text = said("All p values are two-sided.{}{}{}{}", tests.t_tests(),
                          tests.rank_tests(), tests.others(), tests.adjustment());
  if (compares) {
    text += said(
        " “Becomes more frequent over the trials”: of each participant the covariance of "
        "answer and running number, summed over levels, over its standard deviation were every "
        "order within a level equally likely; exploratory. The mean of these z tells what "
        "people share; “each in their own way”: their sum of squares, which is about the "
        "number of participants if nobody changes, beside that of answers drawn anew at the "
        "same levels from everybody’s own curve, p = (1 + redraws with at least this sum) / "
        "(redraws + 1). Neither is made where the answers led to the levels.");
  }
  add(said("Tests"), text);
  add(said("Effect sizes"), tests.effects());
}

}  // namespace jnd::analysis
