#include "analysis/fits/curve_comparison.h"

#include <algorithm>
#include <cmath>

#include "analysis/fits/curve_contrast.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using Shared = JointCurves::Shared;

constexpr std::size_t kMostLevelsCompared = 1024;
constexpr std::size_t kMostContrasted = 30;

/// The value on the axis, x or ln x, at place 0 of the abscissa.
double axis_origin(const PsychometricLevels& levels) {
  return levels.logarithmic() ? std::log(levels.origin) : levels.origin;
}

double rate_angle(double rate, double limit) {
  return std::asin(std::sqrt(std::clamp(rate / limit, 0.0, 1.0)));
}

double chi_squared_p(double statistic, int degrees_of_freedom) {
  return chi_squared_above(std::max(0.0, statistic), degrees_of_freedom);
}

std::string name_of(const Shared& shared, bool has_rates) {
  const auto word = [](bool same) { return std::string(same ? "same " : "different "); };
  std::string name = word(shared.location) + "location, " + word(shared.scale) + "scale";
  if (has_rates) name += ", " + word(shared.rates) + "rates";
  return name;
}

}  // namespace

JointCurves::JointCurves(const std::vector<FoundCurve>& groups, const CurveModel& model)
    : location_level_(traits_of(model.family).at_location), free_(groups.front().free) {
  double low = core::kInfinity, high = -core::kInfinity;
  for (const FoundCurve& group : groups) {
    const double origin = axis_origin(group.levels), unit = group.levels.unit;
    low = std::min(low, origin + unit * group.levels.abscissa.front());
    high = std::max(high, origin + unit * group.levels.abscissa.back());
  }
  const double middle = 0.5 * (low + high), unit = high > low ? 0.5 * (high - low) : 1.0;
  const double z = sigmoid_quantile(groups.front().levels.sigmoid, location_level_);
  known_ = groups.front().found.optimum.curve;
  for (const FoundCurve& group : groups) {
    PsychometricLevels levels = binned(group.levels, kMostLevelsCompared);
    const double origin = axis_origin(levels), its_unit = levels.unit;
    for (double& place : levels.abscissa) place = (origin + its_unit * place - middle) / unit;
    levels.origin = levels.logarithmic() ? std::exp(middle) : middle;
    levels.unit = unit;
    const PsychometricCurve& curve = group.found.optimum.curve;
    const double place = (z - curve.offset) / curve.slope;
    std::vector<double> at = {(origin + its_unit * place - middle) / unit,
                              std::log(curve.slope * unit / its_unit)};
    if (free_[2]) at.push_back(rate_angle(curve.lapse, levels.ends.largest_lapse()));
    if (free_[3]) at.push_back(rate_angle(curve.guess, levels.ends.largest_guess()));
    levels_.push_back(std::move(levels));
    double value = 0.0;
    std::vector<double> gradient(at.size());
    static_cast<void>(cost(levels_.size() - 1, location_level_, at, value, gradient));
    found_.push_back(std::move(at));
    found_cost_.push_back(value);
  }
}

bool JointCurves::cost(std::size_t group, double level, std::span<const double> x,
                       double& value, std::span<double> gradient) const {
  constexpr double kLargestLog = 300.0;
  if (!(std::fabs(x[1]) < kLargestLog)) return false;
  const PsychometricLevels& levels = levels_[group];
  const double z = sigmoid_quantile(levels.sigmoid, level);
  const double slope = std::exp(x[1]);
  PsychometricCurve curve = {slope, z - slope * x[0], known_.lapse, known_.guess};
  const double largest_lapse = levels.ends.largest_lapse();
  const double largest_guess = levels.ends.largest_guess();
  std::size_t next = 2;
  const std::size_t lapse = free_[2] ? next++ : 0, guess = free_[3] ? next : 0;
  if (lapse > 0) curve.lapse = largest_lapse * std::pow(std::sin(x[lapse]), 2);
  if (guess > 0) curve.guess = largest_guess * std::pow(std::sin(x[guess]), 2);
  const PsychometricCost here =
      psychometric_cost(levels, PsychometricMethod::kMaximumLikelihood, curve);
  value = here.value;
  gradient[0] = -slope * here.gradient(1);
  gradient[1] = slope * (here.gradient(0) - x[0] * here.gradient(1));
  if (lapse > 0) gradient[lapse] = here.gradient(2) * largest_lapse * std::sin(2.0 * x[lapse]);
  if (guess > 0) gradient[guess] = here.gradient(3) * largest_guess * std::sin(2.0 * x[guess]);
  return std::isfinite(value) && std::ranges::all_of(gradient.first(x.size()), [](double part) {
           return std::isfinite(part);
         });
}

std::vector<double> JointCurves::at_level(std::size_t group, double level) const {
  std::vector<double> x = found_[group];
  const Sigmoid sigmoid = levels_[group].sigmoid;
  x[0] += (sigmoid_quantile(sigmoid, level) - sigmoid_quantile(sigmoid, location_level_)) /
          std::exp(x[1]);
  return x;
}

int JointCurves::num_parameters(const Shared& shared) const {
  const int groups = static_cast<int>(num_groups());
  const int rates = static_cast<int>(size_of_group()) - 2;
  return (shared.location ? 1 : groups) + (shared.scale ? 1 : groups) +
         rates * (shared.rates ? 1 : groups);
}

/// The indices of a group's parameters in the joint vector. The shared parameters come first.
std::vector<std::size_t> JointCurves::places_of(const Shared& shared, std::size_t group) const {
  std::vector<std::size_t> places;
  std::size_t next_shared = 0, next_own = 0;
  const auto is_shared = [&](std::size_t parameter) {
    return parameter == 0 ? shared.location : parameter == 1 ? shared.scale : shared.rates;
  };
  std::size_t num_shared = 0, num_own = 0;
  for (std::size_t i = 0; i < size_of_group(); ++i) ++(is_shared(i) ? num_shared : num_own);
  for (std::size_t i = 0; i < size_of_group(); ++i) {
    places.push_back(is_shared(i) ? next_shared++ : num_shared + group * num_own + next_own++);
  }
  return places;
}

LikelihoodOptimum JointCurves::optimum(const Shared& shared) const {
  const auto size = static_cast<std::size_t>(num_parameters(shared));
  std::vector<std::vector<std::size_t>> places;
  for (std::size_t group = 0; group < num_groups(); ++group) {
    places.push_back(places_of(shared, group));
  }
  const SmoothCost joint = [&](std::span<const double> x, double& value,
                               std::span<double> gradient) {
    value = 0.0;
    std::ranges::fill(gradient, 0.0);
    std::vector<double> own(size_of_group()), by_own(size_of_group());
    for (std::size_t group = 0; group < num_groups(); ++group) {
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = x[places[group][i]];
      double its = 0.0;
      if (!cost(group, location_level_, own, its, by_own)) return false;
      value += its;
      for (std::size_t i = 0; i < own.size(); ++i) gradient[places[group][i]] += by_own[i];
    }
    return true;
  };
  // The search starts from the groups' own curves. Shared parameters start at their mean, once
  // as they are and once with a flatter slope.
  std::vector<std::vector<double>> starts;
  for (const double flatter : {0.0, 1.0}) {
    std::vector<double> start(size, 0.0), count(size, 0.0);
    for (std::size_t group = 0; group < num_groups(); ++group) {
      for (std::size_t i = 0; i < size_of_group(); ++i) {
        double own = found_[group][i];
        if (i == 1) own -= flatter;
        if (i >= 2) own = std::max(own, 0.15);  // At an angle of 0 the cost has no gradient.
        start[places[group][i]] += own;
        count[places[group][i]] += 1.0;
      }
    }
    for (std::size_t i = 0; i < size; ++i) start[i] /= count[i];
    starts.push_back(std::move(start));
  }
  return likelihood_optimum(joint, starts);
}

CurveComparison compare_curves(const std::vector<ComparedGroup>& groups,
                               const CurveOptions& options) {
  CurveComparison result;
  result.status = FitStatus::kDegenerate;
  if (groups.size() < 2) {
    result.reason = "fewer than two groups: there is nothing to compare";
    return result;
  }
  std::vector<FoundCurve> found;
  double num_trials = 0.0;
  for (const ComparedGroup& group : groups) {
    found.push_back(found_curve(group.rows, options.model));
    if (found.back().found.supremum != PsychometricSupremum::kAttained) {
      result.reason = group.name + " has no curve: " + std::string(found.back().found.reason);
      return result;
    }
    for (const AnswerCount& row : group.rows) {
      num_trials += static_cast<double>(row.num_trials);
    }
  }
  result.status = FitStatus::kOk;
  const JointCurves joint(found, options.model);
  const bool has_rates = joint.size_of_group() > 2;
  double different_cost = 0.0;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    different_cost += joint.found_cost(group);
  }
  const int num_different = joint.num_parameters({});
  for (const bool rates :
       has_rates ? std::vector<bool>{false, true} : std::vector<bool>{false}) {
    for (const bool location : {false, true}) {
      for (const bool scale : {false, true}) {
        const Shared shared = {location, scale, rates};
        const bool all_differ = !location && !scale && !rates;
        ComparedModel one = {.name = name_of(shared, has_rates),
                             .shared = shared,
                             .num_parameters = joint.num_parameters(shared)};
        double cost = different_cost;
        if (!all_differ) {
          const LikelihoodOptimum best = joint.optimum(shared);
          if (!best.converged) {
            result.models.push_back(std::move(one));
            continue;
          }
          cost = best.cost;
        }
        one.log_likelihood = -cost;
        one.aic = 2.0 * one.num_parameters + 2.0 * cost;
        one.bic = one.num_parameters * std::log(num_trials) + 2.0 * cost;
        const bool one_same = location + scale + rates == 1;
        const bool all_same = location && scale && (rates || !has_rates);
        if (one_same || all_same) {
          const int degrees = num_different - one.num_parameters;
          const double statistic = std::max(0.0, 2.0 * (cost - different_cost));
          result.tests.push_back({.name = all_same   ? "all"
                                          : location ? "location"
                                          : scale    ? "scale"
                                                     : "rates",
                                  .statistic = statistic,
                                  .degrees_of_freedom = degrees,
                                  .p_value = chi_squared_p(statistic, degrees)});
        }
        result.models.push_back(std::move(one));
      }
    }
  }
  const auto best_by = [&](std::optional<double> ComparedModel::*criterion) {
    const ComparedModel* best = nullptr;
    for (const ComparedModel& one : result.models) {
      if ((one.*criterion) && (!best || *(one.*criterion) < *(best->*criterion))) best = &one;
    }
    return best ? best->name : "";
  };
  result.best_by_aic = best_by(&ComparedModel::aic);
  result.best_by_bic = best_by(&ComparedModel::bic);
  if (groups.size() <= kMostContrasted) {
    result.contrasts = contrasts_of(groups, found, joint, options);
  } else {
    result.reason = "more than 30 groups: their thresholds are not compared in pairs";
  }
  return result;
}

}  // namespace jnd::analysis
