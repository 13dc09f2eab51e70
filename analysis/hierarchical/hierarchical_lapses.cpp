#include "analysis/hierarchical/hierarchical_lapses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace jnd::analysis {
namespace {

/// Half the 95 % quantile of chi-squared with one degree of freedom.
constexpr double kFall = 1.9207294103470617;

}  // namespace

LapseProfile::LapseProfile(const HierarchicalLikelihood& likelihood,
                           const HierarchicalStructure& structure, Eigen::VectorXd start,
                           const HierarchicalOptimum& found)
    : likelihood_(likelihood),
      structure_(structure),
      search_(likelihood, structure.even_parameters(), std::move(start), structure.angle_at()),
      with_prior_(structure.lapse_rate(found.parameters)) {
  const Eigen::VectorXd& at = found.parameters;
  points_[with_prior_] = {
      .exists = true,
      .parameters = at,
      .log_likelihood = found.log_likelihood - structure.log_prior(at),
      .rise = with_prior_ > 0.0
                  ? -structure.log_prior_rise(with_prior_, structure.lapse_spread(at))
                  : 0.0};
}

const LapseProfile::Point& LapseProfile::at(double lapse_rate) {
  const auto known = points_.find(lapse_rate);
  if (known != points_.end()) return known->second;
  const int angle_at = structure_.angle_at();
  Point point;
  if (const auto found = search_.from(expected_at(lapse_rate))) {
    point.exists = true;
    point.parameters = *found;
    point.log_likelihood = likelihood_(*found) - structure_.log_prior(*found);
    if (lapse_rate > 0.0) {
      point.rise = rise_of(likelihood_, *found)(angle_at) /
                       (structure_.lapse_limit() * std::sin(2.0 * (*found)(angle_at))) -
                   structure_.log_prior_rise(lapse_rate, structure_.lapse_spread(*found));
    }
  }
  return points_[lapse_rate] = std::move(point);
}

Eigen::VectorXd LapseProfile::expected_at(double lapse_rate) const {
  constexpr double kNoSpread = 1e-5;
  const std::pair<const double, Point>*nearest = nullptr, *next = nullptr;
  const auto distance = [&](const auto* one) {
    return one == nullptr ? std::numeric_limits<double>::infinity()
                          : std::fabs(one->first - lapse_rate);
  };
  for (const auto& one : points_) {
    if (!one.second.exists) continue;
    if (distance(&one) < distance(nearest)) {
      next = std::exchange(nearest, &one);
    } else if (distance(&one) < distance(next)) {
      next = &one;
    }
  }
  Eigen::VectorXd expected = nearest->second.parameters;
  // With many people the estimate follows the line through the two nearest points, unless that
  // leads far away. Spreads that are 0 stay 0.
  if (likelihood_.reads_a_table() && next != nullptr &&
      distance(next) < 4.0 * std::fabs(next->first - nearest->first)) {
    const double share = (lapse_rate - nearest->first) / (nearest->first - next->first);
    expected += share * (nearest->second.parameters - next->second.parameters);
    for (const int spread : structure_.even_parameters()) {
      const double known = nearest->second.parameters(spread);
      if (std::fabs(known) < kNoSpread) expected(spread) = known;
    }
  }
  expected(structure_.angle_at()) = std::asin(std::sqrt(lapse_rate / structure_.lapse_limit()));
  return expected;
}

std::optional<double> LapseProfile::variance_at(double lapse_rate, int parameter) {
  const Point& point = at(lapse_rate);
  if (!point.exists) return std::nullopt;
  if (!covariances_.contains(lapse_rate)) {
    covariances_[lapse_rate] =
        covariance_without(likelihood_, point.parameters, structure_.angle_at());
  }
  const auto& covariance = covariances_.at(lapse_rate);
  // The angle is the last parameter.
  return covariance ? std::optional((*covariance)(parameter, parameter)) : std::nullopt;
}

double LapseProfile::height(double lapse_rate, bool has_prior) {
  const Point& point = at(lapse_rate);
  if (!point.exists) return -std::numeric_limits<double>::infinity();
  return point.log_likelihood + (has_prior ? structure_.log_prior(point.parameters) : 0.0);
}

double LapseProfile::without_prior() {
  if (without_prior_) return *without_prior_;
  // Takes the highest of some points, and then finds where the likelihood no longer rises
  // beside it.
  constexpr double kHardlyAny = 1e-6, kLevel = 1e-4, kNear = 1e-8;
  for (const double lapse_rate : {0.0, kHardlyAny, 0.01, 0.025, 0.05, 0.1, 0.2}) {
    const Point& point = at(lapse_rate);
    if (lapse_rate > with_prior_ && (!point.exists || point.rise < 0.0)) break;
  }
  const auto best = std::ranges::max_element(
      points_, {}, [&](const auto& one) { return height(one.first, false); });
  double found = best->first;
  const bool rises = best->first > 0.0 && best->second.rise > 0.0;
  const bool has_next = std::next(best) != points_.end() && std::next(best)->second.exists;
  if (rises ? has_next : best->first > kHardlyAny) {
    // The regula falsi of Illinois: the value at an end that stays is halved.
    double low = rises ? best->first : std::prev(best)->first;
    double high = rises ? std::next(best)->first : best->first;
    double rise_low = at(low).rise, rise_high = at(high).rise;
    for (int i = 0; i < 60 && high - low > kNear; ++i) {
      const bool known = rise_low > 0.0 && rise_high < 0.0;
      const double share = known ? rise_low / (rise_low - rise_high) : 0.5;
      const double middle = low + share * (high - low);
      const Point& point = at(middle);
      if (height(middle, false) > height(found, false)) found = middle;
      if (!point.exists || std::fabs(point.rise) < kLevel) break;
      if (point.rise > 0.0) {
        low = middle;
        rise_low = point.rise;
        rise_high *= 0.5;
      } else {
        high = middle;
        rise_high = point.rise;
        rise_low *= 0.5;
      }
    }
  }
  without_prior_ = found <= kHardlyAny ? 0.0 : found;
  return *without_prior_;
}

std::optional<double> LapseProfile::end(double from, bool has_prior, double direction) {
  constexpr double kNear = 1e-9, kNearNoCurve = 1e-3, kLevel = 1e-7, kOneStepAway = 2e-3;
  const double most_lapses = 0.9 * structure_.lapse_limit();
  const double top = height(from, has_prior);
  double inside = from;
  std::optional<double> outside;
  double next = direction > 0.0 ? from + 0.02 : 0.0;
  for (int i = 0; i < 60; ++i) {
    const Point& point = at(next);
    const double excess = top - height(next, has_prior) - kFall;
    if (std::fabs(excess) < kLevel) return next;
    if (excess < 0.0) {
      if (next == 0.0) return 0.0;
      if (next == most_lapses) return std::nullopt;
      inside = next;
    } else {
      outside = next;
    }
    if (outside && !at(*outside).exists && std::fabs(*outside - inside) < kNearNoCurve) {
      return std::nullopt;
    }
    if (outside && std::fabs(*outside - inside) < kNear) return next;
    const double spread = point.exists ? structure_.lapse_spread(point.parameters) : 0.0;
    const double rise =
        point.rise + (has_prior ? structure_.log_prior_rise(next, spread) : 0.0);
    const double newton = next + excess / rise;
    const double farthest =
        outside ? *outside : std::min(most_lapses, from + 3.0 * (next - from));
    // Newton's method squares the error, so the next point needs no fit.
    if (std::fabs(excess) < kOneStepAway && point.exists && next > 0.0) {
      return std::clamp(newton, 0.0, most_lapses);
    }
    const bool is_between = std::isfinite(newton) && (newton - inside) * direction > 0.0 &&
                            (farthest - newton) * direction > 0.0;
    next = is_between && point.exists && next > 0.0 ? newton
           : outside                                ? 0.5 * (inside + *outside)
                                                    : farthest;
  }
  return next;
}

Interval LapseProfile::interval(bool has_prior) {
  const double from = has_prior ? with_prior_ : without_prior();
  return {from > 0.0 ? end(from, has_prior, -1.0) : std::optional(0.0),
          end(from, has_prior, 1.0)};
}

}  // namespace jnd::analysis
