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

}  // namespace jnd::analysis
