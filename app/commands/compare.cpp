#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/fit_json.h"
#include "analysis/report/single_figure.h"
#include "analysis/report/value_figure.h"
#include "analysis/statistics/comparison.h"
#include "analysis/statistics/comparison_data.h"
#include "analysis/statistics/equivalence_test.h"
#include "analysis/statistics/long_table.h"
#include "analysis/statistics/multiplicity.h"
#include "analysis/statistics/omnibus_test.h"
#include "analysis/statistics/pairwise_tests.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/commands/comparison_words.h"
#include "app/commands/fit_figures.h"
#include "app/curves/fit_words.h"
#include "core/error.h"

namespace jnd::app {
namespace {

using analysis::Comparison;
using analysis::FitStatus;
using Json = nlohmann::ordered_json;

struct CompareOptions {
  std::string csv, test;
  std::vector<std::string> group_by;
  /// Columns of the long format, with one value in each row; "" for the columns a and b.
  std::string value, by, pair;
  std::vector<std::string> levels;
  std::optional<double> margin, margin_ratio;
  std::string figure;     ///< "" for none.
  bool pairwise = false;  ///< Whether every pair of conditions is tested as well.
  bool json = false;
};

bool is_paired(const std::string& test) {
  return test != "welch" && test != "ranksum" && test != "group-permutation";
}

bool is_correlation(const std::string& test) {
  return test == "pearson" || test == "spearman" || test == "kendall";
}

/// True for tests that compare several conditions at once.
bool is_omnibus(const std::string& test) { return test == "anova" || test == "friedman"; }

Comparison compared(const std::string& test, const analysis::ComparedColumns& columns) {
  const std::vector<double>&a = columns.a, &b = columns.b;
  if (test == "welch") return analysis::welch_t_test(a, b);
  if (test == "pearson") return analysis::pearson_correlation(a, b);
  if (test == "wilcoxon") return analysis::wilcoxon_test(a, b);
  if (test == "ranksum") return analysis::rank_sum_test(a, b);
  if (test == "spearman") return analysis::spearman_correlation(a, b);
  if (test == "kendall") return analysis::kendall_correlation(a, b);
  if (test == "sign") return analysis::sign_test(a, b);
  if (test == "permutation") return analysis::permutation_test(a, b);
  if (test == "group-permutation") return analysis::group_permutation_test(a, b);
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

/// Prints what was left out of a group in long format, or averaged.
void print_rows(const analysis::LongGroup& group) {
  if (!group.incomplete.empty()) {
    fmt::print("  left out, for they lack a condition: {}\n",
               fmt::join(group.incomplete, ", "));
  }
  if (group.num_averaged > 0) {
    fmt::print("  {} with several values of one person and condition: their mean counts\n",
               group.num_averaged);
  }
}

void print_missing(const analysis::LongTable& table) {
  if (table.num_missing == 0) return;
  fmt::print("rows left out, for a cell is empty or NA: {}\n", table.num_missing);
}

/// The groups of a table with their tests, and the p values adjusted for the number of tests.
struct Tests {
  std::vector<analysis::ComparedColumns> columns;
  std::vector<Comparison> results;
  std::vector<std::optional<double>> p_values_holm;
  std::vector<analysis::EquivalenceTest> equivalences;  ///< Computed if a margin is given.
  /// Its groups are those above; it has none if the table has columns a and b.
  analysis::LongTable long_table;
};

analysis::LongColumns long_columns(const CompareOptions& options) {
  return {.value = options.value,
          .by = options.by,
          .pair = options.pair,
          .group_by = options.group_by,
          .levels = options.levels};
}

/// Throws `UsageError` if the options of the long format do not fit the test.
void require_long_format(const CompareOptions& options) {
  const bool needs_pair = is_paired(options.test);
  if (options.pairwise && !is_omnibus(options.test)) {
    throw UsageError("--pairwise: expected --test anova or friedman, found --test " +
                     options.test + "; it compares two conditions already");
  }
  if (options.value.empty() != options.by.empty()) {
    throw UsageError(
        "--value and --by: expected both or neither, found one; --value names the "
        "column of numbers, --by that of conditions");
  }
  if (options.value.empty()) {
    if (is_omnibus(options.test)) {
      throw UsageError("--test " + options.test +
                       ": expected a table in long format, found no --value; say --value "
                       "COLUMN --by COLUMN --pair COLUMN");
    }
    if (!options.pair.empty() || !options.levels.empty()) {
      throw UsageError("--pair and --levels: expected --value and --by with them, found none");
    }
  } else if (needs_pair == options.pair.empty()) {
    throw UsageError("--pair: expected " +
                     std::string(needs_pair ? "the column that says whose a value is"
                                            : "none, for the groups are of different people") +
                     " with --test " + options.test + ", found " +
                     (needs_pair ? "none" : options.pair));
  }
}

/// Throws `core::Error` if the table has problems.
Tests tests_of(const CompareOptions& options) {
  Tests tests;
  if (options.value.empty()) {
    tests.columns = analysis::read_compared(analysis::CsvTable::read(options.csv),
                                            options.group_by, is_paired(options.test));
  } else {
    tests.long_table = analysis::read_long(options.csv, long_columns(options));
    for (const analysis::LongGroup& group : tests.long_table.groups) {
      tests.columns.push_back(
          analysis::two_conditions(group, is_paired(options.test), options.csv));
    }
  }
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

void add_rows(Json& json, const analysis::LongTable& table, std::size_t i) {
  const analysis::LongGroup& group = table.groups[i];
  json["conditions"] = group.conditions;
  json["incomplete"] = group.incomplete;
  json["num_averaged"] = group.num_averaged;
  json["num_missing"] = table.num_missing;
}

Json to_json(const Tests& tests, std::size_t i) {
  Json json = analysis::to_json(tests.results[i]);
  if (!tests.equivalences.empty()) {
    json["equivalence"] = analysis::to_json(tests.equivalences[i]);
  }
  if (!tests.long_table.groups.empty()) add_rows(json, tests.long_table, i);
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

std::string group_heading(const std::vector<std::pair<std::string, std::string>>& key) {
  std::string heading;
  for (const auto& [column, value] : key) {
    heading += (heading.empty() ? "" : ", ") + column + " " + group_words(value);
  }
  return heading;
}

void print_group(const std::vector<std::pair<std::string, std::string>>& key) {
  const std::string heading = group_heading(key);
  if (!heading.empty()) fmt::print("{}\n", heading);
}

/// The name of the numbers in a figure.
std::string value_name(const CompareOptions& options) {
  return options.value.empty() ? "Value" : options.value;
}

void draw(const CompareOptions& options, const Tests& tests) {
  if (options.figure.empty()) return;
  std::vector<analysis::ComparedValues> groups;
  for (std::size_t i = 0; i < tests.columns.size(); ++i) {
    const analysis::ComparedColumns& columns = tests.columns[i];
    groups.push_back({.name = group_heading(columns.key),
                      .conditions = {"a", "b"},
                      .values = {columns.a, columns.b},
                      .are_paired = is_paired(options.test)});
    if (!tests.long_table.groups.empty()) {
      groups.back().conditions = tests.long_table.groups[i].conditions;
    }
  }
  analysis::write_single_figure(
      is_correlation(options.test)
          ? analysis::scatter_figure(groups, /*has_line=*/options.test == "pearson")
          : analysis::value_figure(groups, value_name(options)),
      options.figure);
}

void draw(const CompareOptions& options, const analysis::LongTable& table) {
  if (options.figure.empty()) return;
  std::vector<analysis::ComparedValues> groups;
  for (const analysis::LongGroup& group : table.groups) {
    std::vector<std::vector<double>> values(group.complete.conditions.size());
    for (const std::vector<double>& person : group.complete.values) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i].push_back(person[i]);
    }
    groups.push_back({.name = group_heading(group.key),
                      .conditions = group.complete.conditions,
                      .values = std::move(values),
                      .are_paired = true});
  }
  analysis::write_single_figure(analysis::value_figure(groups, value_name(options)),
                                options.figure);
}

void print_test(const Tests& tests, std::size_t i) {
  print_comparison(tests.results[i]);
  if (!tests.equivalences.empty()) print_equivalence(tests.equivalences[i]);
  if (tests.long_table.groups.empty()) return;
  fmt::print("  a is {}, b is {}\n", tests.long_table.groups[i].conditions[0],
             tests.long_table.groups[i].conditions[1]);
  print_rows(tests.long_table.groups[i]);
}

void print_for_people(const Tests& tests) {
  for (std::size_t i = 0; i < tests.results.size(); ++i) {
    print_group(tests.columns[i].key);
    print_test(tests, i);
    if (tests.p_values_holm[i]) {
      fmt::print("  {:<24} {}\n", "p adjusted by Holm", p_words(tests.p_values_holm[i]));
    }
  }
}

/// Runs a test of several conditions at once for each group.
int run_omnibus(const CompareOptions& options) {
  const analysis::LongTable table = analysis::read_long(options.csv, long_columns(options));
  std::vector<analysis::OmnibusTest> tests;
  std::vector<std::optional<double>> p_values;
  for (const analysis::LongGroup& group : table.groups) {
    tests.push_back(options.test == "anova" ? analysis::repeated_measures_anova(group.complete)
                                            : analysis::friedman_test(group.complete));
    p_values.push_back(tests.back().p_value);
  }
  const std::vector<std::optional<double>> adjusted = analysis::holm_adjusted(p_values);
  Json groups = Json::array();
  for (std::size_t i = 0; i < tests.size(); ++i) {
    std::vector<analysis::PairwiseTest> pairs;
    if (options.pairwise && tests[i].num_people >= 2) {
      pairs = analysis::pairwise_tests(table.groups[i].complete,
                                       options.test == "anova"
                                           ? analysis::PairwiseMethod::kPairedT
                                           : analysis::PairwiseMethod::kWilcoxon);
    }
    if (!options.json) {
      print_group(table.groups[i].key);
      print_omnibus_test(tests[i], table.groups[i].conditions);
      if (!pairs.empty()) print_pairwise_tests(pairs);
      print_rows(table.groups[i]);
      if (tests.size() > 1)
        fmt::print("  {:<24} {}\n", "p adjusted by Holm", p_words(adjusted[i]));
      continue;
    }
    Json json;
    for (const auto& [column, value] : table.groups[i].key) json["group"][column] = value;
    json.update(analysis::to_json(tests[i]));
    if (options.pairwise) json["pairwise"] = analysis::to_json(pairs);
    add_rows(json, table, i);
    if (tests.size() > 1)
      json["p_value_holm"] = adjusted[i] ? Json(*adjusted[i]) : Json(nullptr);
    groups.push_back(std::move(json));
  }
  if (options.json) {
    fmt::print("{}\n", json_text(options.group_by.empty() && !groups.empty()
                                     ? groups[0]
                                     : Json{{"groups", std::move(groups)}}));
  }
  if (!options.json) print_missing(table);
  draw(options, table);
  const auto lacking = std::ranges::find_if(
      tests, [](const analysis::OmnibusTest& one) { return one.status != FitStatus::kOk; });
  if (lacking == tests.end() && !tests.empty()) return kDone;
  fmt::print(stderr, "jnd: {}: expected values that can be compared, found {}\n", options.csv,
             tests.empty() ? "no rows" : lacking->reason);
  return kHasProblems;
}

int run_compare(const CompareOptions& options) {
  require_long_format(options);
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
  if (is_omnibus(options.test)) return run_omnibus(options);
  const Tests tests = tests_of(options);
  if (options.json) {
    fmt::print("{}\n",
               json_text(options.group_by.empty() ? to_json(tests, 0) : to_json(tests)));
  } else if (options.group_by.empty()) {
    print_test(tests, 0);
  } else {
    print_for_people(tests);
  }
  if (!options.json) print_missing(tests.long_table);
  if (tests.results.empty()) {
    fmt::print(stderr, "jnd: {}: expected rows below the header, found none\n", options.csv);
    return kHasProblems;
  }
  draw(options, tests);
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

HelpPlace place_of_compare() { return {HelpGroup::kOtherData, 20}; }

void add_compare(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App& compare = *program.add_subcommand("compare", "Compare two columns of a table");
  invocation.examples[&compare] = {
      {"jnd compare --csv pairs.csv --test paired", "columns a and b, a row for each person"}};
  compare
      .add_option("--csv", options->csv,
                  "table with the columns a,b, or in long format, one value a row (--value)")
      ->required();
  compare
      .add_option(
          "--test", options->test,
          "paired, welch, pearson or wilcoxon; also ranksum (two groups, by ranks), spearman, "
          "kendall (tau b), sign, permutation (mean of differences, over all signs), "
          "group-permutation (difference of means, over all groupings); of several conditions "
          "in "
          "long format anova (of repeated measures) and friedman. p values of ranks are exact, "
          "with ties, too: up to 50 differences "
          "other than 0 or 50 values in both groups, 14 pairs of spearman; two-sided is "
          "twice the smaller tail, at most 1")
      ->required()
      ->check(CLI::IsMember({"paired", "welch", "pearson", "wilcoxon", "ranksum", "spearman",
                             "kendall", "sign", "permutation", "group-permutation", "anova",
                             "friedman"}));
  compare
      .add_option("--group-by", options->group_by,
                  "columns; one test for each of their values, p adjusted by Holm")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
  compare
      .add_option("--value", options->value,
                  "long format: the column of numbers; cells that are empty or NA are left out")
      ->option_text("COLUMN");
  compare
      .add_option("--by", options->by,
                  "long format: the column of conditions; the first is a, the second b")
      ->option_text("COLUMN");
  compare
      .add_option("--pair", options->pair,
                  "long format: the column that says whose a value is; several values of one "
                  "person and condition are averaged, who lacks a condition is left out")
      ->option_text("COLUMN");
  compare
      .add_option("--levels", options->levels,
                  "long format: the conditions to compare, in this order")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("A,B[,..]");
  compare.add_flag("--pairwise", options->pairwise,
                   "with anova or friedman: also test every pair of conditions, by paired t or "
                   "Wilcoxon's signed ranks, p adjusted by Holm over the pairs");
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
  add_figure_option(compare, options->figure);
  compare.add_flag("--json", options->json, "print one JSON document");
  compare.callback(
      [&invocation, options] { invocation.run = [options] { return run_compare(*options); }; });
}

}  // namespace jnd::app
