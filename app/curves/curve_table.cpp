#include "app/curves/curve_table.h"

#include <fmt/format.h>

#include <cmath>

namespace jnd::app {
namespace {

using analysis::CurveFit;
using analysis::CurveValue;
using analysis::FitStatus;

/// A cell with a text, in quotes if it contains commas, quotes or line ends.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  return quoted + "\"";
}
std::string csv_number(const std::optional<double>& value) {
  return value ? fmt::format(",{:.17g}", *value) : ",";
}
std::string csv_value(const CurveValue& value) {
  return csv_number(value.value) + csv_number(value.ci95.low) + csv_number(value.ci95.high);
}

}  // namespace

std::string curves_as_csv(const std::vector<analysis::AnswerGroup>& groups,
                          const std::vector<CurveFit>& fits) {
  std::string text;
  if (!groups.empty()) {
    for (const auto& [column, value] : groups.front().key) text += csv_text(column) + ",";
  }
  text +=
      "status,reason,num_trials,location,location_low,location_high,scale,scale_low,"
      "scale_high,guess_rate,guess_rate_low,guess_rate_high,lapse_rate,lapse_rate_low,"
      "lapse_rate_high,pse,pse_low,pse_high,jnd,jnd_low,jnd_high,log_likelihood,deviance,aic,"
      "bic,overdispersion,at,proportion,threshold,threshold_low,threshold_high,slope,slope_low,"
      "slope_high\n";
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const CurveFit& fit = fits[i];
    std::string before;
    for (const auto& [column, value] : groups[i].key) before += csv_text(value) + ",";
    before += fmt::format("{},{},{}", analysis::to_string(fit.status), csv_text(fit.reason),
                          fit.num_trials);
    for (const CurveValue* value :
         {&fit.location, &fit.scale, &fit.guess_rate, &fit.lapse_rate, &fit.pse, &fit.jnd}) {
      before += csv_value(*value);
    }
    for (const auto& value :
         {fit.log_likelihood, fit.deviance, fit.aic, fit.bic, fit.overdispersion}) {
      before += csv_number(value);
    }
    for (const analysis::CurveThreshold& one : fit.thresholds) {
      const bool is_ok = fit.status == FitStatus::kOk;
      const bool has_level = std::isfinite(one.at);
      text += before + csv_number(has_level ? std::optional(one.at) : std::nullopt) +
              csv_number(is_ok ? std::optional(one.proportion) : std::nullopt) +
              csv_value(one.intensity) + csv_value(one.slope) + "\n";
    }
  }
  return text;
}

}  // namespace jnd::app
