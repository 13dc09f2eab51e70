#include "app/operator/data_results.h"

#include <cmath>

#include "app/curves/fit_words.h"
#include "app/language/words.h"

namespace jnd::app {
namespace {

using analysis::CurveFit;
using analysis::CurveValue;
using analysis::FitStatus;

/// Which intervals of a fit are shown. Every fit has those of the likelihood ratio; a request
/// may ask for others.
enum class IntervalKind { kLikelihoodRatio, kBootstrap, kPosterior };

IntervalKind interval_kind_of(const CurveRequest& request) {
  if (request.num_bootstrap > 0) return IntervalKind::kBootstrap;
  return request.posterior ? IntervalKind::kPosterior : IntervalKind::kLikelihoodRatio;
}

std::string title_of(IntervalKind kind) {
  switch (kind) {
    case IntervalKind::kBootstrap:
      return tr("Fits, with 95 % by the bootstrap");
    case IntervalKind::kPosterior:
      return tr("Fits, with 95 % of the posterior");
    case IntervalKind::kLikelihoodRatio:
      break;
  }
  return tr("Fits, with 95 % by the likelihood ratio");
}

DataValue data_value(const CurveValue& value,
                     IntervalKind kind = IntervalKind::kLikelihoodRatio) {
  const analysis::Interval& interval = kind == IntervalKind::kBootstrap   ? value.bootstrap_ci95
                                       : kind == IntervalKind::kPosterior ? value.posterior_ci95
                                                                          : value.ci95;
  return {number(value.value), value.value ? whole_range(interval) : ""};
}

/// What one should know about a value besides its interval.
std::string remark_on(const CurveValue& value, IntervalKind kind, const std::string& remark) {
  std::string words = remark;
  const auto add = [&words](const std::string& more) {
    words += (words.empty() ? "" : " · ") + more;
  };
  if (kind == IntervalKind::kBootstrap && value.value) {
    add(value.bca_reason.empty() ? tr("corrected (BCa) {}", whole_range(value.bca_ci95))
                                 : tr("no corrected (BCa) interval: {}", value.bca_reason));
  }
  if (kind == IntervalKind::kPosterior && value.posterior_median) {
    add(tr("median of the posterior {}", number(value.posterior_median)));
  }
  return words;
}

std::vector<DataNumber> numbers_of(const CurveFit& fit, const CurveRequest& request) {
  const IntervalKind kind = interval_kind_of(request);
  std::vector<DataNumber> all;
  const auto add = [&](std::string name, const CurveValue& value, std::string remark = "") {
    all.push_back({std::move(name), data_value(value, kind), remark_on(value, kind, remark)});
  };
  const auto add_rate = [&](const char* name, const CurveValue& value, bool is_free) {
    if (is_free) return add(name, value);
    all.push_back({name, {number(value.value), ""}, tr("known")});
  };
  add(tr("location"), fit.location);
  add(tr("scale"), fit.scale);
  add_rate(tr("guess rate"), fit.guess_rate, fit.model.free_guess);
  add_rate(tr("lapse rate"), fit.lapse_rate, fit.model.free_lapse);
  add(tr("PSE"), fit.pse, tr("where the curve is half way up"));
  add(tr("JND"), fit.jnd, tr("from 50 to {:.4g} %", 100.0 * fit.jnd_at));
  for (const analysis::CurveThreshold& one : fit.thresholds) {
    add(tr("threshold {:.4g}", one.at), one.intensity,
        tr("{:.4g} % answered", 100.0 * one.proportion));
    add(tr("slope there"), one.slope);
  }
  const auto add_plain = [&](const char* name, const std::optional<double>& value,
                             std::string remark = "") {
    all.push_back({name, {number(value), ""}, std::move(remark)});
  };
  add_plain(tr("log-likelihood"), fit.log_likelihood);
  add_plain(tr("deviance"), fit.deviance,
            trn("of {} level", "of {} levels", std::int64_t{fit.num_levels}));
  add_plain("AIC", fit.aic);
  add_plain("BIC", fit.bic);
  if (fit.overdispersion) {
    add_plain(tr("overdispersion"), fit.overdispersion,
              tr("Pearson's chi-squared over its degrees of freedom"));
  }
  if (fit.goodness_p_value) {
    add_plain(tr("goodness of fit, p"), fit.goodness_p_value,
              trn("by {} redraw", "by {} redraws", std::int64_t{request.num_goodness}));
  }
  if (fit.num_bootstrap > 0) {
    all.push_back({tr("refits without optimum"),
                   {std::to_string(fit.num_bootstrap_degenerate), ""},
                   trn("of {} refit", "of {} refits", std::int64_t{fit.num_bootstrap})});
  }
  return all;
}

DataGroup data_group(const std::string& name, const CurveFit& fit,
                     const CurveRequest& request) {
  const IntervalKind kind = interval_kind_of(request);
  DataGroup group{.name = name.empty() ? tr("all rows") : name, .num_trials = fit.num_trials};
  group.cautions = fit.warnings;
  if (!fit.goodness_reason.empty()) {
    group.cautions.push_back(tr("The goodness of fit is not tested: {}", fit.goodness_reason));
  }
  if (!fit.posterior_priors.empty()) {
    group.cautions.push_back(tr("Priors of the posterior: {}", fit.posterior_priors));
  }
  if (!fit.posterior_note.empty()) group.cautions.push_back(fit.posterior_note);
  if (fit.status != FitStatus::kOk) {
    group.reason = fit.reason;
    return group;
  }
  group.location = data_value(fit.location, kind);
  group.scale = data_value(fit.scale, kind);
  group.pse = data_value(fit.pse, kind);
  group.jnd = data_value(fit.jnd, kind);
  for (const analysis::CurveThreshold& one : fit.thresholds) {
    group.thresholds.push_back(data_value(one.intensity, kind));
  }
  group.deviance = number(fit.deviance);
  group.numbers = numbers_of(fit, request);
  return group;
}

std::vector<std::string> data_notes(const CurveAnalysis& curves) {
  std::vector<std::string> notes;
  const analysis::AnswerFile& file = curves.file;
  if (file.num_elsewhere > 0) {
    notes.push_back(tr("{} of {} rows are left out: they have other cells than those asked for",
                       file.num_elsewhere, file.num_rows));
  }
  for (const auto& [column, count] : file.num_missing) {
    notes.push_back(tr("{} of {} rows are left out: they have nothing in the column {}", count,
                       file.num_rows, column));
  }
  for (const auto& [column, count] : file.num_pooled) {
    notes.push_back(tr(
        "Answers of {} values of the column {} are added up into one curve, which is flatter "
        "than theirs where they differ; group by it to fit each of them",
        count, column));
  }
  if (curves.found_falling) {
    notes.emplace_back(
        tr("The answers fall as the intensity grows, so a falling curve is fitted"));
  }
  return notes;
}

std::string y_title_of(const CurveRequest& request, bool has_chance) {
  if (!request.yes.empty() && request.yes != "num_yes") return tr("percent of {}", request.yes);
  return has_chance ? tr("percent right") : tr("percent yes");
}

DataVerdict verdict_of(const analysis::ComparisonTest& test) {
  const bool differs = test.p_value < 0.05;
  std::string what;
  if (test.name == "location") {
    what = differs ? tr("The location differs") : tr("The location is not seen to differ");
  } else if (test.name == "scale") {
    what = differs ? tr("The scale differs") : tr("The scale is not seen to differ");
  } else if (test.name == "rates") {
    what = differs ? tr("The rates differ") : tr("The rates are not seen to differ");
  } else {
    what = differs ? tr("The curves differ") : tr("The curves are not seen to differ");
  }
  const std::string found =
      trn("chi-squared {1:.4g}, {0} degree of freedom, {2}",
          "chi-squared {1:.4g}, {0} degrees of freedom, {2}",
          std::int64_t{test.degrees_of_freedom}, test.statistic, p_value_words(test.p_value));
  return {what + ": " + found, differs};
}

}  // namespace

DataResults data_results(const CurveAnalysis& curves) {
  const analysis::CurveModel& model = curves.how.model;
  const std::string formula = analysis::formula_words(model.family, model.is_logarithmic());
  DataResults results{.formula = model.falling ? tr("falling curve {}", formula)
                                               : tr("rising curve {}", formula),
                      .title = title_of(interval_kind_of(curves.request)),
                      .levels = curves.request.at,
                      .is_logarithmic = model.is_logarithmic(),
                      .x_title = curves.request.intensity,
                      .notes = data_notes(curves)};
  if (model.guess_rate > 0.0 && !model.free_guess) results.chance = model.guess_rate;
  results.y_title = y_title_of(curves.request, results.chance.has_value());
  if (curves.suspected_chance) {
    results.suspected_alternatives =
        static_cast<int>(std::lround(1.0 / *curves.suspected_chance));
    return results;
  }
  for (std::size_t i = 0; i < curves.fits.size(); ++i) {
    results.groups.push_back(data_group(curves.names[i], curves.fits[i], curves.request));
  }
  results.tables = picture_tables(curves);
  return results;
}

DataComparison data_comparison(const analysis::CurveComparison& comparison) {
  DataComparison told{.reason = comparison.reason};
  if (comparison.status != FitStatus::kOk) return told;
  for (const analysis::ComparisonTest& test : comparison.tests) {
    told.verdicts.push_back(verdict_of(test));
  }
  for (const analysis::CurveContrast& one : comparison.contrasts) {
    told.contrasts.push_back({.one = one.one,
                              .other = one.other,
                              .at = number(one.at),
                              .difference = data_value(one.difference),
                              .ratio = data_value(one.ratio),
                              .p_value = number(one.p_value),
                              .p_value_holm = number(one.p_value_holm),
                              .differs = one.p_value_holm && *one.p_value_holm < 0.05});
  }
  for (const analysis::ComparedModel& one : comparison.models) {
    told.models.push_back({.name = one.name,
                           .num_parameters = one.num_parameters,
                           .log_likelihood = number(one.log_likelihood),
                           .aic = number(one.aic),
                           .bic = number(one.bic),
                           .has_least_aic = one.name == comparison.best_by_aic,
                           .has_least_bic = one.name == comparison.best_by_bic});
  }
  return told;
}

}  // namespace jnd::app
