#include "analysis/mixed/power_people.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/mixed/people_lines.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// exp of a larger number leaves the range of double.
constexpr double kLargestLogarithm = 700.0;
constexpr double kCorrelationAtBound = 0.9999;

/// The rows that have logarithms, and their participants.
struct LogarithmicRows {
  std::vector<PersonPoint> points;
  std::vector<std::string> participants;
};

LogarithmicRows logarithms_of(const std::vector<PersonMagnitude>& data, PeoplePowerFit& fit) {
  LogarithmicRows rows;
  std::map<std::string, std::size_t> places;
  for (std::size_t row = 0; row < data.size(); ++row) {
    const Magnitude& one = data[row].data;
    core::require_not_negative(one.intensity, "intensity");
    core::require(std::isfinite(one.magnitude), "magnitude", "a finite number", one.magnitude);
    if (!(one.intensity > 0.0) || !(one.magnitude > 0.0)) {
      fit.excluded.push_back({row, one,
                              one.intensity > 0.0
                                  ? "the magnitude has no logarithm: expected > 0"
                                  : "the intensity has no logarithm: expected > 0"});
      continue;
    }
    const auto [place, is_new] =
        places.try_emplace(data[row].participant, rows.participants.size());
    if (is_new) {
      rows.participants.push_back(data[row].participant);
      fit.people.push_back({.participant = data[row].participant});
    }
    ++fit.people[place->second].num_rows;
    rows.points.push_back(
        {.person = place->second, .x = std::log(one.intensity), .y = std::log(one.magnitude)});
  }
  return rows;
}

Interval exponentials(const Interval& of) {
  const auto end = [](const std::optional<double>& value) -> std::optional<double> {
    if (!value) return std::nullopt;
    const double at = std::exp(*value);
    return std::isfinite(at) && at > 0.0 ? std::optional(at) : std::nullopt;
  };
  return {end(of.low), end(of.high)};
}

void tell_intervals(PeoplePowerFit& fit, const PeopleLines& lines,
                    const std::vector<PersonPoint>& points, int num_with_own) {
  if (num_with_own >= kFewPeople) {
    fit.interval_method = "profile";
    fit.a_ci95 = people_lines_profile(points, lines.people.size(), LineParameter::kSlope);
    fit.k_ci95 = exponentials(
        people_lines_profile(points, lines.people.size(), LineParameter::kIntercept));
    return;
  }
  fit.interval_method = "t";
  fit.degrees_of_freedom = num_with_own - 1.0;
  const double t = student_t_quantile(0.975, *fit.degrees_of_freedom);
  const auto about = [t](double value, double error) -> Interval {
    return {value - t * error, value + t * error};
  };
  fit.a_ci95 = about(lines.group.slope, lines.slope_standard_error);
  fit.k_ci95 = exponentials(about(lines.group.intercept, lines.intercept_standard_error));
}

void warn_of_bounds(PeoplePowerFit& fit, int num_without_own) {
  if (*fit.a_sd == 0.0) {
    fit.warnings.emplace_back(
        "exponents differ no more between participants than their rows scatter: the spread is "
        "at its bound of 0, and everybody's shrunk exponent is that of the group");
  }
  if (*fit.ln_k_sd == 0.0) {
    fit.warnings.emplace_back(
        "factors differ no more between participants than their rows scatter: their spread is "
        "at its bound of 0");
  }
  if (fit.correlation && std::fabs(*fit.correlation) > kCorrelationAtBound) {
    fit.warnings.push_back(fmt::format(
        "the correlation of factors and exponents is at its bound of {}: one of their spreads "
        "is not told by these rows",
        *fit.correlation > 0.0 ? "1" : "-1"));
  }
  if (num_without_own > 0) {
    fit.warnings.push_back(fmt::format(
        "{} participant{} at a single intensity say{} nothing of exponents", num_without_own,
        num_without_own == 1 ? "" : "s", num_without_own == 1 ? "s" : ""));
  }
}

}  // namespace

PeoplePowerFit fit_power_of_people(const std::vector<PersonMagnitude>& data) {
  PeoplePowerFit fit;
  fit.status = FitStatus::kDegenerate;
  const LogarithmicRows rows = logarithms_of(data, fit);
  fit.num_rows = static_cast<int>(rows.points.size());
  fit.num_people = static_cast<int>(rows.participants.size());
  if (rows.points.empty()) {
    fit.reason = "expected rows with an intensity and a magnitude above 0, found none";
    return fit;
  }
  const PeopleLines lines = fit_people_lines(rows.points, rows.participants.size());
  fit.status = lines.status;
  fit.reason = lines.reason;
  const auto fail = [&fit] {
    fit.people.clear();
    return fit;
  };
  if (fit.status != FitStatus::kOk) return fail();
  if (!(std::fabs(lines.group.intercept) < kLargestLogarithm)) {
    fit.status = FitStatus::kDegenerate;
    fit.reason = "the factor k is out of the range of numbers";
    return fail();
  }
  fit.k = std::exp(lines.group.intercept);
  fit.a = lines.group.slope;
  fit.k_standard_error = *fit.k * lines.intercept_standard_error;
  fit.a_standard_error = lines.slope_standard_error;
  fit.ln_k_sd = lines.intercept_sd;
  fit.a_sd = lines.slope_sd;
  fit.correlation = lines.correlation;
  fit.residual_sd_ln = lines.residual_sd;
  fit.log_likelihood = lines.log_likelihood;
  int num_with_own = 0;
  for (std::size_t i = 0; i < fit.people.size(); ++i) {
    PeoplePowerFit::Person& person = fit.people[i];
    person.k = std::exp(lines.people[i].intercept);
    person.a = lines.people[i].slope;
    if (!lines.own[i]) continue;
    ++num_with_own;
    person.own_k = std::exp(lines.own[i]->intercept);
    person.own_a = lines.own[i]->slope;
  }
  tell_intervals(fit, lines, rows.points, num_with_own);
  warn_of_bounds(fit, fit.num_people - num_with_own);
  return fit;
}

}  // namespace jnd::analysis
