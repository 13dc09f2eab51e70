#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "analysis/fits/fit_data.h"
#include "analysis/fits/fit_json.h"
#include "analysis/report/power_law_figure.h"
#include "analysis/report/single_figure.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/commands/fit_detection.h"
#include "app/commands/fit_figures.h"
#include "app/commands/fit_glmm.h"
#include "app/commands/fit_group.h"
#include "app/commands/fit_power_people.h"
#include "app/commands/fit_psychometric.h"
#include "app/commands/fit_tables.h"
#include "app/commands/fit_weber.h"
#include "app/curves/fit_words.h"

namespace jnd::app {
namespace {

using analysis::FitStatus;
using Json = nlohmann::ordered_json;

struct FitOptions : TableOptions {
  std::string power_method = "nls";
  bool says_method = false;
  /// The column that says whose a row is; "" for nobody in particular.
  std::string participant;
  std::string shift;  ///< "" for the plain law with standard errors.
  double k1 = 0.0, a1 = 0.0, k2 = 0.0, a2 = 0.0;
  std::vector<double> intensities;
};

/// Such as "95 % 0.32 to 1.6, standard error 0.3", or why there is no interval. k depends on
/// the units of its table, and a is a pure number, so no end of an interval is too far away.
std::string uncertainty_of(const analysis::PowerFit& fit, const analysis::Interval& ci95,
                           const std::optional<double>& standard_error) {
  const std::string error =
      standard_error && !fit.is_exact ? ", standard error " + number(standard_error) : "";
  if (!fit.no_interval.empty()) return "no interval: " + fit.no_interval + error;
  return "95 % " + whole_range(ci95) + error;
}

void print_for_people(const analysis::PowerFit& fit, const std::vector<int>& lines) {
  fmt::print("  S = k I^a by {}, {} row{}\n",
             fit.method == analysis::PowerMethod::kLogLog ? "a line through the logarithms"
                                                          : "least squares",
             fit.num_rows, fit.num_rows == 1 ? "" : "s");
  print_excluded(fit.excluded, lines);
  for (const std::string& warning : fit.warnings) fmt::print("  note: {}\n", warning);
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no power law: {}\n", fit.reason);
    return;
  }
  fmt::print("  k          {:<8}  {}\n", number(fit.k),
             uncertainty_of(fit, fit.k_ci95, fit.k_standard_error));
  fmt::print("  a          {:<8}  {}\n", number(fit.a),
             uncertainty_of(fit, fit.a_ci95, fit.a_standard_error));
  fmt::print("  R squared  {}\n", number(fit.r_squared));
}

void print_for_people(const analysis::ShiftedPowerFit& fit) {
  const bool is_log = fit.method == analysis::PowerMethod::kLogLog;
  const char* law = fit.shift == analysis::PowerShift::kThreshold ? "S = k (I - I0)^a"
                    : fit.shift == analysis::PowerShift::kOffset  ? "S = S0 + k I^a"
                                                                  : "S = k I^a";
  fmt::print("  {} by least squares of the {}, {} rows\n", law,
             is_log ? "logarithms" : "magnitudes", fit.num_rows);
  if (fit.num_left_out > 0) fmt::print("  rows left out: {}\n", fit.num_left_out);
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no power law: {}\n", fit.reason);
    return;
  }
  const auto print = [&](const char* name, const std::optional<double>& value,
                         const analysis::Interval& ci95) {
    if (!value) return;
    fmt::print("  {:<10} {:<8}  {}\n", name, number(value),
               fit.no_interval.empty() ? "95 % " + whole_range(ci95)
                                       : "no interval: " + fit.no_interval);
  };
  print("k", fit.k, fit.k_ci95);
  print("a", fit.a, fit.a_ci95);
  print("I0", fit.intensity_threshold, fit.shift_ci95);
  print("S0", fit.magnitude_offset, fit.shift_ci95);
  fmt::print("  R squared  {}\n", number(fit.r_squared));
  if (fit.shift_statistic) {
    fmt::print("  against the law without it: F = {}, {}\n", number(fit.shift_statistic),
               p_value_words(fit.shift_p_value));
  }
}

void draw_laws(const std::vector<analysis::DrawnPowerLaw>& laws, const FitOptions& options) {
  if (options.figure.empty()) return;
  analysis::write_single_figure(analysis::power_law_figure(laws), options.figure);
}

/// Fits with intervals by the profile of the sum of squares.
int fit_shifted(const FitOptions& options, analysis::PowerMethod method) {
  const auto shift = options.shift == "threshold" ? analysis::PowerShift::kThreshold
                     : options.shift == "offset"  ? analysis::PowerShift::kOffset
                                                  : analysis::PowerShift::kNone;
  if (shift == analysis::PowerShift::kOffset && method == analysis::PowerMethod::kLogLog) {
    throw UsageError(
        "--shift offset: expected --method nls, found loglog; a law with an offset is no line "
        "through logarithms");
  }
  const analysis::CsvTable table = analysis::CsvTable::read(options.csv);
  std::vector<analysis::DrawnPowerLaw> laws;
  const int outcome = fit_groups(
      analysis::read_magnitudes(table, options.group_by), options, "power law",
      [&](const auto& group) {
        analysis::ShiftedPowerFit fit = analysis::fit_shifted_power(group.rows, method, shift);
        laws.push_back({.name = heading_of(group.key),
                        .rows = group.rows,
                        .k = fit.k,
                        .a = fit.a,
                        .intensity_threshold = fit.intensity_threshold.value_or(0.0),
                        .magnitude_offset = fit.magnitude_offset.value_or(0.0)});
        return fit;
      },
      [](const auto& fit, const auto&) { print_for_people(fit); });
  draw_laws(laws, options);
  return outcome;
}

int fit_power(const FitOptions& options) {
  const auto method = options.power_method == "loglog" ? analysis::PowerMethod::kLogLog
                                                       : analysis::PowerMethod::kNonlinear;
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
  if (!options.participant.empty()) {
    if (options.says_method && method == analysis::PowerMethod::kNonlinear) {
      throw UsageError(
          "--participant: expected --method loglog or none, found --method nls; the law of a "
          "group of people is fitted to logarithms");
    }
    if (!options.shift.empty()) {
      throw UsageError(fmt::format(
          "--participant: expected without --shift, found --shift {}; the law of a group of "
          "people has none",
          options.shift));
    }
    return fit_power_people(options, options.participant);
  }
  if (!options.shift.empty()) return fit_shifted(options, method);
  const analysis::CsvTable table = analysis::CsvTable::read(options.csv);
  std::vector<analysis::DrawnPowerLaw> laws;
  const int outcome = fit_groups(
      analysis::read_magnitudes(table, options.group_by), options, "power law",
      [&](const auto& group) {
        analysis::PowerFit fit = analysis::fit_power(group.rows, method);
        const std::size_t num = num_pooled(table, group, options, "participant");
        if (num > 1) {
          fit.warnings.push_back(fmt::format(
              "the rows of {} participants are taken as independent, which those of one are "
              "not: the intervals are too narrow; --participant participant fits a law of the "
              "group, {} one of each of them",
              num, grouped_also_by(options, "participant")));
        }
        laws.push_back(
            {.name = heading_of(group.key), .rows = group.rows, .k = fit.k, .a = fit.a});
        return fit;
      },
      [](const auto& fit, const auto& group) { print_for_people(fit, group.lines); });
  draw_laws(laws, options);
  return outcome;
}

int fit_between(const FitOptions& options) {
  for (const double k : {options.k1, options.k2}) {
    if (!(k > 0.0 && std::isfinite(k))) {
      throw UsageError(fmt::format("--k1, --k2: expected numbers > 0, found {}", k));
    }
  }
  for (const double a : {options.a1, options.a2}) {
    if (!std::isfinite(a)) {
      throw UsageError(fmt::format("--a1, --a2: expected finite numbers, found {}", a));
    }
  }
  for (const double intensity : options.intensities) {
    if (!(intensity >= 0.0 && std::isfinite(intensity))) {
      throw UsageError(
          fmt::format("--intensities: expected numbers >= 0, found {}", intensity));
    }
  }
  const analysis::PowerFit fit = analysis::power_between(
      {options.k1, options.a1}, {options.k2, options.a2}, options.intensities);
  if (options.json) {
    const Json all = analysis::to_json(fit);
    Json json;
    for (const char* key : {"status", "reason", "k", "a"}) json[key] = all.at(key);
    fmt::print("{}\n", json_text(json));
  } else if (fit.status == FitStatus::kOk) {
    fmt::print("  S = {:.5g} I^{:.5g}, the least-squares power law through both curves\n",
               *fit.k, *fit.a);
  } else {
    fmt::print("  no power law: {}\n", fit.reason);
  }
  if (fit.status == FitStatus::kOk) return kDone;
  fmt::print(stderr,
             "jnd: --intensities: expected some that have a power law, found none: {}\n",
             fit.reason);
  return kHasProblems;
}

}  // namespace

HelpPlace place_of_fit() { return {HelpGroup::kOtherData, 10}; }

void add_fit(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<FitOptions>();
  CLI::App& fit = *program.add_subcommand("fit", "Fit a curve to a table of answers");
  invocation.examples[&fit] = {{"jnd fit weber --csv answers.csv --reference 10",
                                "the Weber fraction of a table of answers"}};
  fit.require_subcommand(1);

  add_fit_psychometric(fit, invocation);
  add_fit_weber(fit, invocation);
  add_fit_group(fit, invocation);
  add_fit_glmm(fit, invocation);
  add_fit_detection(fit, invocation);

  CLI::App& power = *fit.add_subcommand("power", "Power law from magnitudes");
  invocation.examples[&power] = {
      {"jnd fit power --csv magnitudes.csv", "columns intensity and magnitude"},
      {"jnd fit power --csv magnitudes.csv --participant participant",
       "the law of a group of people, and everybody's exponent"}};
  add_table_options(power, *options, "intensity,magnitude");
  power.add_option("--method", options->power_method, "nonlinear, or through the logarithms")
      ->check(CLI::IsMember({"nls", "loglog"}))
      ->capture_default_str();
  power
      .add_option("--shift", options->shift,
                  "threshold: S = k (I - I0)^a; offset: S = S0 + k I^a; none: the plain law. "
                  "Each with intervals by the profile of the sum of squares, and a test "
                  "against the law without the shift")
      ->check(CLI::IsMember({"none", "threshold", "offset"}));
  power
      .add_option("--participant", options->participant,
                  "column of whose the rows are: the law of the group, its spread between "
                  "people and everybody's exponents, by a linear mixed model of the logarithms")
      ->option_text("COLUMN");
  add_figure_option(power, options->figure);
  power.callback([&invocation, options, &power] {
    options->says_method = power.count("--method") > 0;
    invocation.run = [options] { return fit_power(*options); };
  });

  CLI::App& between = *fit.add_subcommand("between", "Power law through two power laws");
  invocation.examples[&between] = {
      {"jnd fit between --k1 0.6663 --a1 0.6386 --k2 0.3761 --a2 1.206 --intensities 0.5,1,2",
       "the power law between an estimation and a production"}};
  between.add_option("--k1", options->k1, "factor of the first")->required();
  between.add_option("--a1", options->a1, "exponent of the first")->required();
  between.add_option("--k2", options->k2, "factor of the second")->required();
  between.add_option("--a2", options->a2, "exponent of the second")->required();
  between.add_option("--intensities", options->intensities, "where both are evaluated")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NUMBER[,NUMBER,..] REQUIRED");
  between.callback(
      [&invocation, options] { invocation.run = [options] { return fit_between(*options); }; });

  for (CLI::App* command : {&power, &between}) {
    command->add_flag("--json", options->json, "print one JSON document");
  }
}

}  // namespace jnd::app
