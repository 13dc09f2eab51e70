#include "app/commands/comparison_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/curves/fit_words.h"
#include "app/results/statistic_words.h"

namespace jnd::app {
namespace {

using analysis::Comparison;

std::string defined(const std::optional<double>& value) {
  return value ? number(value) : "undefined";
}

void print_interval(const char* name, const analysis::Interval& interval) {
  if (!interval.low || !interval.high) return;
  fmt::print("  {:<24} {:.4g} to {:.4g}\n", name, *interval.low, *interval.high);
}

void print_effect(const char* name, const std::optional<double>& value,
                  const analysis::Interval& interval) {
  if (!value) return;
  fmt::print("  {:<24} {}\n", name, defined(value));
  print_interval("  95 %", interval);
}

void print_correction(const char* name,
                      const std::optional<analysis::SphericityCorrection>& correction) {
  if (!correction) return;
  fmt::print("  {:<24} {} with epsilon {:.4g}\n", name, p_words(correction->p_value),
             correction->epsilon);
}

}  // namespace

std::string p_words(const std::optional<double>& p_value) {
  return p_value == 0.0 ? "< 1e-300" : defined(p_value);
}

void print_equivalence(const analysis::EquivalenceTest& test) {
  const bool is_ratio = test.margin.scale == analysis::EquivalenceMargin::Scale::kRatio;
  const std::string within = is_ratio ? fmt::format("a over b within {:.4g} to {:.4g}",
                                                    1.0 / test.margin.size, test.margin.size)
                                      : fmt::format("a - b within {:.4g} to {:.4g}",
                                                    -test.margin.size, test.margin.size);
  fmt::print("  equivalence: {} (two one-sided tests)\n", within);
  if (!test.p_value) {
    fmt::print("    {}\n", test.reason);
    return;
  }
  fmt::print("    {:<22} {}\n", is_ratio ? "ratio" : "difference", defined(test.estimate));
  fmt::print("    {:<22} {:.4g} to {:.4g}\n", "90 %", *test.ci90.low, *test.ci90.high);
  fmt::print("    {:<22} {}\n", "degrees of freedom", defined(test.degrees_of_freedom));
  fmt::print(
      "    {:<22} {}, {}\n", "p", p_words(test.p_value),
      test.is_equivalent() ? "so they are the same within that" : "so that is not shown");
}

void print_comparison(const analysis::Comparison& result) {
  using Kind = Comparison::Kind;
  const bool correlation = result.kind == Kind::kPearson || result.kind == Kind::kSpearman ||
                           result.kind == Kind::kKendall;
  const bool are_groups = result.kind == Kind::kWelch || result.kind == Kind::kRankSum ||
                          result.kind == Kind::kGroupPermutation;
  fmt::print("{}, {} and {} values\n", result.method, result.num_a, result.num_b);
  if (!result.reason.empty()) fmt::print("  {}\n", result.reason);
  const char* estimate = result.kind == Kind::kKendall ? "tau"
                         : correlation                 ? "r"
                         : result.kind == Kind::kSign  ? "median of a - b"
                         : are_groups                  ? "mean of a - mean of b"
                                                       : "mean of a - b";
  fmt::print("  {:<24} {}\n", estimate, defined(result.estimate));
  print_interval("  95 %", result.ci95);
  print_effect("Hodges-Lehmann", result.hodges_lehmann, result.hodges_lehmann_ci95);
  if (result.hodges_lehmann && result.num_zeros > 0) {
    fmt::print("    of the differences other than 0 alone, as the test\n");
  }
  if (result.kind == Kind::kSign && result.num_zeros > 0) {
    fmt::print(
        "    of all differences, of which {} are 0; p leaves those out, so that it can be "
        "small "
        "where the interval holds 0\n",
        result.num_zeros);
  }
  if (result.status != analysis::FitStatus::kOk) return;
  for (const auto& [name, value] : result.all_statistics()) {
    fmt::print("  {:<24} {}\n", statistic_title(name), defined(value));
  }
  if (result.degrees_of_freedom) {
    fmt::print("  {:<24} {}\n", "degrees of freedom", defined(result.degrees_of_freedom));
  }
  fmt::print("  {:<24} {}\n", "p, two-sided", p_words(result.p_value));
  print_effect("Cohen's dz", result.cohen_dz, result.cohen_dz_ci95);
  print_effect("Hedges' g", result.hedges_g, result.hedges_g_ci95);
  print_effect("rank-biserial r", result.rank_biserial, {});
}

void print_omnibus_test(const analysis::OmnibusTest& test,
                        const std::vector<std::string>& conditions) {
  fmt::print("{}, {} people under {} conditions ({})\n", test.method, test.num_people,
             test.num_conditions, fmt::join(conditions, ", "));
  if (test.status != analysis::FitStatus::kOk) {
    fmt::print("  {}\n", test.reason);
    return;
  }
  const bool is_f = test.error_degrees_of_freedom.has_value();
  fmt::print("  {:<24} {}\n", is_f ? "F" : "chi squared", defined(test.statistic));
  fmt::print("  {:<24} {}{}\n", "degrees of freedom", defined(test.degrees_of_freedom),
             is_f ? " and " + defined(test.error_degrees_of_freedom) : "");
  fmt::print("  {:<24} {}\n", "p", p_words(test.p_value));
  if (test.mauchly) {
    fmt::print("  {:<24} {:.4g}, p {}\n", "Mauchly's W (sphericity)", test.mauchly->w,
               p_words(test.mauchly->p_value));
  }
  print_correction("p, Greenhouse-Geisser", test.greenhouse_geisser);
  print_correction("p, Huynh-Feldt", test.huynh_feldt);
  print_effect("partial eta squared", test.partial_eta_squared, {});
  print_effect("generalized eta squared", test.generalized_eta_squared, {});
  print_effect("Kendall's W", test.concordance, {});
}

void print_pairwise_tests(const std::vector<analysis::PairwiseTest>& tests) {
  std::size_t width = 0;
  for (const analysis::PairwiseTest& test : tests) {
    width = std::max(width, test.a.size() + test.b.size() + 3);
  }
  fmt::print("  pairs of conditions by {}, p adjusted by Holm over {} pairs\n",
             tests.front().comparison.method, tests.size());
  for (const analysis::PairwiseTest& test : tests) {
    const Comparison& comparison = test.comparison;
    const analysis::Interval& ci95 = comparison.ci95;
    fmt::print("    {:<{}}  ", test.a + " - " + test.b, width);
    if (!comparison.p_value) {
      fmt::print("{}\n", comparison.reason);
      continue;
    }
    fmt::print("{}", defined(comparison.estimate));
    if (ci95.low && ci95.high) fmt::print(" [{:.4g}, {:.4g}]", *ci95.low, *ci95.high);
    fmt::print("  {}  p {}  adjusted {}\n", statistic_words(comparison),
               p_words(comparison.p_value), p_words(test.p_value_holm));
  }
}

}  // namespace jnd::app
