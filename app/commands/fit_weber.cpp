#include "app/commands/fit_weber.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "analysis/fits/calibrated_drop.h"
#include "analysis/fits/fit_data.h"
#include "analysis/report/single_figure.h"
#include "app/command_line/option_checks.h"
#include "app/commands/fit_figures.h"
#include "app/commands/fit_tables.h"
#include "app/curves/fit_words.h"
#include "app/curves/prior_options.h"

namespace jnd::app {
namespace {

using analysis::FitStatus;

struct FitWeberOptions : TableOptions {
  std::string method = "ml", family = "weber", bootstrap_kind = "parametric";
  /// A rate; `lapse` may also be "free"; "" if not given.
  std::string guess, lapse;
  std::string overdispersion = "none";
  bool symmetric = false;
  int num_goodness = 0;
  int num_calibration = 0;
  bool posterior = false;
  std::optional<std::string> lapse_prior;
  double reference = 0.0;
  std::vector<std::string> free;
  int num_bootstrap = 0;
  std::uint64_t seed = 1;

  [[nodiscard]] bool frees(const char* name) const {
    return std::find(free.begin(), free.end(), name) != free.end();
  }
  [[nodiscard]] bool frees_lapse() const { return frees("lapse") || lapse == "free"; }
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
  for (const analysis::PosteriorPriorEffect& one : posterior.prior_effects) {
    fmt::print("    that of the lapse rate {}: Weber fraction {}, lapse rate {}\n",
               prior_weight_words(one.weight), number(one.weber_fraction),
               number(one.lapse_rate));
  }
  if (!posterior.note.empty()) fmt::print("    note: {}\n", posterior.note);
}

/// Prints everything except the curve itself.
void print_details(const analysis::PsychometricFit& fit) {
  for (const analysis::PsychometricFit::Parameter& one : fit.parameters) {
    fmt::print("  {:<18} {}\n", one.name, number(one.value));
  }
  if (fit.overdispersion.factor) {
    fmt::print("  scaled          {:<8}  variances, in the intervals above\n",
               number(fit.overdispersion.factor));
  }
  if (fit.overdispersion.correlation) {
    fmt::print("  beta-binomial   {:<8}  correlation of two answers to one level\n",
               number(fit.overdispersion.correlation));
  }
  if (fit.calibration.n > 0) {
    fmt::print(
        "  calibrated by {} redraws: the log-likelihood may fall by {} for the Weber "
        "fraction and {} for the pse, not by 1.921\n",
        fit.calibration.n, number(fit.calibration.weber_fraction_drop),
        number(fit.calibration.pse_drop));
  }
  if (fit.goodness.overdispersion) {
    fmt::print("  overdispersion  {:<8}  Pearson's chi-squared over {}\n",
               number(fit.goodness.overdispersion), fit.goodness.degrees_of_freedom);
  }
  if (!fit.goodness.reason.empty()) {
    fmt::print("  goodness of fit not tested: {}\n", fit.goodness.reason);
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
  if (!fit.weber_fraction) return "";
  if (!fit.standard_error) return "no degree of freedom is left";
  if (is_exact(fit.standard_error, fit.weber_fraction)) {
    return "the curve passes through every level";
  }
  return "";
}

void print_for_people(const analysis::PsychometricFit& fit, const FitWeberOptions& options) {
  fmt::print("  {}, {} level{}, {} trial{}\n",
             fit.method == analysis::PsychometricMethod::kLeastSquares ? "least squares"
                                                                       : "maximum likelihood",
             fit.num_levels, fit.num_levels == 1 ? "" : "s", fit.num_trials,
             fit.num_trials == 1 ? "" : "s");
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no Weber fraction: {}\n", fit.reason);
    print_posterior(fit.posterior);
    for (const std::string& warning : fit.warnings) fmt::print("  note: {}\n", warning);
    return;
  }
  const std::string none = why_no_interval(fit);
  if (fit.weber_fraction) {
    fmt::print(
        "  Weber fraction  {:<8}  {}\n", number(fit.weber_fraction),
        uncertainty(fit.weber_fraction_ci95, fit.weber_fraction, fit.standard_error, none));
    fmt::print("    {}\n", analysis::weber_fraction_meaning(fit.guess_rate));
  } else {
    fmt::print("  Weber fraction  none: {}\n", fit.reason);
  }
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
  if (fit.guess_rate > 0.0) {
    fmt::print("  guess rate      {:<8}  known\n", number(fit.guess_rate));
  }
  fmt::print("  lapse rate      {:<8}  {}{}\n", number(fit.lapse_rate),
             options.frees_lapse() ? "free" : "fixed",
             fit.symmetric_lapse ? "" : ", of the upper end");
  fmt::print("  log-likelihood  {:<8}  deviance {}\n", number(fit.log_likelihood),
             number(fit.deviance));
  if (fit.r_squared) fmt::print("  R squared       {}\n", number(fit.r_squared));
  print_details(fit);
}

double rate_of(const std::string& text) { return text.empty() ? 0.0 : std::stod(text); }

/// True if lapses occur at both ends. With --lapse, they occur at the upper end unless asked
/// for otherwise; with --free lapse, and for yes and no, at both.
bool has_lapses_at_both_ends(const FitWeberOptions& options) {
  if (!options.lapse.empty()) return options.symmetric;
  return options.frees("lapse") || rate_of(options.guess) == 0.0;
}

analysis::Overdispersion overdispersion_named(const std::string& name) {
  for (const auto one :
       {analysis::Overdispersion::kScaled, analysis::Overdispersion::kBetaBinomial}) {
    if (analysis::to_string(one) == name) return one;
  }
  return analysis::Overdispersion::kNone;
}

void require_overdispersion(const FitWeberOptions& options) {
  if (options.overdispersion == "none") return;
  if (options.method != "ml" || options.num_bootstrap > 0 || options.posterior) {
    throw UsageError(fmt::format(
        "--overdispersion {}: expected with --method ml, without --bootstrap and --posterior, "
        "which take answers to be independent",
        options.overdispersion));
  }
}

void require_calibration(const FitWeberOptions& options) {
  if (options.num_calibration == 0) return;
  if (options.num_calibration < analysis::kFewestCalibrations) {
    throw UsageError(
        fmt::format("--calibration {}: expected 0, or {} and more redraws; 1000 "
                    "are enough",
                    options.num_calibration, analysis::kFewestCalibrations));
  }
  const bool has_lapses = options.frees_lapse() || rate_of(options.lapse) > 0.0;
  if (options.family == "weber" && options.method == "ml" && options.overdispersion == "none" &&
      !has_lapses && rate_of(options.guess) == 0.0) {
    return;
  }
  throw UsageError(fmt::format(
      "--calibration {}: expected with --family weber and --method ml, without lapses, guesses "
      "and --overdispersion; leave it or those out",
      options.num_calibration));
}

/// The prior of the posterior's lapse rate.
analysis::BetaPrior rate_prior_of(const FitWeberOptions& options) {
  if (!options.lapse_prior) return analysis::kUsualRatePrior;
  if (options.posterior && options.frees_lapse()) {
    return beta_prior_of("--lapse-prior", *options.lapse_prior, kLargestGridPrior);
  }
  throw UsageError(
      fmt::format("--lapse-prior {}: expected with --posterior and a lapse rate that is free, "
                  "found without; "
                  "add --posterior --free lapse, or leave it out",
                  *options.lapse_prior));
}

/// Checks that the options of guesses and lapses go together.
void require_rates(const FitWeberOptions& options) {
  if (options.frees("lapse") && !options.lapse.empty()) {
    throw UsageError(
        "--free lapse, --lapse: expected one of them; --free lapse is --lapse free "
        "--symmetric");
  }
  if (options.symmetric && options.lapse.empty()) {
    throw UsageError("--symmetric: expected with --lapse RATE or --lapse free, found without");
  }
  if (options.lapse.empty() || options.lapse == "free") return;
  const double guess = rate_of(options.guess), lapse = rate_of(options.lapse);
  if (guess + (options.symmetric ? 2.0 : 1.0) * lapse >= 1.0) {
    throw UsageError(
        fmt::format("--lapse: expected a rate that leaves the curve a rise above --guess {}, "
                    "found {}",
                    guess, lapse));
  }
}

/// Warns if one curve is fitted to the answers of several people or conditions.
std::vector<std::string> pooling_warnings(
    const analysis::CsvTable& table, const analysis::DataGroup<analysis::AnswerCount>& group,
    const FitWeberOptions& options) {
  std::vector<std::string> warnings;
  if (const std::size_t num = num_pooled(table, group, options, "participant"); num > 1) {
    warnings.push_back(fmt::format(
        "the answers of {} participants are added up into one curve, which is flatter than "
        "theirs where they differ in their pse: {} fits each of them, jnd fit hierarchical the "
        "median person",
        num, grouped_also_by(options, "participant")));
  }
  if (const std::size_t num = num_pooled(table, group, options, "condition"); num > 1) {
    warnings.push_back(
        fmt::format("the answers of {} conditions are added up into one curve: {} fits each of "
                    "them",
                    num, grouped_also_by(options, "condition")));
  }
  if (num_pooled(table, group, options, "test_first") > 1) {
    warnings.push_back(fmt::format(
        "answers with the test first and with the test second are added up into one curve, "
        "which is flatter than theirs where an interval is favoured: {} fits each order, jnd "
        "fit effects tells the effect of the order",
        grouped_also_by(options, "test_first")));
  }
  return warnings;
}

/// Warns if the table has other references than the one given to the fit.
std::vector<std::string> reference_warnings(
    const analysis::CsvTable& table, const analysis::DataGroup<analysis::AnswerCount>& group,
    double reference) {
  std::set<std::string> others = analysis::different_cells(table, "reference", group);
  std::erase_if(others, [&](const std::string& cell) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    return end != cell.c_str() && value == reference;
  });
  if (others.empty()) return {};
  return {fmt::format(
      "the column reference of these rows has {}, and is not used: the fit takes the {} of "
      "--reference; --group-by reference tells the rows apart, jnd fit hierarchical uses the "
      "column",
      fmt::join(others, ", "), reference)};
}

bool all_above_zero(const std::vector<analysis::DrawnCurve>& curves) {
  return std::ranges::all_of(curves, [](const analysis::DrawnCurve& curve) {
    return std::ranges::all_of(
        curve.points, [](const analysis::CurvePoint& point) { return point.intensity > 0.0; });
  });
}

int fit_weber(const FitWeberOptions& options) {
  if (!(options.reference > 0.0 && std::isfinite(options.reference))) {
    throw UsageError(
        fmt::format("--reference: expected a number > 0 in the unit of the intensities, found "
                    "{}; the Weber fraction is relative to it",
                    options.reference));
  }
  require_rates(options);
  require_overdispersion(options);
  require_calibration(options);
  const analysis::PsychometricOptions how = {
      .reference = options.reference,
      .family = analysis::psychometric_family_named(options.family)
                    .value_or(analysis::PsychometricFamily::kWeber),
      .method = options.method == "lsq" ? analysis::PsychometricMethod::kLeastSquares
                                        : analysis::PsychometricMethod::kMaximumLikelihood,
      .free_pse = options.frees("pse"),
      .free_lapse = options.frees_lapse(),
      .guess_rate = rate_of(options.guess),
      .lapse_rate = options.frees_lapse() ? 0.0 : rate_of(options.lapse),
      .symmetric_lapse = has_lapses_at_both_ends(options),
      .overdispersion = overdispersion_named(options.overdispersion),
      .num_bootstrap = options.num_bootstrap,
      .bootstrap_kind = options.bootstrap_kind == "nonparametric"
                            ? analysis::BootstrapKind::kNonparametric
                            : analysis::BootstrapKind::kParametric,
      .diagnostics = true,
      .advice = true,
      .guess_unknown = options.guess.empty(),
      .num_goodness = options.num_goodness,
      .num_calibration = options.num_calibration,
      .posterior = options.posterior,
      .rate_prior = rate_prior_of(options),
      .prior_sensitivity = options.lapse_prior.has_value(),
      .seed = options.seed};
  if (!options.figure.empty()) analysis::require_figure_file(options.figure);
  const analysis::CsvTable table = analysis::CsvTable::read(options.csv);
  std::vector<analysis::DrawnCurve> curves;
  const int outcome = fit_groups(
      analysis::read_answer_counts(table, options.group_by), options, "Weber fraction",
      [&](const auto& group) {
        analysis::PsychometricFit fit = analysis::fit_psychometric(group.rows, how);
        std::vector<std::string> pooled = pooling_warnings(table, group, options);
        const std::vector<std::string> references =
            reference_warnings(table, group, options.reference);
        pooled.insert(pooled.end(), references.begin(), references.end());
        fit.warnings.insert(fit.warnings.begin(), pooled.begin(), pooled.end());
        curves.push_back(drawn_curve(heading_of(group.key), group.rows, fit));
        return fit;
      },
      [&](const auto& fit, const auto&) { print_for_people(fit, options); });
  if (!options.figure.empty()) {
    const double guess = rate_of(options.guess);
    analysis::write_single_figure(
        analysis::curve_figure(
            curves, {.intensity_name = "Intensity",
                     .answer_name = guess > 0.0 ? "Proportion right" : "Proportion yes",
                     .logarithmic = how.family != analysis::PsychometricFamily::kGauss &&
                                    all_above_zero(curves),
                     .guess_rate = guess}),
        options.figure);
  }
  return outcome;
}

}  // namespace

void add_fit_weber(CLI::App& fit, Invocation& invocation) {
  const auto options = std::make_shared<FitWeberOptions>();
  CLI::App& weber = *fit.add_subcommand("weber", "Weber fraction from yes/no answers");
  invocation.examples[&weber] = {
      {"jnd fit weber --csv answers.csv --reference 10 --group-by participant",
       "one fit for each participant"}};
  add_table_options(weber, *options, "intensity,num_yes,num_trials");
  weber.add_option("--reference", options->reference, "reference intensity, > 0")->required();
  weber.add_option("--method", options->method, "maximum likelihood or least squares")
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
      .add_option(
          "--guess", options->guess,
          "share of right answers where nothing is felt, of a forced choice: 1/2 of two "
          "alternatives, 1/3 of three; 0 of yes and no")
      ->transform(rate())
      ->option_text("RATE [0]");
  weber
      .add_option(
          "--lapse", options->lapse,
          "lapse rate, or `free` to fit it: of the upper end alone, guess + (1 - guess - "
          "lapse) F")
      ->transform(rate({"free"}))
      ->option_text("RATE|free");
  weber.add_flag(
      "--symmetric", options->symmetric,
      "the lapses of --lapse are at both ends: guess + lapse + (1 - guess - 2 lapse) F");
  weber
      .add_option("--overdispersion", options->overdispersion,
                  "intervals for answers that scatter more than independent ones: scaled by "
                  "Pearson's chi-squared, or of a beta-binomial distribution")
      ->check(CLI::IsMember({"none", "scaled", "beta-binomial"}))
      ->capture_default_str();
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
  weber
      .add_option("--calibration", options->num_calibration,
                  "redraws that widen the intervals of a free pse where no level has 30 "
                  "answers: 200 or more; 1000 are enough")
      ->check(whole_number(0, 10'000'000));
  weber.add_flag("--posterior", options->posterior,
                 "also the Bayesian estimate on a grid, with its priors");
  weber.add_option("--lapse-prior", options->lapse_prior, kLapsePriorHelp)
      ->option_text("A,B [1,10]");
  weber
      .add_option(
          "--family", options->family,
          "the curve's form; gauss and weibull free the pse; of all the Weber fraction is "
          "(x84.13 - pse) / pse")
      ->check(CLI::IsMember({"weber", "gauss", "weibull"}))
      ->capture_default_str();
  weber.add_option("--seed", options->seed, "of bootstrap, goodness of fit and calibration")
      ->check(seed_number())
      ->capture_default_str();
  add_figure_option(weber, options->figure);
  weber.add_flag("--json", options->json, "print one JSON document");
  weber.callback(
      [&invocation, options] { invocation.run = [options] { return fit_weber(*options); }; });
}

}  // namespace jnd::app
