#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "analysis/fits/fit_data.h"
#include "analysis/fits/fit_json.h"
#include "app/commands/commands.h"
#include "app/commands/fit_group.h"
#include "app/commands/fit_words.h"
#include "app/json_text.h"
#include "app/option_checks.h"

namespace jnd::app {
namespace {

using analysis::FitStatus;
using Json = nlohmann::ordered_json;

struct Options {
  std::string csv, weber_method = "ml", power_method = "nls";
  std::string family = "weber", bootstrap_kind = "parametric";
  int num_goodness = 0;
  bool posterior = false;
  double reference = 0.0;
  std::vector<std::string> free, group_by;
  int num_bootstrap = 0;
  std::uint64_t seed = 1;
  double k1 = 0.0, a1 = 0.0, k2 = 0.0, a2 = 0.0;
  std::vector<double> intensities;
  bool json = false;
};

void print_posterior(const analysis::PsychometricPosterior& posterior) {
  if (posterior.status != FitStatus::kOk) return;
  fmt::print("  posterior       {:<8}  95 % {}, median of the Weber fraction\n",
             number(posterior.weber_fraction),
             range(posterior.weber_fraction_ci95, posterior.weber_fraction));
  if (posterior.pse_ci95) {
    fmt::print("  posterior pse   {:<8}  95 % {}\n", number(posterior.pse),
               range(*posterior.pse_ci95, posterior.pse));
  }
  fmt::print("    priors: {}\n", posterior.priors);
  if (!posterior.note.empty()) fmt::print("    note: {}\n", posterior.note);
}

/// What goes beyond the curve itself.
void print_details(const analysis::PsychometricFit& fit) {
  for (const analysis::PsychometricFit::Parameter& one : fit.parameters) {
    fmt::print("  {:<18} {}\n", one.name, number(one.value));
  }
  if (fit.goodness.overdispersion) {
    fmt::print("  overdispersion  {:<8}  Pearson's chi-squared over {}\n",
               number(fit.goodness.overdispersion), fit.goodness.degrees_of_freedom);
  }
  if (fit.goodness.p_value) {
    fmt::print("  goodness of fit p = {}  deviance against {} redrawn data sets\n",
               number(fit.goodness.p_value), fit.goodness.n);
  }
  print_posterior(fit.posterior);
  for (const std::string& warning : fit.warnings) fmt::print("  note: {}\n", warning);
}

/// Why least squares has no interval; "" if it has one.
std::string why_no_interval(const analysis::PsychometricFit& fit) {
  if (fit.method != analysis::PsychometricMethod::kLeastSquares) return "";
  if (!fit.standard_error) return "no degree of freedom is left";
  if (is_exact(fit.standard_error, fit.weber_fraction)) {
    return "the curve passes through every level";
  }
  return "";
}

std::string why_no_interval(const analysis::PowerFit& fit) {
  if (!fit.a_standard_error) return "no degree of freedom is left";
  if (is_exact(fit.k_standard_error, fit.k)) return "the power law passes through every row";
  const bool none = !fit.a_ci95.low && !fit.a_ci95.high;
  return none ? "one degree of freedom is too few" : "";
}

void print_for_people(const analysis::PsychometricFit& fit, const Options& options) {
  fmt::print("  {}, {} level{}, {} trial{}\n",
             fit.method == analysis::PsychometricMethod::kLeastSquares ? "least squares"
                                                                       : "maximum likelihood",
             fit.num_levels, fit.num_levels == 1 ? "" : "s", fit.num_trials,
             fit.num_trials == 1 ? "" : "s");
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no Weber fraction: {}\n", fit.reason);
    print_posterior(fit.posterior);
    return;
  }
  const std::string none = why_no_interval(fit);
  fmt::print(
      "  Weber fraction  {:<8}  {}\n", number(fit.weber_fraction),
      uncertainty(fit.weber_fraction_ci95, fit.weber_fraction, fit.standard_error, none));
  fmt::print("    {}\n", analysis::kWeberFractionMeaning);
  if (!fit.bootstrap.method.empty()) {
    fmt::print("    bootstrap               95 % {} ({}, {} refits, {} without an optimum)\n",
               range(fit.bootstrap.ci95, fit.weber_fraction), fit.bootstrap.method,
               fit.bootstrap.n, fit.bootstrap.num_degenerate);
    fmt::print("    corrected (BCa)         95 % {}\n",
               fit.bootstrap.bca_reason.empty()
                   ? range(fit.bootstrap.bca_ci95, fit.weber_fraction)
                   : "none: " + fit.bootstrap.bca_reason);
  }
  fmt::print("  PSE             {:<8}  {}, in the unit of the intensities\n", number(fit.pse),
             fit.pse_ci95 ? uncertainty(*fit.pse_ci95, fit.pse, std::nullopt, none)
                          : "fixed at the reference");
  const bool free_lapse =
      std::find(options.free.begin(), options.free.end(), "lapse") != options.free.end();
  fmt::print("  lapse rate      {:<8}  {}\n", number(fit.lapse_rate),
             free_lapse ? "free" : "fixed");
  fmt::print("  log-likelihood  {:<8}  deviance {}\n", number(fit.log_likelihood),
             number(fit.deviance));
  if (fit.r_squared) fmt::print("  R squared       {}\n", number(fit.r_squared));
  print_details(fit);
}

void print_for_people(const analysis::PowerFit& fit, const std::vector<int>& lines) {
  fmt::print("  S = k I^a by {}, {} row{}\n",
             fit.method == analysis::PowerMethod::kLogLog ? "a line through the logarithms"
                                                          : "least squares",
             fit.num_rows, fit.num_rows == 1 ? "" : "s");
  for (const analysis::PowerFit::Excluded& excluded : fit.excluded) {
    fmt::print("  left out line {}: {}\n", lines[excluded.row], excluded.reason);
  }
  for (const std::string& warning : fit.warnings) fmt::print("  note: {}\n", warning);
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no power law: {}\n", fit.reason);
    return;
  }
  const std::string none = why_no_interval(fit);
  fmt::print("  k          {:<8}  {}\n", number(fit.k),
             uncertainty(fit.k_ci95, fit.k, fit.k_standard_error, none));
  fmt::print("  a          {:<8}  {}\n", number(fit.a),
             uncertainty(fit.a_ci95, fit.a, fit.a_standard_error, none));
  fmt::print("  R squared  {}\n", number(fit.r_squared));
}

/// What stderr is told of fits without a value: one sentence, whatever stdout shows.
void print_lacking(const Options& options, const char* what, std::size_t num_lacking,
                   std::size_t num_groups, const std::string& reason) {
  if (num_groups == 0) {
    fmt::print(stderr, "jnd: {}: expected rows below the header, found none\n", options.csv);
  } else if (num_groups == 1) {
    fmt::print(stderr, "jnd: {}: expected answers that have a {}, found none: {}\n",
               options.csv, what, reason);
  } else if (num_lacking > 0) {
    fmt::print(stderr, "jnd: {}: expected a {} in every group, found none in {} of {}: {}\n",
               options.csv, what, num_lacking, num_groups, reason);
  }
}

/// Fits every group, prints them all, and says whether each has a value. `fit` makes a result
/// of a group, `print` shows it to people.
template <typename Group, typename Fit, typename Print>
int fit_groups(const std::vector<Group>& groups, const Options& options, const char* what,
               const Fit& fit, const Print& print) {
  std::size_t num_lacking = 0;
  std::string reason;  // Of the first that has no value.
  Json results = Json::array();
  for (const Group& group : groups) {
    const auto result = fit(group);
    if (result.status != FitStatus::kOk && num_lacking++ == 0) reason = result.reason;
    if (options.json) {
      Json json;
      for (const auto& [column, value] : group.key) json["group"][column] = value;
      json.update(analysis::to_json(result));
      results.push_back(std::move(json));
      continue;
    }
    std::string heading;
    for (const auto& [column, value] : group.key) {
      heading += (heading.empty() ? "" : ", ") + column + " " + group_words(value);
    }
    if (!heading.empty()) fmt::print("{}\n", heading);
    print(result, group);
  }
  if (options.json) {
    const Json document =
        options.group_by.empty() ? results.at(0) : Json{{"groups", std::move(results)}};
    fmt::print("{}\n", json_text(document));
  }
  if (num_lacking == 0 && !groups.empty()) return kDone;
  print_lacking(options, what, num_lacking, groups.size(), reason);
  return kHasProblems;
}

/// The rows of the file. What is wrong with it is a `core::Error`: the data have problems.
template <typename Read>
auto read_groups(const Options& options, const Read& read) {
  return read(analysis::CsvTable::read(options.csv), options.group_by);
}

int fit_weber(const Options& options) {
  if (!(options.reference > 0.0 && std::isfinite(options.reference))) {
    throw UsageError(
        fmt::format("--reference: expected a number > 0 in the unit of the intensities, found "
                    "{}; the Weber fraction is relative to it",
                    options.reference));
  }
  const auto is_free = [&](const char* name) {
    return std::find(options.free.begin(), options.free.end(), name) != options.free.end();
  };
  const analysis::PsychometricOptions how = {
      .reference = options.reference,
      .family = analysis::psychometric_family_named(options.family)
                    .value_or(analysis::PsychometricFamily::kWeber),
      .method = options.weber_method == "lsq"
                    ? analysis::PsychometricMethod::kLeastSquares
                    : analysis::PsychometricMethod::kMaximumLikelihood,
      .free_pse = is_free("pse"),
      .free_lapse = is_free("lapse"),
      .num_bootstrap = options.num_bootstrap,
      .bootstrap_kind = options.bootstrap_kind == "nonparametric"
                            ? analysis::BootstrapKind::kNonparametric
                            : analysis::BootstrapKind::kParametric,
      .diagnostics = true,
      .num_goodness = options.num_goodness,
      .posterior = options.posterior,
      .seed = options.seed};
  return fit_groups(
      read_groups(options, analysis::read_answer_counts), options, "Weber fraction",
      [&](const auto& group) { return analysis::fit_psychometric(group.rows, how); },
      [&](const auto& fit, const auto&) { print_for_people(fit, options); });
}

int fit_power(const Options& options) {
  const auto method = options.power_method == "loglog" ? analysis::PowerMethod::kLogLog
                                                       : analysis::PowerMethod::kNonlinear;
  return fit_groups(
      read_groups(options, analysis::read_magnitudes), options, "power law",
      [&](const auto& group) { return analysis::fit_power(group.rows, method); },
      [](const auto& fit, const auto& group) { print_for_people(fit, group.lines); });
}

int fit_between(const Options& options) {
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

void add_table_options(CLI::App& command, Options& options, const char* columns) {
  command.add_option("--csv", options.csv, std::string("table with the columns ") + columns)
      ->required();
  command
      .add_option("--group-by", options.group_by, "columns; one fit for each of their values")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
}

}  // namespace

void add_fit(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App& fit = *program.add_subcommand("fit", "Fit a curve to a table of answers");
  fit.require_subcommand(1);

  CLI::App& weber = *fit.add_subcommand("weber", "Weber fraction from yes/no answers");
  add_table_options(weber, *options, "intensity,num_yes,num_trials");
  weber.add_option("--reference", options->reference, "reference intensity, > 0")->required();
  weber.add_option("--method", options->weber_method, "maximum likelihood or least squares")
      ->check(CLI::IsMember({"ml", "lsq"}))
      ->capture_default_str();
  weber
      .add_option("--free", options->free,
                  "also fit the pse, the lapse rate, or both; the lapse rate is that of "
                  "either end: lapse + (1 - 2 lapse) F")
      ->check(CLI::IsMember({"pse", "lapse"}))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("pse|lapse|pse,lapse");
  weber
      .add_option("--bootstrap", options->num_bootstrap,
                  "refits for a percentile interval of the Weber fraction")
      ->check(whole_number(0, 10'000'000));
  weber
      .add_option("--bootstrap-kind", options->bootstrap_kind,
                  "answers drawn from the curve, or from the answers within each level")
      ->check(CLI::IsMember({"parametric", "nonparametric"}))
      ->capture_default_str();
  weber.add_option("--goodness", options->num_goodness, "redraws for the goodness of fit")
      ->check(whole_number(0, 10'000'000));
  weber.add_flag("--posterior", options->posterior,
                 "also the Bayesian estimate on a grid, with its priors");
  weber
      .add_option(
          "--family", options->family,
          "the curve's form; gauss and weibull free the pse; of all the Weber fraction is "
          "(x84.13 - pse) / pse")
      ->check(CLI::IsMember({"weber", "gauss", "weibull"}))
      ->capture_default_str();
  weber.add_option("--seed", options->seed, "of bootstrap and goodness of fit")
      ->check(seed_number())
      ->capture_default_str();
  weber.callback(
      [&invocation, options] { invocation.run = [options] { return fit_weber(*options); }; });

  add_fit_group(fit, invocation);

  CLI::App& power = *fit.add_subcommand("power", "Power law from magnitudes");
  add_table_options(power, *options, "intensity,magnitude");
  power.add_option("--method", options->power_method, "nonlinear, or through the logarithms")
      ->check(CLI::IsMember({"nls", "loglog"}))
      ->capture_default_str();
  power.callback(
      [&invocation, options] { invocation.run = [options] { return fit_power(*options); }; });

  CLI::App& between = *fit.add_subcommand("between", "Power law through two power laws");
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

  for (CLI::App* command : {&weber, &power, &between}) {
    command->add_flag("--json", options->json, "print one JSON document");
  }
}

}  // namespace jnd::app
