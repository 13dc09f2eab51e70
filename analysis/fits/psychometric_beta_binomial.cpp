#include "analysis/fits/psychometric_beta_binomial.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/log_product.h"

namespace jnd::analysis {
namespace {

constexpr double kLargestCorrelation = 1.0 - 1e-6;
/// Below these values a rate counts as being on its bound 0.
constexpr double kFewestLapses = 1e-7, kNoCorrelation = 1e-9;

/// Minus the log-likelihood of one level, with its derivatives by f and rho. The likelihood is
/// the product of f (1 - rho) + j rho over every yes and of (1 - f) (1 - rho) + j rho over
/// every no, divided by the product of 1 - rho + j rho over all answers, with j counting from
/// 0.
struct SpreadCost {
  double value, by_f, by_correlation;
};

SpreadCost level_cost(double yes, double no, double f, double g, double correlation) {
  const double rest = 1.0 - correlation;
  const LogProduct of_yes = log_product(f * rest, correlation, yes);
  const LogProduct of_no = log_product(g * rest, correlation, no);
  const LogProduct of_all = log_product(rest, correlation, yes + no);
  return {of_all.value - of_yes.value - of_no.value, rest * (of_no.by_first - of_yes.by_first),
          f * of_yes.by_first - of_yes.by_step + g * of_no.by_first - of_no.by_step -
              of_all.by_first + of_all.by_step};
}

/// Maps the parameters of the search to a curve and a correlation. The parameters are ln of the
/// spread (or, if asked for, ln of the Weber fraction for a curve over the intensity itself),
/// the place of the pse, and two angles. The squared sines of the angles are the lapse rate,
/// divided by its limit, and the correlation.
class SpreadModel {
 public:
  SpreadModel(const PsychometricLevels& levels, const FreeParameters& free, bool by_fraction)
      : levels_(levels), free_(free), by_fraction_(by_fraction) {}

  [[nodiscard]] std::size_t size() const { return correlation_at() + 1; }
  [[nodiscard]] std::size_t lapse_at() const { return free_[1] ? 2 : 1; }
  [[nodiscard]] std::size_t correlation_at() const { return lapse_at() + (free_[2] ? 1 : 0); }

  [[nodiscard]] PsychometricCurve curve(std::span<const double> x) const {
    const double place = free_[1] ? x[1] : 0.0;
    const double slope = slope_at(x[0], place);
    double lapse = levels_.ends.known_lapse;
    if (free_[2]) lapse = levels_.ends.lapse_limit() * squared_sine(x[lapse_at()]);
    return {slope, -slope * place, lapse};
  }
  [[nodiscard]] double correlation(std::span<const double> x) const {
    return kLargestCorrelation * squared_sine(x[correlation_at()]);
  }

  [[nodiscard]] std::vector<double> start(const PsychometricCurve& curve, double lapse_angle,
                                          double correlation_angle) const {
    const double place = free_[1] ? -curve.offset / curve.slope : 0.0;
    std::vector<double> x = {by_fraction_ ? std::log(curve.weber_fraction(levels_))
                                          : -std::log(curve.slope)};
    if (free_[1]) x.push_back(place);
    if (free_[2]) {
      const double angle = std::asin(std::sqrt(curve.lapse / levels_.ends.lapse_limit()));
      x.push_back(std::max(angle, lapse_angle));
    }
    x.push_back(correlation_angle);
    return x;
  }

  bool operator()(std::span<const double> x, double& value, std::span<double> gradient) const {
    const PsychometricCurve here = curve(x);
    const double rho = correlation(x);
    if (!(here.slope > 0.0) || !std::isfinite(here.slope)) return false;
    const PsychometricEnds& ends = levels_.ends;
    const double low = ends.low(here.lapse), rise = ends.rise(here.lapse);
    double by_slope = 0.0, by_place = 0.0, by_lapse = 0.0, by_rho = 0.0;
    value = 0.0;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const double distance = levels_.abscissa[level] - (free_[1] ? x[1] : 0.0);
      const SigmoidTails tails = sigmoid_tails(levels_.sigmoid, here.slope * distance);
      const double yes = levels_.num_yes[level], no = levels_.num_trials[level] - yes;
      const SpreadCost cost =
          level_cost(yes, no, low + rise * tails.lower, here.lapse + rise * tails.upper, rho);
      value += cost.value;
      by_slope += cost.by_f * rise * tails.density * distance;
      by_place -= cost.by_f * rise * tails.density * here.slope;
      by_lapse += cost.by_f * ends.by_lapse(tails.lower, tails.upper);
      by_rho += cost.by_correlation;
    }
    if (levels_.zero_trials > 0.0) {
      const SpreadCost cost = level_cost(
          levels_.zero_yes, levels_.zero_trials - levels_.zero_yes, low, 1.0 - low, rho);
      value += cost.value;
      by_lapse += cost.by_f * ends.low_by_lapse();
      by_rho += cost.by_correlation;
    }
    gradient[0] = -by_slope * here.slope;
    if (free_[1]) {
      gradient[1] = by_place;
      if (by_fraction_) {  // With a constant Weber fraction the spread grows with the pse.
        gradient[1] -= by_slope * here.slope * levels_.unit / levels_.intensity_at(x[1]);
      }
    }
    if (free_[2]) {
      gradient[lapse_at()] = by_lapse * ends.lapse_limit() * std::sin(2.0 * x[lapse_at()]);
    }
    gradient[correlation_at()] =
        by_rho * kLargestCorrelation * std::sin(2.0 * x[correlation_at()]);
    return std::isfinite(value) && std::all_of(gradient.begin(), gradient.end(),
                                               [](double part) { return std::isfinite(part); });
  }

 private:
  static double squared_sine(double angle) {
    const double sine = std::sin(angle);
    return sine * sine;
  }
  [[nodiscard]] double slope_at(double log_spread, double place) const {
    if (!by_fraction_) return std::exp(-log_spread);
    const double pse = levels_.intensity_at(place);
    return pse > 0.0
               ? sigmoid_jnd(levels_.sigmoid) * levels_.unit / (pse * std::exp(log_spread))
               : 0.0;
  }

  const PsychometricLevels& levels_;
  FreeParameters free_;
  bool by_fraction_;
};

/// The standard error of parameter 0, with parameters on a bound held there. The Hessian comes
/// from differences of the gradient.
std::optional<double> error_of_first(const SpreadModel& model, const LikelihoodOptimum& optimum,
                                     const FreeParameters& free) {
  constexpr double kStep = 1e-5;
  std::vector<std::size_t> moving;
  for (std::size_t at = 0; at < model.size(); ++at) {
    const bool no_lapse =
        free[2] && at == model.lapse_at() && model.curve(optimum.at).lapse < kFewestLapses;
    const bool alone =
        at == model.correlation_at() && model.correlation(optimum.at) < kNoCorrelation;
    if (!no_lapse && !alone) moving.push_back(at);
  }
  const auto size = static_cast<Eigen::Index>(moving.size());
  Eigen::MatrixXd hessian(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    std::vector<double> sides[2] = {std::vector<double>(model.size()),
                                    std::vector<double>(model.size())};
    for (const int side : {0, 1}) {
      std::vector<double> x = optimum.at;
      x[moving[static_cast<std::size_t>(column)]] += side == 0 ? -kStep : kStep;
      double value = 0.0;
      if (!model(x, value, sides[side])) return std::nullopt;
    }
    for (Eigen::Index row = 0; row < size; ++row) {
      const std::size_t at = moving[static_cast<std::size_t>(row)];
      hessian(row, column) = (sides[1][at] - sides[0][at]) / (2.0 * kStep);
    }
  }
  const double variance = hessian.inverse()(0, 0);
  return variance > 0.0 && std::isfinite(variance) ? std::optional(std::sqrt(variance))
                                                   : std::nullopt;
}

}  // namespace

BetaBinomialFit fit_beta_binomial(const PsychometricLevels& levels, const FreeParameters& free,
                                  const PsychometricCurve& start, bool intervals) {
  constexpr double kFarthest = 12.0;  // In ln spread. Beyond it the curve is a step or flat.
  BetaBinomialFit fit;
  const SpreadModel spread(levels, free, false);
  const auto starts_of = [&](const SpreadModel& model, const PsychometricCurve& curve) {
    std::vector<std::vector<double>> starts;
    for (const double correlation_angle : {0.05, 0.3}) {
      starts.push_back(model.start(curve, 0.05, correlation_angle));
    }
    if (free[2]) starts.push_back(model.start(curve, 0.3, 0.1));
    return starts;
  };
  const LikelihoodOptimum found = likelihood_optimum(spread, starts_of(spread, start));
  fit.curve = spread.curve(found.at);
  fit.correlation = spread.correlation(found.at);
  fit.log_likelihood = -found.cost;
  if (fit.correlation < kNoCorrelation) fit.correlation = 0.0;
  if (fit.curve.lapse < kFewestLapses && free[2]) fit.curve.lapse = 0.0;
  if (!found.converged) {
    const double change = std::fabs(std::log(fit.curve.slope / start.slope));
    fit.status = change > 5.0 ? FitStatus::kDegenerate : FitStatus::kNotConverged;
    fit.reason =
        change > 5.0
            ? "with answers that scatter so far no slope is better than the steepest or "
              "the flattest"
            : "the search for the optimum with overdispersion did not come to rest";
    return fit;
  }
  fit.status = FitStatus::kOk;
  const bool linear = !levels.logarithmic();
  const bool relative = !linear || fit.curve.pse(levels) > 0.0;
  // For a curve over the intensity itself, w depends on more than the spread.
  const SpreadModel fraction(levels, free, linear && relative);
  LikelihoodOptimum at_fraction = found;
  if (linear && relative) at_fraction.at[0] = std::log(fit.curve.weber_fraction(levels));
  if (relative) {
    const double w = fit.curve.weber_fraction(levels);
    const double by_first =
        linear ? w : (1.0 + w) * std::log1p(w);  // This is dw / dx for w = exp(c exp(x)) - 1.
    if (const auto error = error_of_first(fraction, at_fraction, free)) {
      fit.standard_error = *error * by_first;
    }
  }
  if (!intervals) return fit;
  const std::vector<std::vector<double>> starts = starts_of(fraction, fit.curve);
  if (relative) {
    const Interval ends =
        likelihood_ratio_interval(fraction, at_fraction, starts, 0, kFarthest);
    const auto value = [&](const std::optional<double>& end) -> std::optional<double> {
      if (!end) return std::nullopt;
      const double w =
          linear ? std::exp(*end) : levels.weber_fraction_at(std::exp(-*end), levels.origin);
      return std::isfinite(w) ? std::optional(w) : std::nullopt;
    };
    fit.weber_fraction_ci95 = {value(ends.low), value(ends.high)};
  }
  if (free[1]) {
    const Interval ends =
        likelihood_ratio_interval(spread, found, starts_of(spread, fit.curve), 1, kFarthest);
    const auto value = [&](const std::optional<double>& end) {
      return end ? std::optional(levels.intensity_at(*end)) : std::nullopt;
    };
    fit.pse_ci95 = Interval{value(ends.low), value(ends.high)};
  }
  return fit;
}

}  // namespace jnd::analysis
