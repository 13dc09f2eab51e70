#include "analysis/fits/psychometric_json.h"

#include "analysis/statistics/json_values.h"

namespace jnd::analysis {
namespace {

using namespace json_values;

Json to_json(const PsychometricGoodness& goodness) {
  Json json = {{"n", goodness.n},
               {"p_value", number(goodness.p_value)},
               {"reason", sentence(goodness.reason)},
               {"degrees_of_freedom", goodness.degrees_of_freedom},
               {"overdispersion", number(goodness.overdispersion)},
               {"residual_level_correlation", number(goodness.level_correlation)},
               {"residual_level_p_value", number(goodness.level_correlation_p_value)},
               {"residuals", Json::array()}};
  for (const PsychometricGoodness::Residual& one : goodness.residuals) {
    json["residuals"].push_back({{"intensity", number(one.intensity)},
                                 {"fitted", number(one.fitted)},
                                 {"deviance_residual", number(one.deviance_residual)}});
  }
  return json;
}

Json to_json(const PsychometricPosterior& posterior) {
  Json json = {{"status", to_string(posterior.status)},
               {"reason", sentence(posterior.reason)},
               {"priors", sentence(posterior.priors)},
               {"note", sentence(posterior.note)},
               {"weber_fraction", number(posterior.weber_fraction)},
               {"weber_fraction_ci95", interval(posterior.weber_fraction_ci95)},
               {"pse", number(posterior.pse)},
               {"pse_ci95", posterior.pse_ci95 ? interval(*posterior.pse_ci95) : Json(nullptr)},
               {"lapse_rate", number(posterior.lapse_rate)}};
  if (posterior.prior_effects.empty()) return json;
  json["prior_sensitivity"] = Json::array();
  for (const PosteriorPriorEffect& one : posterior.prior_effects) {
    json["prior_sensitivity"].push_back(
        {{"weight", one.weight},
         {"lapse_prior", Json::array({one.prior.a, one.prior.b})},
         {"weber_fraction", number(one.weber_fraction)},
         {"pse", number(one.pse)},
         {"lapse_rate", number(one.lapse_rate)}});
  }
  return json;
}

}  // namespace

void add_psychometric_details(Json& json, const PsychometricFit& fit) {
  json["family"] = traits_of(fit.family).name;
  json["weber_fraction_meaning"] = weber_fraction_meaning(fit.guess_rate);
  json["parameters"] = Json::object();
  for (const PsychometricFit::Parameter& one : fit.parameters) {
    json["parameters"][std::string(one.name)] = number(one.value);
  }
  if (!fit.bootstrap.method.empty()) {
    json["bootstrap"]["bca_ci95"] = interval(fit.bootstrap.bca_ci95);
    json["bootstrap"]["bca_reason"] = sentence(fit.bootstrap.bca_reason);
    json["bootstrap"]["bias_correction"] = number(fit.bootstrap.bias_correction);
    json["bootstrap"]["acceleration"] = number(fit.bootstrap.acceleration);
  }
  const PsychometricCalibration& calibration = fit.calibration;
  json["calibration"] =
      calibration.n == 0
          ? Json(nullptr)
          : Json{{"n", calibration.n},
                 {"weber_fraction_drop", number(calibration.weber_fraction_drop)},
                 {"pse_drop", number(calibration.pse_drop)}};
  const PsychometricOverdispersion& scatter = fit.overdispersion;
  json["overdispersion"] = {{"model", to_string(scatter.model)},
                            {"factor", number(scatter.factor)},
                            {"correlation", number(scatter.correlation)},
                            {"log_likelihood", number(scatter.log_likelihood)}};
  json["goodness_of_fit"] =
      fit.goodness.residuals.empty() ? Json(nullptr) : to_json(fit.goodness);
  json["posterior"] =
      fit.posterior.status == FitStatus::kNotRun ? Json(nullptr) : to_json(fit.posterior);
  json["warnings"] = fit.warnings;
}

Json to_json(const PsychometricEffects& found) {
  Json json = {{"status", to_string(FitStatus::kOk)},
               {"ci95_method", kEffectInterval},
               {"p_value_method", kEffectTest},
               {"slope", number(found.slope)},
               {"slope_ci95", interval(found.slope_ci95)},
               {"effects", Json::array()},
               {"warnings", found.warnings}};
  for (const PsychometricEffect& effect : found.effects) {
    if (effect.status != FitStatus::kOk) json["status"] = to_string(effect.status);
    json["effects"].push_back({{"name", effect.name},
                               {"status", to_string(effect.status)},
                               {"reason", sentence(effect.reason)},
                               {"meaning", effect.meaning},
                               {"estimate", number(effect.estimate)},
                               {"ci95", interval(effect.ci95)},
                               {"statistic", number(effect.statistic)},
                               {"p_value", number(effect.p_value)}});
  }
  return json;
}

}  // namespace jnd::analysis
