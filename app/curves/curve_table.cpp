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

/// Which columns stand after those that every table has.
struct AskedColumns {
  bool bootstrap = false, posterior = false;
};

AskedColumns columns_asked_for(const std::vector<CurveFit>& fits) {
  AskedColumns asked;
  for (const CurveFit& fit : fits) {
    asked.bootstrap = asked.bootstrap || fit.num_bootstrap > 0;
    asked.posterior = asked.posterior || !fit.posterior_priors.empty();
  }
  return asked;
}

std::string csv_header_of(const AskedColumns& asked) {
  std::string names;
  for (const char* of : {"pse", "jnd", "threshold", "slope"}) {
    if (asked.bootstrap) {
      names +=
          fmt::format(",{0}_bootstrap_low,{0}_bootstrap_high,{0}_bca_low,{0}_bca_high", of);
    }
    if (asked.posterior) {
      names += fmt::format(",{0}_posterior_median,{0}_posterior_low,{0}_posterior_high", of);
    }
  }
  return names;
}

std::string csv_value_of(const AskedColumns& asked, const CurveValue& value) {
  std::string cells;
  if (asked.bootstrap) {
    for (const analysis::Interval* interval : {&value.bootstrap_ci95, &value.bca_ci95}) {
      cells += csv_number(interval->low) + csv_number(interval->high);
    }
  }
  if (asked.posterior) {
    cells += csv_number(value.posterior_median) + csv_number(value.posterior_ci95.low) +
             csv_number(value.posterior_ci95.high);
  }
  return cells;
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
      "slope_high";
  const AskedColumns asked = columns_asked_for(fits);
  text += csv_header_of(asked) + "\n";
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
              csv_value(one.intensity) + csv_value(one.slope);
      for (const CurveValue* value : {&fit.pse, &fit.jnd, &one.intensity, &one.slope}) {
        text += csv_value_of(asked, *value);
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace jnd::app
