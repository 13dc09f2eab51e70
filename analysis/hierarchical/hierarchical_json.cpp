#include "analysis/hierarchical/hierarchical_json.h"

#include "analysis/statistics/json_values.h"

namespace jnd::analysis {

using namespace json_values;

namespace {

Json json_numbers(const std::vector<std::optional<double>>& values) {
  Json all = Json::array();
  for (const std::optional<double>& value : values) all.push_back(number(value));
  return all;
}

/// Adds the results that are present only if they were asked for.
void add_robust(Json& json, const HierarchicalFit& fit) {
  if (fit.scatter) {
    const HierarchicalScatter& one = *fit.scatter;
    json["overdispersion"] = {
        {"rho", number(one.correlation)},
        {"rho_ci95", interval(one.correlation_ci95)},
        {"log_likelihood_without", number(one.log_likelihood_without)},
        {"statistic", number(one.statistic)},
        {"p_value", number(one.p_value)},
        {"weber_fractions_without", json_numbers(one.weber_fractions_without)}};
  }
  if (fit.own_lapses) {
    const HierarchicalOwnLapses& one = *fit.own_lapses;
    json["lapse_angle_sd"] = number(one.angle_sd);
    json["mean_lapse_rate"] = number(one.mean_lapse_rate);
    json["common_lapses"] = {{"lapse_rate", number(one.common_lapse_rate)},
                             {"log_likelihood", number(one.log_likelihood_common)},
                             {"statistic", number(one.statistic)},
                             {"p_value", number(one.p_value)},
                             {"weber_fractions", json_numbers(one.weber_fractions_common)}};
  }
  if (fit.prior_effects.empty()) return;
  json["lapse_prior"] = Json::array({fit.lapse_prior.a, fit.lapse_prior.b});
  json["prior_sensitivity"] = Json::array();
  for (const HierarchicalPriorEffect& one : fit.prior_effects) {
    json["prior_sensitivity"].push_back(
        {{"weight", one.weight},
         {"lapse_prior", Json::array({one.prior.a, one.prior.b})},
         {"lapse_rate", number(one.lapse_rate)},
         {"weber_fractions", json_numbers(one.weber_fractions)}});
  }
}

}  // namespace

Json to_json(const HierarchicalFit& fit) {
  Json json = {{"status", to_string(fit.status)},
               {"reason", sentence(fit.reason)},
               {"method", sentence(fit.method)},
               {"estimand", "median person"},
               {"note", sentence(fit.note)},
               {"num_participants", fit.num_participants},
               {"num_nodes", fit.num_nodes},
               {"log_likelihood", number(fit.log_likelihood)},
               {"lapse_rate", number(fit.lapse_rate)},
               {"lapse_rate_ci95", interval(fit.lapse_rate_ci95)},
               {"lapse_rate_with_prior_ci95", interval(fit.lapse_rate_with_prior_ci95)},
               {"lapse_rate_without_prior", number(fit.lapse_rate_without_prior)},
               {"guess_rate", fit.guess_rate},
               {"correlation", number(fit.correlation)},
               {"conditions", Json::array()},
               {"differences", Json::array()},
               {"participants", Json::array()}};
  for (const HierarchicalCondition& one : fit.conditions) {
    json["conditions"].push_back(
        {{"condition", one.condition},
         {"num_participants", one.num_participants},
         {"weber_fraction", number(one.weber_fraction)},
         {"weber_fraction_ci95", interval(one.weber_fraction_ci95)},
         {"weber_fraction_without_prior", number(one.weber_fraction_without_prior)},
         {"easy_ratio", one.easy_ratio},
         {"cautions", one.cautions},
         {"pse", number(one.pse)},
         {"pse_ci95", one.pse_ci95 ? interval(*one.pse_ci95) : Json(nullptr)},
         {"slope", number(one.slope_number)},
         {"slope_standard_error", number(one.slope_standard_error)},
         {"slope_sd", number(one.slope_sd)},
         {"place", number(one.place_number)},
         {"place_standard_error", number(one.place_standard_error)},
         {"place_sd", number(one.place_sd)}});
  }
  for (const HierarchicalDifference& one : fit.differences) {
    json["differences"].push_back({{"first", one.first},
                                   {"second", one.second},
                                   {"estimate", number(one.estimate)},
                                   {"standard_error", number(one.standard_error)},
                                   {"ci95", interval(one.ci95)},
                                   {"statistic", number(one.statistic)},
                                   {"degrees_of_freedom", number(one.degrees_of_freedom)},
                                   {"p_value", number(one.p_value)}});
  }
  for (const HierarchicalPersonEstimate& one : fit.participants) {
    json["participants"].push_back({{"participant", one.participant},
                                    {"condition", one.condition},
                                    {"weber_fraction", number(one.weber_fraction)},
                                    {"reason", sentence(one.reason)},
                                    {"cautions", one.cautions}});
    if (one.lapse_rate) json["participants"].back()["lapse_rate"] = number(one.lapse_rate);
  }
  add_robust(json, fit);
  return json;
}

}  // namespace jnd::analysis
