#include "analysis/fits/fit_json.h"

#include "analysis/fits/psychometric_json.h"
#include "analysis/statistics/json_values.h"

namespace jnd::analysis {

using namespace json_values;

Json to_json(const PsychometricFit& fit) {
  Json json;
  json["status"] = to_string(fit.status);
  json["reason"] = sentence(fit.reason);
  json["method"] = to_string(fit.method);
  json["weber_fraction"] = number(fit.weber_fraction);
  json["weber_fraction_ci95"] = interval(fit.weber_fraction_ci95);
  json["standard_error"] = number(fit.standard_error);
  json["log_likelihood"] = number(fit.log_likelihood);
  json["deviance"] = number(fit.deviance);
  json["pse"] = number(fit.pse);
  json["pse_ci95"] = fit.pse_ci95 ? interval(*fit.pse_ci95) : Json(nullptr);
  json["guess_rate"] = fit.guess_rate;
  json["lapse_rate"] = number(fit.lapse_rate);
  json["lapses_at"] = fit.symmetric_lapse ? "both ends" : "upper end";
  json["r_squared"] = number(fit.r_squared);
  json["bootstrap"] = nullptr;
  if (!fit.bootstrap.method.empty()) {
    json["bootstrap"] = {{"n", fit.bootstrap.n},
                         {"ci95", interval(fit.bootstrap.ci95)},
                         {"method", fit.bootstrap.method},
                         {"num_degenerate", fit.bootstrap.num_degenerate}};
  }
  json["num_levels"] = fit.num_levels;
  json["num_trials"] = fit.num_trials;
  add_psychometric_details(json, fit);
  return json;
}

Json to_json(const PowerFit& fit) {
  Json json;
  json["status"] = to_string(fit.status);
  json["reason"] = sentence(fit.reason);
  json["method"] = to_string(fit.method);
  json["k"] = number(fit.k);
  json["a"] = number(fit.a);
  json["k_standard_error"] = number(fit.k_standard_error);
  json["a_standard_error"] = number(fit.a_standard_error);
  json["k_ci95"] = interval(fit.k_ci95);
  json["a_ci95"] = interval(fit.a_ci95);
  json["no_interval"] = sentence(fit.no_interval);
  json["r_squared"] = number(fit.r_squared);
  json["num_rows"] = fit.num_rows;
  json["num_at_zero"] = fit.num_at_zero;
  json["excluded"] = Json::array();
  for (const PowerFit::Excluded& excluded : fit.excluded) {
    json["excluded"].push_back({{"row", excluded.row + 1},
                                {"intensity", excluded.data.intensity},
                                {"magnitude", excluded.data.magnitude},
                                {"reason", excluded.reason}});
  }
  json["warnings"] = fit.warnings;
  return json;
}

Json to_json(const ShiftedPowerFit& fit) {
  Json json;
  json["status"] = to_string(fit.status);
  json["reason"] = sentence(fit.reason);
  json["method"] = to_string(fit.method);
  json["shift"] = to_string(fit.shift);
  json["k"] = number(fit.k);
  json["k_ci95"] = interval(fit.k_ci95);
  json["a"] = number(fit.a);
  json["a_ci95"] = interval(fit.a_ci95);
  json["intensity_threshold"] = number(fit.intensity_threshold);
  json["magnitude_offset"] = number(fit.magnitude_offset);
  json["shift_ci95"] = interval(fit.shift_ci95);
  json["shift_statistic"] = number(fit.shift_statistic);
  json["shift_p_value"] = number(fit.shift_p_value);
  json["no_interval"] = sentence(fit.no_interval);
  json["sum_of_squares"] = number(fit.sum_of_squares);
  json["r_squared"] = number(fit.r_squared);
  json["num_rows"] = fit.num_rows;
  json["num_left_out"] = fit.num_left_out;
  return json;
}

Json to_json(const Comparison& comparison) {
  Json json;
  json["status"] = to_string(comparison.status);
  json["reason"] = sentence(comparison.reason);
  json["method"] = comparison.method;
  json["estimate"] = number(comparison.estimate);
  json["ci95"] = interval(comparison.ci95);
  json["statistic"] = number(comparison.statistic);
  json["statistic_name"] = comparison.statistic_name;
  json["statistics"] = Json::object();
  for (const auto& [name, value] : comparison.all_statistics()) {
    json["statistics"][name] = number(value);
  }
  json["degrees_of_freedom"] = number(comparison.degrees_of_freedom);
  json["p_value"] = number(comparison.p_value);
  using Kind = Comparison::Kind;
  const Kind kind = comparison.kind;
  if (kind == Kind::kPaired || kind == Kind::kOneSample) {
    json["cohen_dz"] = number(comparison.cohen_dz);
    json["cohen_dz_ci95"] = interval(comparison.cohen_dz_ci95);
  }
  if (kind == Kind::kPaired || kind == Kind::kOneSample || kind == Kind::kWelch ||
      kind == Kind::kPooled) {
    json["hedges_g"] = number(comparison.hedges_g);
    json["hedges_g_ci95"] = interval(comparison.hedges_g_ci95);
  }
  if (kind == Kind::kWilcoxon || kind == Kind::kRankSum) {
    json["hodges_lehmann"] = number(comparison.hodges_lehmann);
    json["hodges_lehmann_ci95"] = interval(comparison.hodges_lehmann_ci95);
    json["rank_biserial"] = number(comparison.rank_biserial);
    json["rank_biserial_ci95"] = nullptr;
  }
  if (kind == Kind::kWilcoxon) json["num_zeros"] = comparison.num_zeros;
  json["num_a"] = comparison.num_a;
  json["num_b"] = comparison.num_b;
  return json;
}

Json to_json(const OmnibusTest& test) {
  Json json;
  json["status"] = to_string(test.status);
  json["reason"] = sentence(test.reason);
  json["method"] = test.method;
  json["num_people"] = test.num_people;
  json["num_conditions"] = test.num_conditions;
  json["statistic_name"] = test.statistic_name;
  json["statistic"] = number(test.statistic);
  json["degrees_of_freedom"] = number(test.degrees_of_freedom);
  json["p_value"] = number(test.p_value);
  if (test.statistic_name != "F") {
    json["concordance"] = number(test.concordance);
    return json;
  }
  json["error_degrees_of_freedom"] = number(test.error_degrees_of_freedom);
  const auto add = [&json](const std::string& name,
                           const std::optional<SphericityCorrection>& correction) {
    json["epsilon_" + name] = correction ? Json(correction->epsilon) : Json(nullptr);
    json["p_value_" + name] = correction ? Json(correction->p_value) : Json(nullptr);
  };
  add("greenhouse_geisser", test.greenhouse_geisser);
  add("huynh_feldt", test.huynh_feldt);
  json["mauchly_w"] = test.mauchly ? Json(test.mauchly->w) : Json(nullptr);
  json["mauchly_p_value"] = test.mauchly ? Json(test.mauchly->p_value) : Json(nullptr);
  json["partial_eta_squared"] = number(test.partial_eta_squared);
  json["generalized_eta_squared"] = number(test.generalized_eta_squared);
  return json;
}

Json to_json(const std::vector<PairwiseTest>& tests) {
  Json pairs = Json::array();
  for (const PairwiseTest& test : tests) {
    Json json = {{"a", test.a}, {"b", test.b}};
    json.update(to_json(test.comparison));
    json["p_value_holm"] = number(test.p_value_holm);
    pairs.push_back(std::move(json));
  }
  return pairs;
}

Json to_json(const EquivalenceTest& test) {
  const bool is_ratio = test.margin.scale == EquivalenceMargin::Scale::kRatio;
  Json json;
  json["status"] = to_string(test.status);
  json["reason"] = sentence(test.reason);
  json["scale"] = is_ratio ? "ratio" : "difference";
  json["margin"] = test.margin.size;
  json["estimate"] = number(test.estimate);
  json["ci90"] = interval(test.ci90);
  json["degrees_of_freedom"] = number(test.degrees_of_freedom);
  json["p_value"] = number(test.p_value);
  json["is_equivalent"] = test.is_equivalent();
  return json;
}

}  // namespace jnd::analysis
