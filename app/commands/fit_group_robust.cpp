#include "app/commands/fit_group_robust.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <vector>

#include "app/command_line/command.h"
#include "app/curves/fit_words.h"
#include "app/curves/prior_options.h"

namespace jnd::app {
namespace {

/// Fractions with their change, such as "0.31 (+1.2 %)"; if there are several conditions, each
/// with its name.
std::string fractions_words(const analysis::HierarchicalFit& fit,
                            const std::vector<std::optional<double>>& fractions) {
  std::string words;
  for (std::size_t i = 0; i < fit.conditions.size() && i < fractions.size(); ++i) {
    const analysis::HierarchicalCondition& one = fit.conditions[i];
    if (!one.weber_fraction || !fractions[i]) continue;
    words += fmt::format("{}{}{} ({:+.1f} %)", words.empty() ? "" : ", ",
                         one.condition.empty() ? "" : one.condition + " ", number(fractions[i]),
                         100.0 * (*fractions[i] / *one.weber_fraction - 1.0));
  }
  return words.empty() ? "none" : words;
}

/// Such as "likelihood ratio 12.3, p = 0.0002 (half of chi-squared's)".
std::string boundary_words(const std::optional<double>& statistic,
                           const std::optional<double>& p_value) {
  return fmt::format("likelihood ratio {}, {}{}", number(statistic), p_value_words(p_value),
                     statistic.value_or(0.0) > 0.0 ? " (half of chi-squared's)" : "");
}

void print_scatter(const analysis::HierarchicalFit& fit) {
  const analysis::HierarchicalScatter& one = *fit.scatter;
  fmt::print(
      "  overdispersion  {:<8}  95 % {} (profile likelihood), correlation rho of two answers "
      "of one person to one level\n",
      number(one.correlation), range(one.correlation_ci95, std::nullopt));
  if (!one.log_likelihood_without) {
    fmt::print("    without it there is no fit\n");
    return;
  }
  fmt::print("    without it: {}; log-likelihood {} instead of {}; Weber fraction {}\n",
             boundary_words(one.statistic, one.p_value), number(one.log_likelihood_without),
             number(fit.log_likelihood), fractions_words(fit, one.weber_fractions_without));
}

void print_prior_effects(const analysis::HierarchicalFit& fit) {
  fmt::print("  lapse prior     Beta({:g}, {:g}) of the share of random answers\n",
             fit.lapse_prior.a, fit.lapse_prior.b);
  for (const analysis::HierarchicalPriorEffect& one : fit.prior_effects) {
    fmt::print("    {:<20}  lapse rate {}; Weber fraction {}\n", prior_weight_words(one.weight),
               number(one.lapse_rate), fractions_words(fit, one.weber_fractions));
  }
}

}  // namespace

void add_robust_options(CLI::App& command, RobustGroupOptions& options) {
  command
      .add_option(
          "--overdispersion", options.overdispersion,
          "answers of one person to one level that scatter more than independent ones: two of "
          "them correlate by rho = phi / (1 + phi), the same for everybody, and k yes among n "
          "have the likelihood of p (p + phi) .. (p + (k - 1) phi) (1 - p) .. (1 - p + (n - k "
          "- 1) phi) / ((1 + phi) .. (1 + (n - 1) phi)); with the test against rho = 0")
      ->check(CLI::IsMember({"none", "beta-binomial"}))
      ->capture_default_str();
  command
      .add_option(
          "--lapses-by", options.lapses_by,
          "one lapse rate for everybody, or a personal one, L sin^2(v + tau b) with b standard "
          "normal between people and L 1/2, or 1 - guess rate with --guess; with the test "
          "against tau = 0")
      ->check(CLI::IsMember({"common", "personal"}))
      ->capture_default_str();
  command
      .add_option(
          "--lapse-prior", options.lapse_prior,
          "prior of a free lapse rate: the share s of random answers, over people its mean, "
          "has the density of Beta(A, B), s^(A - 1) (1 - s)^(B - 1), A and B from 1; 1,1 is "
          "none. Also tells the Weber fraction without it, with half and with twice its weight")
      ->option_text("A,B [1,20]");
}

void apply(const RobustGroupOptions& options, const std::string& lapse,
           analysis::HierarchicalOptions& how) {
  const bool is_personal = options.lapses_by == "personal";
  for (const auto& [is_told, words] :
       {std::pair{is_personal, std::string("--lapses-by personal")},
        {options.lapse_prior.has_value(),
         "--lapse-prior " + options.lapse_prior.value_or("")}}) {
    if (!is_told || lapse == "free") continue;
    throw UsageError(
        fmt::format("{}: expected with a lapse rate that is free, found --lapse {}; leave one "
                    "of them out",
                    words, lapse));
  }
  how.beta_binomial = options.overdispersion == "beta-binomial";
  if (is_personal) how.lapses = analysis::HierarchicalLapses::kPersonal;
  if (!options.lapse_prior) return;
  how.lapse_prior =
      beta_prior_of("--lapse-prior", *options.lapse_prior, analysis::kLargestPriorParameter);
  how.prior_sensitivity = true;
}

void print_own_lapses(const analysis::HierarchicalFit& fit) {
  const analysis::HierarchicalOwnLapses& own = *fit.own_lapses;
  fmt::print(
      "  lapse rate      {:<8}  95 % {} with its prior, of the median person; mean of people "
      "{}\n",
      number(fit.lapse_rate), range(fit.lapse_rate_with_prior_ci95, fit.lapse_rate),
      number(own.mean_lapse_rate));
  fmt::print("  between people  {:<8}  standard deviation tau of the lapse angle\n",
             number(own.angle_sd));
  std::string people, last;
  for (const analysis::HierarchicalPersonEstimate& one : fit.participants) {
    if (one.participant == last) continue;
    last = one.participant;
    people += (people.empty() ? "" : ", ") + one.participant + " " + number(one.lapse_rate);
  }
  fmt::print("    of each person: {}\n", people);
  if (!own.log_likelihood_common) {
    fmt::print("    with one for everybody there is no fit\n");
    return;
  }
  fmt::print(
      "    with one for everybody, {}: {}; log-likelihood {} instead of {}; Weber fraction "
      "{}\n",
      number(own.common_lapse_rate), boundary_words(own.statistic, own.p_value),
      number(own.log_likelihood_common), number(fit.log_likelihood),
      fractions_words(fit, own.weber_fractions_common));
}

void print_robust(const analysis::HierarchicalFit& fit) {
  if (fit.scatter) print_scatter(fit);
  if (!fit.prior_effects.empty()) print_prior_effects(fit);
}

}  // namespace jnd::app
