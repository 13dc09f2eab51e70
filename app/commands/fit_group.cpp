#include "app/commands/fit_group.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/data/csv_table.h"
#include "analysis/fits/fit_data.h"
#include "analysis/fits/psychometric_json.h"
#include "analysis/hierarchical/hierarchical_assumptions.h"
#include "analysis/hierarchical/hierarchical_data.h"
#include "analysis/hierarchical/hierarchical_json.h"
#include "analysis/hierarchical/hierarchical_warnings.h"
#include "analysis/report/single_figure.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/commands/fit_figures.h"
#include "app/commands/fit_group_robust.h"
#include "app/curves/fit_words.h"

namespace jnd::app {
namespace {

using analysis::FitStatus;

struct FitGroupOptions {
  std::string csv, link = "log-slope", pse = "personal", slopes = "correlated";
  std::string guess = "0", lapse = "free";
  std::vector<std::string> free;
  RobustGroupOptions robust;
  std::optional<double> reference;
  int num_nodes = 0;
  std::string figure;  ///< "" for none.
  bool json = false;
};

void require_reference(const FitGroupOptions& options) {
  if (!options.reference) return;
  if (!(*options.reference > 0.0 && std::isfinite(*options.reference))) {
    throw UsageError(
        fmt::format("--reference: expected a number > 0 in the unit of the intensities, found "
                    "{}; the Weber fraction is relative to it",
                    *options.reference));
  }
}

/// The range of lapse rates for which an interval of the Weber fraction holds; "" if there is a
/// single rate.
std::string interval_basis(const analysis::HierarchicalFit& fit) {
  if (!fit.lapse_rate_without_prior && !fit.own_lapses) return "";
  return ", over lapse rates of " + range(fit.lapse_rate_with_prior_ci95, fit.lapse_rate);
}

/// Prints the lapse rate, and how far its prior changes the fractions.
void print_lapses(const analysis::HierarchicalFit& fit) {
  if (!fit.lapse_rate) return;
  if (fit.own_lapses) return print_own_lapses(fit);
  if (!fit.lapse_rate_without_prior) {
    fmt::print("  lapse rate      {:<8}  of everybody, given\n", number(fit.lapse_rate));
    return;
  }
  fmt::print("  lapse rate      {:<8}  95 % {} by the answers alone, of everybody\n",
             number(fit.lapse_rate), range(fit.lapse_rate_ci95, fit.lapse_rate));
  std::string fractions;
  for (const analysis::HierarchicalCondition& one : fit.conditions) {
    if (!one.weber_fraction || !one.weber_fraction_without_prior) continue;
    fractions +=
        fmt::format("{}{}{} ({:+.1f} %)", fractions.empty() ? "Weber fraction " : ", ",
                    one.condition.empty() ? "" : one.condition + " ",
                    number(one.weber_fraction_without_prior),
                    100.0 * (*one.weber_fraction_without_prior / *one.weber_fraction - 1.0));
  }
  fmt::print("    without its prior {}: {}\n", number(fit.lapse_rate_without_prior), fractions);
}

void print_for_people(const analysis::HierarchicalFit& fit) {
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no hierarchical fit: {}\n", fit.reason);
    return;
  }
  fmt::print("  {}; {} participants\n", fit.method, fit.num_participants);
  for (const analysis::HierarchicalCondition& one : fit.conditions) {
    if (!one.condition.empty()) fmt::print("{}\n", one.condition);
    // The note says why.
    if (!one.weber_fraction) continue;
    fmt::print("  Weber fraction  {:<8}  95 % {}, of the median person{}\n",
               number(one.weber_fraction), range(one.weber_fraction_ci95, one.weber_fraction),
               interval_basis(fit));
    for (const std::string& caution : one.cautions) fmt::print("    CAUTION: {}\n", caution);
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
  print_lapses(fit);
  print_robust(fit);
  if (fit.correlation) fmt::print("  correlation of the slopes  {}\n", number(fit.correlation));
  for (const analysis::HierarchicalDifference& one : fit.differences) {
    fmt::print("  {} - {}: {}  95 % {}, t({:.0f}) = {}, {}\n", one.second, one.first,
               number(one.estimate), range(one.ci95, one.estimate), one.degrees_of_freedom,
               number(one.statistic), p_value_words(one.p_value));
  }
  if (!fit.note.empty()) fmt::print("  {}\n", fit.note);
}

double guess_of(const FitGroupOptions& options) { return std::stod(options.guess); }

/// None if the lapse rate is free.
std::optional<double> lapse_of(const FitGroupOptions& options) {
  if (options.lapse == "free") return std::nullopt;
  if (options.lapse == "none") return 0.0;
  return std::stod(options.lapse);
}

void require_lapses(const FitGroupOptions& options) {
  const std::optional<double> lapse = lapse_of(options);
  if (!lapse) return;
  if (!options.free.empty()) {
    throw UsageError(fmt::format(
        "--free lapse, --lapse: expected one of them, or --lapse free, found --lapse {}",
        options.lapse));
  }
  const double guess = guess_of(options);
  if (*lapse < (guess > 0.0 ? 1.0 - guess : 0.5)) return;
  throw UsageError(fmt::format(
      "--lapse: expected a rate that leaves the curve a rise above --guess {}, found {}",
      options.guess, options.lapse));
}

/// True if somebody's answers to one condition contain both orders of the intervals.
bool adds_up_orders(const analysis::CsvTable& table) {
  std::vector<std::string> group_by = {"participant"};
  if (table.find("condition")) group_by.emplace_back("condition");
  return std::ranges::any_of(
      analysis::read_answer_counts(table, group_by), [&](const auto& one) {
        return analysis::different_cells(table, "test_first", one).size() > 1;
      });
}

/// Draws the median person's curve in each condition, over everybody's answers.
void draw_hierarchical(const FitGroupOptions& options, const analysis::HierarchicalFit& fit,
                       const std::vector<analysis::ParticipantAnswers>& answers) {
  std::vector<analysis::DrawnCurve> curves;
  bool all_above_zero = true;
  for (const analysis::HierarchicalCondition& one : fit.conditions) {
    std::vector<analysis::AnswerCount> rows;
    for (const analysis::ParticipantAnswers& person : answers) {
      if (person.condition != one.condition) continue;
      rows.insert(rows.end(), person.rows.begin(), person.rows.end());
    }
    for (const analysis::AnswerCount& row : rows) all_above_zero &= row.intensity > 0.0;
    analysis::PsychometricFit curve{.status = fit.status, .weber_fraction = one.weber_fraction};
    curve.pse = one.pse;
    curve.pse_ci95 = one.pse_ci95;
    curve.lapse_rate = fit.lapse_rate;
    curve.guess_rate = fit.guess_rate;
    curve.symmetric_lapse = fit.guess_rate == 0.0;
    curves.push_back(drawn_curve(one.condition, rows, curve));
  }
  analysis::write_single_figure(
      analysis::curve_figure(
          curves, {.intensity_name = "Intensity",
                   .answer_name = fit.guess_rate > 0.0 ? "Proportion right" : "Proportion yes",
                   .logarithmic = all_above_zero,
                   .guess_rate = fit.guess_rate}),
      options.figure);
}

int fit_hierarchical(const FitGroupOptions& options) {
  require_reference(options);
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
  require_lapses(options);
  const std::optional<double> lapse = lapse_of(options);
  analysis::HierarchicalOptions how = {
      .link = options.link == "linear" ? analysis::HierarchicalLink::kLinear
                                       : analysis::HierarchicalLink::kLogSlope,
      .pse = options.pse == "reference" ? analysis::HierarchicalPse::kReference
             : options.pse == "common"  ? analysis::HierarchicalPse::kCommon
             : options.pse == "shared"  ? analysis::HierarchicalPse::kShared
                                        : analysis::HierarchicalPse::kPersonal,
      .slopes = options.slopes == "shared" ? analysis::HierarchicalSlopes::kShared
                                           : analysis::HierarchicalSlopes::kCorrelated,
      .lapses =
          lapse ? analysis::HierarchicalLapses::kKnown : analysis::HierarchicalLapses::kCommon,
      .lapse_rate = lapse.value_or(0.0),
      .guess_rate = guess_of(options),
      .num_nodes = options.num_nodes};
  apply(options.robust, options.lapse, how);
  const analysis::CsvTable table = analysis::CsvTable::read(options.csv);
  const std::vector<analysis::ParticipantAnswers> answers =
      analysis::read_participant_answers(table, options.reference);
  std::vector<std::string> warnings =
      analysis::hierarchical_warnings(answers, guess_of(options));
  if (adds_up_orders(table)) {
    warnings.emplace_back(
        "the column test_first is not used: answers of both orders of the intervals are added "
        "up, which makes the Weber fraction too large where people favour an interval; jnd fit "
        "effects tells the effect of the order");
  }
  const bool uses_others = std::ranges::any_of(answers, [&](const auto& one) {
    return options.reference && one.reference != *options.reference;
  });
  if (uses_others) {
    warnings.push_back(fmt::format(
        "the table's column reference is used, and --reference {} is not", *options.reference));
  }
  analysis::HierarchicalFit fit = analysis::fit_hierarchical(answers, how);
  analysis::tell_assumptions(fit, answers, how);
  if (options.json) {
    auto json = analysis::to_json(fit);
    json["warnings"] = warnings;
    fmt::print("{}\n", json_text(json));
  } else {
    print_for_people(fit);
    for (const std::string& warning : warnings) fmt::print("  note: {}\n", warning);
  }
  if (fit.status == FitStatus::kOk) {
    if (!options.figure.empty()) draw_hierarchical(options, fit, answers);
    return kDone;
  }
  fmt::print(stderr, "jnd: {}: expected answers that have a hierarchical fit, found none: {}\n",
             options.csv, fit.reason);
  return kHasProblems;
}

/// Reads the rows, with what else the table says about each.
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

void print_for_people(const analysis::PsychometricEffects& found) {
  if (found.slope) {
    fmt::print("  {:<15} {:<9} 95 % {}: of z over ln(intensity / reference), 1 / ln(1 + w)\n",
               "slope", number(found.slope), range(found.slope_ci95, found.slope));
  }
  for (const analysis::PsychometricEffect& one : found.effects) {
    if (one.status == FitStatus::kOk && !one.estimate) {
      fmt::print("  {:<15} {:<9} {} of any change: {}\n", one.name, number(one.estimate),
                 p_value_words(one.p_value), one.reason);
      continue;
    }
    fmt::print("  {:<15} {:<9} 95 % {}, {}: {}\n", one.name, number(one.estimate),
               range(one.ci95, one.estimate), p_value_words(one.p_value),
               one.status == FitStatus::kOk ? one.meaning : one.reason);
  }
  for (const std::string& warning : found.warnings) fmt::print("  note: {}\n", warning);
  fmt::print(
      "  intervals: {}; p: {}\n"
      "  exploratory: not planned, not adjusted for there being several\n",
      analysis::kEffectInterval, analysis::kEffectTest);
}

int fit_effects(const FitGroupOptions& options) {
  require_reference(options);
  const analysis::PsychometricEffects found = analysis::psychometric_effects(
      read_ordered_answers(analysis::CsvTable::read(options.csv)), *options.reference);
  if (options.json) {
    fmt::print("{}\n", json_text(analysis::to_json(found)));
  } else {
    print_for_people(found);
  }
  std::string reason;
  for (const analysis::PsychometricEffect& one : found.effects) {
    if (one.status != FitStatus::kOk && reason.empty()) reason = one.reason;
  }
  if (reason.empty()) return kDone;
  fmt::print(stderr, "jnd: {}: expected answers that have a regression, found none: {}\n",
             options.csv, reason);
  return kHasProblems;
}

}  // namespace

void add_fit_group(CLI::App& fit, Invocation& invocation) {
  const auto options = std::make_shared<FitGroupOptions>();
  CLI::App& group = *fit.add_subcommand(
      "hierarchical", "Weber fraction of the median person from everybody's yes/no answers");
  invocation.examples[&group] = {{"jnd fit hierarchical --csv everybody.csv --reference 10",
                                  "the median person, from everybody's answers"}};
  group
      .add_option("--csv", options->csv,
                  "table with the columns participant,intensity,num_yes,num_trials and, where "
                  "there are, condition,reference")
      ->required();
  group.add_option("--reference", options->reference,
                   "reference intensity, > 0, where the table has no such column");
  group
      .add_option("--slopes-by", options->link,
                  "people differ by factors, or linearly: without lapses that is fit glmm "
                  "--fixed u --random \"1 + u || participant\", u = ln(x / reference)")
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
      .add_option("--free", options->free,
                  "lapse: as --lapse free, which is what is done anyway")
      ->check(CLI::IsMember({"lapse"}));
  group
      .add_option("--lapse", options->lapse,
                  "lapse rate of everybody, at both ends of the curve, or with --guess at its "
                  "upper one: free, with a prior that expects few; none; or a rate")
      ->transform(rate({"free", "none"}))
      ->option_text("free|none|RATE [free]");
  group
      .add_option("--guess", options->guess,
                  "share of right answers where nothing is felt, of a forced choice: 1/2 of "
                  "two alternatives, 1/3 of three; 0 of yes and no")
      ->transform(rate())
      ->option_text("RATE [0]");
  add_robust_options(group, options->robust);
  group
      .add_option("--nodes", options->num_nodes,
                  "of the quadrature, a dimension; 1 is Laplace (default: by dimension)")
      ->check(whole_number(1, 61));
  add_figure_option(group, options->figure);
  group.callback([&invocation, options] {
    invocation.run = [options] { return fit_hierarchical(*options); };
  });

  CLI::App& effects = *fit.add_subcommand("effects",
                                          "Response bias, interval order, drift and learning "
                                          "(exploratory); fit glmm --fixed \"u * t "
                                          "+ o\" is the same of people who differ");
  invocation.examples[&effects] = {{"jnd fit effects --csv answers.csv --reference 10",
                                    "whether people answered otherwise later than at first"}};
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
