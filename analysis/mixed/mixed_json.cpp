#include "analysis/mixed/mixed_json.h"

#include "analysis/statistics/json_values.h"

namespace jnd::analysis {

nlohmann::ordered_json to_json(const MixedFit& fit) {
  using json_values::number;
  using MixedJson = nlohmann::ordered_json;
  const bool is_there = fit.status == FitStatus::kOk;
  MixedJson json = {{"status", to_string(fit.status)},
                    {"reason", json_values::sentence(fit.reason)},
                    {"fixed", MixedJson::array()},
                    {"random", MixedJson::array()}};
  for (const FixedEffect& one : fit.fixed) {
    json["fixed"].push_back({{"name", one.name},
                             {"estimate", number(one.estimate)},
                             {"standard_error", number(one.standard_error)},
                             {"z", number(one.z)},
                             {"p", number(one.p)}});
  }
  for (const RandomEffect& one : fit.random) {
    json["random"].push_back({{"group", one.group},
                              {"name", one.name},
                              {"sd", number(one.sd)},
                              {"correlations", one.correlations}});
  }
  const auto if_there = [is_there](double value) {
    return is_there ? number(value) : MixedJson(nullptr);
  };
  json["log_likelihood"] = if_there(fit.log_likelihood);
  json["aic"] = if_there(fit.aic);
  json["bic"] = if_there(fit.bic);
  json["num_parameters"] = fit.num_parameters;
  json["num_rows"] = fit.num_rows;
  return json;
}

nlohmann::ordered_json to_json(const std::vector<DerivedQuantity>& derived,
                               bool has_bootstrap) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const DerivedQuantity& one : derived) {
    nlohmann::ordered_json json = {{"name", one.name},
                                   {"value", json_values::number(one.value)},
                                   {"standard_error", json_values::number(one.standard_error)},
                                   {"ci95", json_values::interval(one.ci95)}};
    if (has_bootstrap) json["bootstrap_ci95"] = json_values::interval(one.bootstrap_ci95);
    all.push_back(std::move(json));
  }
  return all;
}

nlohmann::ordered_json to_json(const PeoplePowerFit& fit) {
  using json_values::number;
  using PowerJson = nlohmann::ordered_json;
  PowerJson json = {{"status", to_string(fit.status)},
                    {"reason", json_values::sentence(fit.reason)},
                    {"method", "reml"},
                    {"k", number(fit.k)},
                    {"a", number(fit.a)},
                    {"k_standard_error", number(fit.k_standard_error)},
                    {"a_standard_error", number(fit.a_standard_error)},
                    {"k_ci95", json_values::interval(fit.k_ci95)},
                    {"a_ci95", json_values::interval(fit.a_ci95)},
                    {"interval_method", json_values::sentence(fit.interval_method)},
                    {"degrees_of_freedom", number(fit.degrees_of_freedom)}};
  json["between_people"] = {{"ln_k_sd", number(fit.ln_k_sd)},
                            {"a_sd", number(fit.a_sd)},
                            {"correlation", number(fit.correlation)}};
  json["residual_sd_ln"] = number(fit.residual_sd_ln);
  json["log_likelihood"] = number(fit.log_likelihood);
  json["people"] = PowerJson::array();
  for (const PeoplePowerFit::Person& one : fit.people) {
    json["people"].push_back({{"participant", one.participant},
                              {"num_rows", one.num_rows},
                              {"k", number(one.k)},
                              {"a", number(one.a)},
                              {"own_k", number(one.own_k)},
                              {"own_a", number(one.own_a)}});
  }
  json["num_people"] = fit.num_people;
  json["num_rows"] = fit.num_rows;
  json["excluded"] = PowerJson::array();
  for (const PowerFit::Excluded& excluded : fit.excluded) {
    json["excluded"].push_back({{"row", excluded.row + 1},
                                {"intensity", excluded.data.intensity},
                                {"magnitude", excluded.data.magnitude},
                                {"reason", excluded.reason}});
  }
  json["warnings"] = fit.warnings;
  return json;
}

}  // namespace jnd::analysis
