#include "app/commands/fit_figures.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>

#include "analysis/fits/normal_tail.h"
#include "analysis/mixed/mixed_curves.h"
#include "analysis/report/single_figure.h"

namespace jnd::app {
namespace {

using analysis::DrawnCurve;
using analysis::FitStatus;

double normal_below(double z) { return analysis::normal_tails(z).lower; }

/// F of the fit's family at an intensity, without guesses and lapses.
double sigmoid_of(const analysis::PsychometricFit& fit, double intensity) {
  switch (fit.family) {
    case analysis::PsychometricFamily::kGauss:
      return normal_below((intensity - fit.parameters[0].value) / fit.parameters[1].value);
    case analysis::PsychometricFamily::kWeibull:
      return intensity > 0.0 ? -std::expm1(-std::pow(intensity / fit.parameters[0].value,
                                                     fit.parameters[1].value))
                             : 0.0;
    case analysis::PsychometricFamily::kWeber:
      break;
  }
  if (!(intensity > 0.0)) return 0.0;
  return normal_below(std::log(intensity / *fit.pse) / std::log1p(*fit.weber_fraction));
}

}  // namespace

void add_figure_option(CLI::App& command, std::string& figure) {
  command.add_option("--figure", figure, "also a picture: a new .svg, .pdf or .png")
      ->option_text("FILE");
}

std::vector<analysis::CurvePoint> points_of(const std::vector<analysis::AnswerCount>& rows) {
  std::map<double, analysis::CurvePoint> by_intensity;
  for (const analysis::AnswerCount& row : rows) {
    if (row.num_trials == 0) continue;
    analysis::CurvePoint& point = by_intensity[row.intensity];
    point.intensity = row.intensity;
    point.num_yes += static_cast<double>(row.num_yes);
    point.num_trials += static_cast<double>(row.num_trials);
  }
  std::vector<analysis::CurvePoint> points;
  for (const auto& [intensity, point] : by_intensity) points.push_back(point);
  return points;
}

DrawnCurve drawn_curve(const std::string& name, const std::vector<analysis::AnswerCount>& rows,
                       const analysis::PsychometricFit& fit) {
  DrawnCurve curve{.name = name, .points = points_of(rows)};
  if (fit.status != FitStatus::kOk || !fit.pse || !fit.weber_fraction) return curve;
  const double lapse = fit.lapse_rate.value_or(0.0);
  const double low = fit.guess_rate + (fit.symmetric_lapse ? lapse : 0.0), high = 1.0 - lapse;
  curve.probability = [fit, low, high](double intensity) {
    return low + (high - low) * sigmoid_of(fit, intensity);
  };
  if (fit.pse_ci95) {
    curve.thresholds = {{.at = 0.5,
                         .intensity = *fit.pse,
                         .proportion = 0.5 * (low + high),
                         .ci95 = *fit.pse_ci95}};
  }
  return curve;
}

DrawnCurve drawn_curve(const std::string& name, const std::vector<analysis::AnswerCount>& rows,
                       const analysis::DetectionFit& fit) {
  DrawnCurve curve{.name = name, .points = points_of(rows)};
  if (fit.status != FitStatus::kOk) return curve;
  const double guess = fit.false_alarm_rate.value_or(0.0);
  const double threshold = *fit.threshold, spread_ln = *fit.spread_ln;
  curve.probability = [=](double intensity) {
    if (!(intensity > 0.0)) return guess;
    return guess + (1.0 - guess) * normal_below(std::log(intensity / threshold) / spread_ln);
  };
  curve.thresholds = {{.at = 0.5,
                       .intensity = threshold,
                       .proportion = 0.5 * (1.0 + guess),
                       .ci95 = fit.threshold_ci95}};
  return curve;
}

DrawnCurve drawn_curve(const std::string& name, const std::vector<analysis::AnswerCount>& rows,
                       const analysis::SameDifferentFit& fit, double reference) {
  DrawnCurve curve{.name = name, .points = points_of(rows)};
  if (fit.status != FitStatus::kOk) return curve;
  const double criterion_ln = *fit.criterion_ln, spread_ln = std::log1p(*fit.weber_fraction);
  curve.probability = [=](double intensity) {
    return analysis::different_probability(intensity, reference, criterion_ln, spread_ln);
  };
  return curve;
}

void draw_glmm(const FitGlmmOptions& options, const GlmmResult& result,
               const std::string& figure) {
  const bool is_log = result.lines.axis == analysis::StimulusAxis::kLogarithmic;
  const analysis::MixedCurve how = {.link = *analysis::mixed_link(options.link),
                                    .guess_rate = std::stod(options.guess),
                                    .lapse_rate = std::stod(options.lapse)};
  std::vector<DrawnCurve> curves;
  for (const analysis::CellCurve& cell :
       analysis::cell_curves(result.lines, *result.design, result.table, options.stimulus,
                             result.fit, result.derived)) {
    DrawnCurve curve{.name = cell.name, .points = cell.points};
    curve.probability = [how, is_log, a = cell.offset, b = cell.slope](double x) {
      return analysis::curve_probability(how, a + b * (is_log ? std::log(x) : x));
    };
    if (cell.pse) {
      curve.thresholds = {
          {.at = 0.5,
           .intensity = *cell.pse,
           .proportion = how.guess_rate + 0.5 * (1.0 - how.guess_rate - how.lapse_rate),
           .ci95 = cell.pse_ci95}};
    }
    curves.push_back(std::move(curve));
  }
  analysis::write_single_figure(
      analysis::curve_figure(
          curves,
          {.intensity_name = options.stimulus,
           .answer_name = options.yes.empty() || options.yes == "num_yes"
                              ? (how.guess_rate > 0.0 ? "Proportion right" : "Proportion yes")
                              : "Proportion of " + options.yes,
           .logarithmic = is_log,
           .guess_rate = how.guess_rate}),
      figure);
}

}  // namespace jnd::app
