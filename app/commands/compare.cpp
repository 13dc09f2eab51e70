#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "analysis/csv_table.h"
#include "analysis/fits/fit_json.h"
#include "analysis/groups/comparison.h"
#include "app/commands/commands.h"
#include "app/json_text.h"

namespace jnd::app {
namespace {

using analysis::Comparison;

struct Options {
  std::string csv, test;
  bool json = false;
};

/// Both columns as the test needs them: pairs, or for Welch two columns of their own lengths.
/// Throws `core::Error` where the table has problems.
Comparison compared(const Options& options) {
  const analysis::CsvTable table = analysis::CsvTable::read(options.csv);
  analysis::CsvReader reader(table);
  const bool welch = options.test == "welch";
  const std::vector<double> a = welch ? reader.numbers_until_empty("a") : reader.numbers("a");
  const std::vector<double> b = welch ? reader.numbers_until_empty("b") : reader.numbers("b");
  reader.throw_problems();
  if (welch) return analysis::welch_t_test(a, b);
  if (options.test == "pearson") return analysis::pearson_correlation(a, b);
  if (options.test == "wilcoxon") return analysis::wilcoxon_test(a, b);
  return analysis::paired_t_test(a, b);
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "undefined";
}

void print_interval(const char* name, const analysis::Interval& interval) {
  if (!interval.low || !interval.high) return;
  fmt::print("  {:<24} {:.4g} to {:.4g}\n", name, *interval.low, *interval.high);
}

void print_for_people(const Comparison& result) {
  const bool correlation = result.kind == Comparison::Kind::kPearson;
  const bool ranks = result.kind == Comparison::Kind::kWilcoxon;
  fmt::print("{}, {} and {} values\n", result.method, result.num_a, result.num_b);
  if (!result.reason.empty()) fmt::print("  {}\n", result.reason);
  fmt::print("  {:<24} {}\n", correlation ? "r" : "mean of a - b", number(result.estimate));
  print_interval("  95 %", result.ci95);
  if (result.median_difference) {
    fmt::print("  {:<24} {}\n", "median of a - b", number(result.median_difference));
    print_interval("  95 %", result.median_difference_ci95);
  }
  if (result.status != analysis::FitStatus::kOk) return;
  fmt::print("  {:<24} {}\n", ranks ? "smaller sum of ranks" : "t", number(result.statistic));
  if (result.degrees_of_freedom) {
    fmt::print("  {:<24} {}\n", "degrees of freedom", number(result.degrees_of_freedom));
  }
  fmt::print("  {:<24} {}\n", "p, two-sided", number(result.p_value));
  if (result.cohen_dz) fmt::print("  {:<24} {}\n", "Cohen's dz", number(result.cohen_dz));
}

}  // namespace

void add_compare(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App& compare = *program.add_subcommand("compare", "Compare two columns of a table");
  compare.add_option("--csv", options->csv, "table with the columns a,b")->required();
  compare.add_option("--test", options->test, "paired, welch, pearson or wilcoxon")
      ->required()
      ->check(CLI::IsMember({"paired", "welch", "pearson", "wilcoxon"}));
  compare.add_flag("--json", options->json, "print one JSON document");
  compare.callback([&invocation, options] {
    invocation.run = [options] {
      const Comparison result = compared(*options);
      if (options->json) {
        fmt::print("{}\n", json_text(analysis::to_json(result)));
      } else {
        print_for_people(result);
      }
      if (result.status == analysis::FitStatus::kOk) return kDone;
      fmt::print(stderr, "jnd: {}: expected columns that can be compared, found: {}\n",
                 options->csv, result.reason);
      return kHasProblems;
    };
  });
}

}  // namespace jnd::app
