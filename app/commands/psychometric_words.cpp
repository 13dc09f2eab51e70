#include "app/commands/psychometric_words.h"

#include <fmt/format.h>

#include "app/curves/fit_words.h"
#include "app/curves/prior_options.h"

namespace jnd::app {
namespace {

using analysis::CurveFit;
using analysis::CurveValue;
using analysis::FitStatus;

void print_value(const std::string& name, const CurveValue& value, const CurveFit& fit,
                 const std::string& remark = "") {
  fmt::print("  {:<15} {:<9} 95 % {}{}\n", name, number(value.value), whole_range(value.ci95),
             remark.empty() ? "" : "  " + remark);
  if (fit.num_bootstrap > 0) {
    fmt::print(
        "    bootstrap               95 % {}; corrected (BCa) {}\n",
        whole_range(value.bootstrap_ci95),
        value.bca_reason.empty() ? whole_range(value.bca_ci95) : "none: " + value.bca_reason);
  }
  if (value.posterior_median) {
    fmt::print("    posterior     {:<9} 95 % {}\n", number(value.posterior_median),
               whole_range(value.posterior_ci95));
  }
  for (std::size_t i = 0; i < value.posterior_medians_by_weight.size(); ++i) {
    fmt::print("      {:<9} prior of the rates: {}\n",
               number(value.posterior_medians_by_weight[i]),
               prior_weight_words(analysis::kOtherPriorWeights[i]));
  }
}

void print_rate(const std::string& name, const CurveValue& value, bool is_free,
                const CurveFit& fit) {
  if (is_free) {
    print_value(name, value, fit);
  } else {
    fmt::print("  {:<15} {:<9} known\n", name, number(value.value));
  }
}

void print_curve(const CurveFit& fit) {
  fmt::print(
      "  {} curve {}, {} level{}, {} trial{}\n", fit.model.falling ? "falling" : "rising",
      analysis::formula_words(fit.model.family, fit.model.is_logarithmic()), fit.num_levels,
      fit.num_levels == 1 ? "" : "s", fit.num_trials, fit.num_trials == 1 ? "" : "s");
  if (fit.status != FitStatus::kOk) {
    fmt::print("  no curve: {}\n", fit.reason);
  } else {
    print_value("location", fit.location, fit);
    print_value("scale", fit.scale, fit);
    print_rate("guess rate", fit.guess_rate, fit.model.free_guess, fit);
    print_rate("lapse rate", fit.lapse_rate, fit.model.free_lapse, fit);
    print_value("PSE", fit.pse, fit, "where the curve is half way up");
    print_value("JND", fit.jnd, fit, fmt::format("from 50 to {:.4g} %", 100.0 * fit.jnd_at));
    for (const analysis::CurveThreshold& one : fit.thresholds) {
      const double percent = 100.0 * one.proportion;
      if (one.is_by_proportion) {
        print_value(fmt::format("threshold {:.4g} %", percent), one.intensity, fit,
                    one.intensity.value
                        ? fmt::format("answered, which is level {:.4g} of the curve", one.at)
                        : "answered, which the curve never has");
      } else {
        print_value(fmt::format("threshold {:.4g}", one.at), one.intensity, fit,
                    fmt::format("{:.4g} % answered", percent));
      }
      print_value("  slope there", one.slope, fit);
    }
    fmt::print("  log-likelihood  {:<9} deviance {}, AIC {}, BIC {}\n",
               number(fit.log_likelihood), number(fit.deviance), number(fit.aic),
               number(fit.bic));
    if (fit.overdispersion) {
      fmt::print("  overdispersion  {:<9} Pearson's chi-squared over its degrees of freedom\n",
                 number(fit.overdispersion));
    }
    if (fit.goodness_p_value) {
      fmt::print("  goodness of fit {}\n", p_value_words(fit.goodness_p_value));
    }
    if (!fit.goodness_reason.empty()) {
      fmt::print("  goodness of fit not tested: {}\n", fit.goodness_reason);
    }
    if (fit.num_bootstrap > 0) {
      fmt::print("  bootstrap: {} refits, {}, {} without an optimum\n", fit.num_bootstrap,
                 fit.bootstrap_kind == analysis::BootstrapKind::kParametric
                     ? "answers drawn from the curve"
                     : "answers drawn from the answers",
                 fit.num_bootstrap_degenerate);
    }
  }
  if (!fit.posterior_priors.empty()) fmt::print("  priors: {}\n", fit.posterior_priors);
  if (!fit.posterior_note.empty()) fmt::print("  note: {}\n", fit.posterior_note);
  for (const std::string& warning : fit.warnings) fmt::print("  note: {}\n", warning);
}

/// "differs", or "differ" for several things. If no difference is found, it says no more than
/// that.
std::string verdict_of(const analysis::ComparisonTest& test) {
  const bool are_several = test.name == "all" || test.name == "rates";
  if (test.p_value < 0.05) return are_several ? "differ" : "differs";
  return are_several ? "are not seen to differ" : "is not seen to differ";
}

}  // namespace

void print_curves(const std::vector<std::string>& names, const std::vector<CurveFit>& fits,
                  const std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!names[i].empty()) fmt::print("{}\n", names[i]);
    print_curve(fits[i]);
  }
  for (const std::string& note : notes) fmt::print("note: {}\n", note);
}

void print_comparison(const analysis::CurveComparison& comparison) {
  fmt::print("comparison\n");
  if (comparison.status != FitStatus::kOk) {
    fmt::print("  none: {}\n", comparison.reason);
    return;
  }
  fmt::print("  {:<52} {:>10} {:>14} {:>10} {:>10}\n", "model", "parameters", "log-likelihood",
             "AIC", "BIC");
  for (const analysis::ComparedModel& one : comparison.models) {
    fmt::print("  {:<52} {:>10} {:>14} {:>10} {:>10}\n", one.name, one.num_parameters,
               number(one.log_likelihood), number(one.aic), number(one.bic));
  }
  fmt::print("  least AIC: {}; least BIC: {}\n", comparison.best_by_aic,
             comparison.best_by_bic);
  for (const analysis::ComparisonTest& one : comparison.tests) {
    fmt::print("  {:<10} {}: chi-squared {:.4g}, {} degree{} of freedom, {}\n",
               one.name == "rates" ? "the rates"
               : one.name == "all" ? "the curves"
                                   : one.name,
               verdict_of(one), one.statistic, one.degrees_of_freedom,
               one.degrees_of_freedom == 1 ? "" : "s", p_value_words(one.p_value));
  }
  for (const analysis::CurveContrast& one : comparison.contrasts) {
    fmt::print("  threshold {:.4g}, {} less {}: {}, 95 % {}; {} (Holm: {})\n", one.at,
               one.other, one.one, number(one.difference.value),
               whole_range(one.difference.ci95), p_value_words(one.p_value),
               number(one.p_value_holm));
    if (one.difference.bootstrap_ci95.low || one.difference.bootstrap_ci95.high) {
      fmt::print("    bootstrap 95 % {}\n", whole_range(one.difference.bootstrap_ci95));
    }
    if (one.ratio.value) {
      fmt::print("    ratio {}, 95 % {}\n", number(one.ratio.value),
                 whole_range(one.ratio.ci95));
    }
  }
  if (!comparison.reason.empty()) fmt::print("  note: {}\n", comparison.reason);
}

}  // namespace jnd::app
