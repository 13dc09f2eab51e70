#include "analysis/fits/curve_json.h"

#include "analysis/statistics/json_values.h"

namespace jnd::analysis {
namespace {

using json_values::interval;
using json_values::number;
using json_values::sentence;
using CurveJson = nlohmann::ordered_json;

/// Adds `NAME_ci95` and, if they were asked for, the intervals of the bootstrap and the
/// posterior.
void add_uncertainty(CurveJson& json, const std::string& name, const CurveValue& value,
                     const CurveFit& fit) {
  json[name + "_ci95"] = interval(value.ci95);
  if (fit.num_bootstrap > 0) {
    json[name + "_bootstrap"] = {{"ci95", interval(value.bootstrap_ci95)},
                                 {"bca_ci95", interval(value.bca_ci95)},
                                 {"bca_reason", sentence(value.bca_reason)}};
  }
  if (!fit.posterior_priors.empty()) {
    json[name + "_posterior"] = {{"median", number(value.posterior_median)},
                                 {"ci95", interval(value.posterior_ci95)}};
    if (value.posterior_medians_by_weight.empty()) return;
    CurveJson medians = CurveJson::array();
    for (const auto& median : value.posterior_medians_by_weight) {
      medians.push_back(number(median));
    }
    json[name + "_posterior"]["medians_by_prior_weight"] = std::move(medians);
  }
}

void add_value(CurveJson& json, const std::string& name, const CurveValue& value,
               const CurveFit& fit) {
  json[name] = number(value.value);
  add_uncertainty(json, name, value, fit);
}

CurveJson to_json(const CurveThreshold& threshold, const CurveFit& fit) {
  CurveJson json = {
      {"at", number(threshold.at)},
      {"proportion",
       fit.status == FitStatus::kOk ? CurveJson(threshold.proportion) : CurveJson(nullptr)},
      {"value", number(threshold.intensity.value)},
      {"ci95", interval(threshold.intensity.ci95)}};
  CurveJson more;
  add_uncertainty(more, "value", threshold.intensity, fit);
  for (const char* key : {"bootstrap", "posterior"}) {
    if (more.contains(std::string("value_") + key))
      json[key] = more[std::string("value_") + key];
  }
  add_value(json, "slope", threshold.slope, fit);
  return json;
}

CurveJson contrast_value(const CurveValue& value) {
  return {{"value", number(value.value)},
          {"ci95", interval(value.ci95)},
          {"bootstrap_ci95", interval(value.bootstrap_ci95)}};
}

}  // namespace

CurveJson to_json(const CurveFit& fit) {
  const CurveModel& model = fit.model;
  CurveJson json = {
      {"status", to_string(fit.status)},
      {"reason", sentence(fit.reason)},
      {"family", traits_of(model.family).name},
      {"axis", model.is_logarithmic() ? "log" : "linear"},
      {"formula", formula_words(model.family, model.is_logarithmic())},
      {"falling", model.falling},
      {"num_trials", fit.num_trials},
      {"num_levels", fit.num_levels},
  };
  add_value(json, "location", fit.location, fit);
  add_value(json, "scale", fit.scale, fit);
  add_value(json, "guess_rate", fit.guess_rate, fit);
  json["guess_rate_is_free"] = model.free_guess;
  add_value(json, "lapse_rate", fit.lapse_rate, fit);
  json["lapse_rate_is_free"] = model.free_lapse;
  json["symmetric"] = model.symmetric;
  json["thresholds"] = CurveJson::array();
  for (const CurveThreshold& one : fit.thresholds) {
    json["thresholds"].push_back(to_json(one, fit));
  }
  add_value(json, "pse", fit.pse, fit);
  add_value(json, "jnd", fit.jnd, fit);
  json["jnd_at"] = fit.jnd_at;
  json["log_likelihood"] = number(fit.log_likelihood);
  json["deviance"] = number(fit.deviance);
  json["aic"] = number(fit.aic);
  json["bic"] = number(fit.bic);
  json["overdispersion"] = number(fit.overdispersion);
  json["goodness_p_value"] = number(fit.goodness_p_value);
  json["bootstrap"] = fit.num_bootstrap == 0
                          ? CurveJson(nullptr)
                          : CurveJson{{"n", fit.num_bootstrap},
                                      {"num_degenerate", fit.num_bootstrap_degenerate},
                                      {"kind", fit.bootstrap_kind == BootstrapKind::kParametric
                                                   ? "parametric"
                                                   : "nonparametric"}};
  json["posterior"] =
      fit.posterior_priors.empty()
          ? CurveJson(nullptr)
          : CurveJson{{"priors", fit.posterior_priors}, {"note", sentence(fit.posterior_note)}};
  if (!fit.pse.posterior_medians_by_weight.empty()) {
    json["posterior"]["prior_weights"] = kOtherPriorWeights;
  }
  json["warnings"] = fit.warnings;
  return json;
}

CurveJson to_json(const CurveComparison& comparison) {
  CurveJson json = {{"status", to_string(comparison.status)},
                    {"reason", sentence(comparison.reason)},
                    {"models", CurveJson::array()},
                    {"best_by_aic", sentence(comparison.best_by_aic)},
                    {"best_by_bic", sentence(comparison.best_by_bic)},
                    {"tests", CurveJson::array()},
                    {"contrasts", CurveJson::array()}};
  for (const ComparedModel& one : comparison.models) {
    json["models"].push_back({{"name", one.name},
                              {"num_parameters", one.num_parameters},
                              {"log_likelihood", number(one.log_likelihood)},
                              {"aic", number(one.aic)},
                              {"bic", number(one.bic)}});
  }
  for (const ComparisonTest& one : comparison.tests) {
    json["tests"].push_back({{"name", one.name},
                             {"statistic", number(one.statistic)},
                             {"degrees_of_freedom", one.degrees_of_freedom},
                             {"p_value", number(one.p_value)}});
  }
  for (const CurveContrast& one : comparison.contrasts) {
    json["contrasts"].push_back({{"one", one.one},
                                 {"other", one.other},
                                 {"at", one.at},
                                 {"difference", contrast_value(one.difference)},
                                 {"ratio", contrast_value(one.ratio)},
                                 {"p_value", number(one.p_value)},
                                 {"p_value_holm", number(one.p_value_holm)}});
  }
  return json;
}

}  // namespace jnd::analysis
