#include "analysis/hierarchical/hierarchical_json.h"

#include "analysis/statistics/json_values.h"

namespace jnd::analysis {

using namespace json_values;

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
  }
  return json;
}

}  // namespace jnd::analysis
