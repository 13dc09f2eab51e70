#include "app/commands/fit_group.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/csv_table.h"
#include "analysis/fits/fit_data.h"
#include "analysis/fits/psychometric_json.h"
#include "analysis/groups/hierarchical_data.h"
#include "analysis/groups/hierarchical_json.h"
#include "app/commands/fit_words.h"
#include "app/json_text.h"
#include "app/option_checks.h"

namespace jnd::app {
namespace {

using analysis::FitStatus;

struct Options {
  std::string csv, link = "log-slope", pse = "personal", slopes = "correlated";
  std::vector<std::string> free;
  std::optional<double> reference;
  int num_nodes = 0;
  bool json = false;
};

void require_reference(const Options& options) {
  if (!options.reference) return;
  if (!(*options.reference > 0.0 && std::isfinite(*options.reference))) {
    throw UsageError(
        fmt::format("--reference: expected a number > 0 in the unit of the intensities, found "
                    "{}; the Weber fraction is relative to it",
                    *options.reference));
  }
}

void print_for_people(const analysis::HierarchicalFit& fit) {
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no hierarchical fit: {}\n", fit.reason);
    return;
  }
  fmt::print("  {}; {} participants\n", fit.method, fit.num_participants);
  for (const analysis::HierarchicalCondition& one : fit.conditions) {
    if (!one.condition.empty()) fmt::print("{}\n", one.condition);
    if (!one.weber_fraction) continue;  // The note says why.
    fmt::print("  Weber fraction  {:<8}  95 % {}, of the median person\n",
               number(one.weber_fraction), range(one.weber_fraction_ci95, one.weber_fraction));
    fmt::print(
        "  PSE             {:<8}  {}\n", number(one.pse),
        one.pse_ci95 ? "95 % " + range(*one.pse_ci95, one.pse) : "fixed at the reference");
    fmt::print("  between people  {:<8}  standard deviation of the slope number\n",
               number(one.slope_sd));
    if (one.place_sd > 0.0) {
      fmt::print("  between people  {:<8}  standard deviation of the place number\n",
                 number(one.place_sd));
    }
  }
  if (fit.lapse_rate) {
    fmt::print("  lapse rate      {:<8}  of everybody\n", number(fit.lapse_rate));
  }
  if (fit.correlation) fmt::print("  correlation of the slopes  {}\n", number(fit.correlation));
  for (const analysis::HierarchicalDifference& one : fit.differences) {
    fmt::print("  {} - {}: {}  95 % {}, t({:.0f}) = {}, p = {}\n", one.second, one.first,
               number(one.estimate), range(one.ci95, one.estimate), one.degrees_of_freedom,
               number(one.statistic), number(one.p_value));
  }
  if (!fit.note.empty()) fmt::print("  {}\n", fit.note);
}

int fit_hierarchical(const Options& options) {
  require_reference(options);
  const analysis::HierarchicalFit fit = analysis::fit_hierarchical(
      analysis::read_participant_answers(analysis::CsvTable::read(options.csv),
                                         options.reference),
      {.link = options.link == "linear" ? analysis::HierarchicalLink::kLinear
                                        : analysis::HierarchicalLink::kLogSlope,
       .pse = options.pse == "reference" ? analysis::HierarchicalPse::kReference
              : options.pse == "common"  ? analysis::HierarchicalPse::kCommon
              : options.pse == "shared"  ? analysis::HierarchicalPse::kShared
                                         : analysis::HierarchicalPse::kPersonal,
       .slopes = options.slopes == "shared" ? analysis::HierarchicalSlopes::kShared
                                            : analysis::HierarchicalSlopes::kCorrelated,
       .lapses = options.free.empty() ? analysis::HierarchicalLapses::kNone
                                      : analysis::HierarchicalLapses::kCommon,
       .num_nodes = options.num_nodes});
  if (options.json) {
    fmt::print("{}\n", json_text(analysis::to_json(fit)));
  } else {
    print_for_people(fit);
  }
  if (fit.status == FitStatus::kOk) return kDone;
  fmt::print(stderr, "jnd: {}: expected answers that have a hierarchical fit, found none: {}\n",
             options.csv, fit.reason);
  return kHasProblems;
}

/// The rows with what else the table knows of each.
std::vector<analysis::OrderedAnswers> read_ordered_answers(const analysis::CsvTable& table) {
  std::vector<analysis::OrderedAnswers> rows;
  for (const auto& group : analysis::read_answer_counts(table)) {
    for (const analysis::AnswerCount& row : group.rows) {
      rows.push_back({.intensity = row.intensity,
                      .num_yes = static_cast<double>(row.num_yes),
                      .num_trials = static_cast<double>(row.num_trials)});
    }
  }
  analysis::CsvReader reader(table);
  if (table.find("trial")) {
    const std::vector<double> trials = reader.numbers("trial");
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].trial = trials[row];
  }
  if (table.find("test_first")) {
    const std::vector<double> first = reader.numbers("test_first");
    for (std::size_t row = 0; row < rows.size(); ++row) {
      if (first[row] != 0.0 && first[row] != 1.0 && !std::isnan(first[row])) {
        reader.report(row, "test_first", "0 or 1");
      }
      rows[row].test_first = first[row] == 1.0;
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].intensity == 0.0) reader.report(row, "intensity", "a number > 0");
  }
  reader.throw_problems();
  return rows;
}

int fit_effects(const Options& options) {
  require_reference(options);
  const std::vector<analysis::PsychometricEffect> effects = analysis::psychometric_effects(
      read_ordered_answers(analysis::CsvTable::read(options.csv)), *options.reference);
  std::string reason;
  for (const analysis::PsychometricEffect& one : effects) {
    if (one.status != FitStatus::kOk && reason.empty()) reason = one.reason;
    if (options.json) continue;
    fmt::print("  {:<15} {:<9} 95 % {}, p = {}: {}\n", one.name, number(one.estimate),
               range(one.ci95, one.estimate), number(one.p_value),
               one.status == FitStatus::kOk ? one.meaning : one.reason);
  }
  if (options.json) {
    fmt::print("{}\n", json_text(analysis::to_json(effects)));
  } else {
    fmt::print(
        "  intervals: {}; p: {}\n"
        "  exploratory: not planned, not adjusted for there being several\n",
        analysis::kEffectInterval, analysis::kEffectTest);
  }
  if (reason.empty()) return kDone;
  fmt::print(stderr, "jnd: {}: expected answers that have a regression, found none: {}\n",
             options.csv, reason);
  return kHasProblems;
}

}  // namespace

void add_fit_group(CLI::App& fit, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App& group = *fit.add_subcommand(
      "hierarchical", "Weber fraction of the median person from everybody's yes/no answers");
  group
      .add_option("--csv", options->csv,
                  "table with the columns participant,intensity,num_yes,num_trials and, where "
                  "there are, condition,reference")
      ->required();
  group.add_option("--reference", options->reference,
                   "reference intensity, > 0, where the table has no such column");
  group.add_option("--slopes-by", options->link, "people differ by factors, or linearly")
      ->check(CLI::IsMember({"log-slope", "linear"}))
      ->capture_default_str();
  group
      .add_option("--pse", options->pse,
                  "at the reference; free and common; one shift a person; personal in each "
                  "condition")
      ->check(CLI::IsMember({"reference", "common", "shared", "personal"}))
      ->capture_default_str();
  group.add_option("--slopes", options->slopes, "of one person in two conditions")
      ->check(CLI::IsMember({"shared", "correlated"}))
      ->capture_default_str();
  group
      .add_option(
          "--free", options->free,
          "lapse: one rate for everybody, half the share of random answers, with a prior "
          "that expects few; without it none")
      ->check(CLI::IsMember({"lapse"}));
  group
      .add_option("--nodes", options->num_nodes,
                  "of the quadrature, a dimension; 1 is Laplace (default: by dimension)")
      ->check(whole_number(1, 61));
  group.callback([&invocation, options] {
    invocation.run = [options] { return fit_hierarchical(*options); };
  });

  CLI::App& effects = *fit.add_subcommand(
      "effects", "Response bias, interval order, drift and learning (exploratory)");
  effects
      .add_option("--csv", options->csv,
                  "table with the columns intensity,num_yes,num_trials and, where there are, "
                  "trial,test_first")
      ->required();
  effects.add_option("--reference", options->reference, "reference intensity, > 0")->required();
  effects.callback(
      [&invocation, options] { invocation.run = [options] { return fit_effects(*options); }; });

  for (CLI::App* command : {&group, &effects}) {
    command->add_flag("--json", options->json, "print one JSON document");
  }
}

}  // namespace jnd::app
