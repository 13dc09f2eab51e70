#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/fit_json.h"
#include "analysis/statistics/comparison.h"
#include "analysis/statistics/comparison_data.h"
#include "analysis/statistics/equivalence_test.h"
#include "analysis/statistics/multiplicity.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/commands/fit_words.h"
#include "app/results/statistic_words.h"
#include "core/error.h"

namespace jnd::app {
namespace {

using analysis::Comparison;
using analysis::FitStatus;
using Json = nlohmann::ordered_json;

struct CompareOptions {
  std::string csv, test;
  std::vector<std::string> group_by;
  std::optional<double> margin, margin_ratio;
  bool json = false;
};

bool is_paired(const std::string& test) { return test != "welch" && test != "ranksum"; }

Comparison compared(const std::string& test, const analysis::ComparedColumns& columns) {
  const std::vector<double>&a = columns.a, &b = columns.b;
  if (test == "welch") return analysis::welch_t_test(a, b);
  if (test == "pearson") return analysis::pearson_correlation(a, b);
  if (test == "wilcoxon") return analysis::wilcoxon_test(a, b);
  if (test == "ranksum") return analysis::rank_sum_test(a, b);
  if (test == "spearman") return analysis::spearman_correlation(a, b);
  return analysis::paired_t_test(a, b);
}

std::optional<analysis::EquivalenceMargin> margin_of(const CompareOptions& options) {
  using Scale = analysis::EquivalenceMargin::Scale;
  if (!options.margin && !options.margin_ratio) return std::nullopt;
  if (options.test != "paired" && options.test != "welch") {
    throw core::Error(
        "--equivalence-margin and --equivalence-ratio: expected --test paired or "
        "welch, found " +
        options.test + "; no other test is one of means");
  }
  if (options.margin_ratio) {
    return analysis::EquivalenceMargin{Scale::kRatio, *options.margin_ratio};
  }
  return analysis::EquivalenceMargin{Scale::kDifference, *options.margin};
}

std::string defined(const std::optional<double>& value) {
  return value ? number(value) : "undefined";
}

/// A p value may be less than any number there is.
std::string p_words(const std::optional<double>& p_value) {
  return p_value == 0.0 ? "< 1e-300" : defined(p_value);
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

void print_for_people(const analysis::EquivalenceTest& test) {
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

void print_for_people(const Comparison& result) {
  using Kind = Comparison::Kind;
  const bool correlation = result.kind == Kind::kPearson || result.kind == Kind::kSpearman;
  fmt::print("{}, {} and {} values\n", result.method, result.num_a, result.num_b);
  if (!result.reason.empty()) fmt::print("  {}\n", result.reason);
  const char* difference = result.kind == Kind::kWelch || result.kind == Kind::kRankSum
                               ? "mean of a - mean of b"
                               : "mean of a - b";
  fmt::print("  {:<24} {}\n", correlation ? "r" : difference, defined(result.estimate));
  print_interval("  95 %", result.ci95);
  print_effect("Hodges-Lehmann", result.hodges_lehmann, result.hodges_lehmann_ci95);
  if (result.hodges_lehmann && result.num_zeros > 0) {
    fmt::print("    of the differences other than 0 alone, as the test\n");
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

/// The groups of a table with their tests, and the p values adjusted for there being several.
struct Tests {
  std::vector<analysis::ComparedColumns> columns;
  std::vector<Comparison> results;
  std::vector<std::optional<double>> p_values_holm;
  std::vector<analysis::EquivalenceTest> equivalences;  ///< Where a margin is given.
};

/// Throws `core::Error` where the table has problems.
Tests tests_of(const CompareOptions& options) {
  Tests tests{.columns = analysis::read_compared(analysis::CsvTable::read(options.csv),
                                                 options.group_by, is_paired(options.test))};
  std::vector<std::optional<double>> p_values;
  const std::optional<analysis::EquivalenceMargin> margin = margin_of(options);
  for (const analysis::ComparedColumns& columns : tests.columns) {
    tests.results.push_back(compared(options.test, columns));
    p_values.push_back(tests.results.back().p_value);
    if (margin) {
      tests.equivalences.push_back(
          analysis::equivalence_test(columns.a, columns.b, is_paired(options.test), *margin));
    }
  }
  tests.p_values_holm = analysis::holm_adjusted(p_values);
  return tests;
}

Json to_json(const Tests& tests, std::size_t i) {
  Json json = analysis::to_json(tests.results[i]);
  if (!tests.equivalences.empty()) {
    json["equivalence"] = analysis::to_json(tests.equivalences[i]);
  }
  return json;
}

Json to_json(const Tests& tests) {
  Json groups = Json::array();
  for (std::size_t i = 0; i < tests.results.size(); ++i) {
    Json json;
    for (const auto& [column, value] : tests.columns[i].key) json["group"][column] = value;
    json.update(to_json(tests, i));
    const std::optional<double>& p_value = tests.p_values_holm[i];
    json["p_value_holm"] = p_value ? Json(*p_value) : Json(nullptr);
    groups.push_back(std::move(json));
  }
  return {{"groups", std::move(groups)}};
}

void print_for_people(const Tests& tests) {
  for (std::size_t i = 0; i < tests.results.size(); ++i) {
    std::string heading;
    for (const auto& [column, value] : tests.columns[i].key) {
      heading += (heading.empty() ? "" : ", ") + column + " " + group_words(value);
    }
    fmt::print("{}\n", heading);
    print_for_people(tests.results[i]);
    if (!tests.equivalences.empty()) print_for_people(tests.equivalences[i]);
    if (tests.p_values_holm[i]) {
      fmt::print("  {:<24} {}\n", "p adjusted by Holm", p_words(tests.p_values_holm[i]));
    }
  }
}

int run_compare(const CompareOptions& options) {
  const Tests tests = tests_of(options);
  if (options.json) {
    fmt::print("{}\n",
               json_text(options.group_by.empty() ? to_json(tests, 0) : to_json(tests)));
  } else if (options.group_by.empty()) {
    print_for_people(tests.results[0]);
    if (!tests.equivalences.empty()) print_for_people(tests.equivalences[0]);
  } else {
    print_for_people(tests);
  }
  if (tests.results.empty()) {
    fmt::print(stderr, "jnd: {}: expected rows below the header, found none\n", options.csv);
    return kHasProblems;
  }
  const auto lacks = [](const Comparison& one) { return one.status != FitStatus::kOk; };
  const auto first = std::ranges::find_if(tests.results, lacks);
  if (first == tests.results.end()) return kDone;
  if (tests.results.size() == 1) {
    fmt::print(stderr, "jnd: {}: expected columns that can be compared, found: {}\n",
               options.csv, first->reason);
  } else {
    fmt::print(
        stderr,
        "jnd: {}: expected columns that can be compared in every group, found none in {} "
        "of {}: {}\n",
        options.csv, std::ranges::count_if(tests.results, lacks), tests.results.size(),
        first->reason);
  }
  return kHasProblems;
}

}  // namespace

void add_compare(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App& compare = *program.add_subcommand("compare", "Compare two columns of a table");
  compare.add_option("--csv", options->csv, "table with the columns a,b")->required();
  compare
      .add_option(
          "--test", options->test,
          "paired, welch, pearson or wilcoxon; also ranksum (two groups, by ranks) and "
          "spearman. p values of ranks are exact, with ties, too: up to 50 differences "
          "other than 0 or 50 values in both groups, 14 pairs of spearman; two-sided is "
          "twice the smaller tail, at most 1")
      ->required()
      ->check(CLI::IsMember({"paired", "welch", "pearson", "wilcoxon", "ranksum", "spearman"}));
  compare
      .add_option("--group-by", options->group_by,
                  "columns; one test for each of their values, p adjusted by Holm")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
  CLI::Option* const difference =
      compare
          .add_option(
              "--equivalence-margin", options->margin,
              "with paired or welch: also test whether a - b lies within -X to X, by two "
              "one-sided tests at 5 %")
          ->check(CLI::PositiveNumber)
          ->option_text("X");
  compare
      .add_option("--equivalence-ratio", options->margin_ratio,
                  "with paired or welch: also test whether a over b lies within 1 / R to R, by "
                  "the logarithms; R > 1")
      ->check(CLI::Range(1.001, 1e6))
      ->excludes(difference)
      ->option_text("R");
  compare.add_flag("--json", options->json, "print one JSON document");
  compare.callback(
      [&invocation, options] { invocation.run = [options] { return run_compare(*options); }; });
}

}  // namespace jnd::app
