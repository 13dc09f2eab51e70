#include "analysis/results/published_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/data/magnitude_means.h"
#include "analysis/results/magnitude_fits.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace {

using Kind = PublishedStatistic::Kind;
using Levels = std::map<double, AnswerCount>;

/// Least squares on proportions with the pse at the reference. Without an optimum it is the
/// limit of the curve.
std::optional<double> least_squares_or_limit(LeastSquaresFractions& fractions,
                                             const Levels& levels, double reference) {
  std::vector<AnswerCount> rows;
  for (const auto& [intensity, count] : levels) rows.push_back(count);
  if (rows.empty()) return std::nullopt;
  if (const auto fraction = fractions.of(rows, reference)) return fraction;
  double rise = 0.0;
  for (const auto& [intensity, count] : levels) {
    rise += (2.0 * static_cast<double>(count.num_yes) - static_cast<double>(count.num_trials)) *
            std::log(intensity / reference);
  }
  return rise > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

std::optional<double> summed_up(std::vector<double> values,
                                PublishedStatistic::Summary summary) {
  using Summary = PublishedStatistic::Summary;
  if (values.empty()) return std::nullopt;
  if (summary == Summary::kMedian) {
    std::ranges::sort(values);
    return percentile(values, 0.5);
  }
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    return std::numeric_limits<double>::infinity();
  }
  const MeanAndDeviation of = mean_and_deviation_of(values);
  return summary == Summary::kMean ? of.mean : of.standard_deviation;
}

}  // namespace

PublishedStatistics::PublishedStatistics(const std::vector<PersonOutcome>& people)
    : people_(people) {}

const std::vector<std::optional<double>>& PublishedStatistics::own_fractions(
    const std::string& block) {
  const auto [place, is_new] = own_fractions_.try_emplace(block);
  if (!is_new) return place->second;
  for (const PersonOutcome& person : people_) {
    const auto counts = person.counts.find(block);
    const auto reference = person.numbers.find(block + ".reference");
    place->second.push_back(
        counts == person.counts.end() || reference == person.numbers.end()
            ? std::nullopt
            : least_squares_or_limit(fractions_, counts->second, reference->second));
  }
  return place->second;
}

std::optional<double> PublishedStatistics::pooled_fraction(const std::string& block,
                                                           const Places& drawn) {
  Levels pooled;
  double reference = 0.0;
  for (const std::size_t place : drawn) {
    const PersonOutcome& person = people_[place];
    const auto counts = person.counts.find(block);
    const auto its_reference = person.numbers.find(block + ".reference");
    if (counts == person.counts.end() || its_reference == person.numbers.end()) continue;
    reference = its_reference->second;
    for (const auto& [intensity, count] : counts->second) {
      AnswerCount& sum = pooled[intensity];
      sum.intensity = intensity;
      sum.num_yes += count.num_yes;
      sum.num_trials += count.num_trials;
    }
  }
  return least_squares_or_limit(fractions_, pooled, reference);
}

PublishedStatistics::Law PublishedStatistics::group_law(const std::string& block,
                                                        const Places& drawn,
                                                        bool of_production) {
  if (drawn != laws_drawn_) {
    laws_.clear();
    laws_drawn_ = drawn;
  }
  const auto [place, is_new] = laws_.try_emplace(block);
  if (!is_new) return place->second;
  std::vector<Means> means;
  for (const std::size_t drawn_place : drawn) {
    const auto found = people_[drawn_place].means.find(block);
    if (found != people_[drawn_place].means.end()) means.push_back(found->second);
  }
  if (means.empty()) return place->second;
  const Means group = group_means(means, everyone(means.size()));
  const PowerFit fit = of_production
                           ? fit_production(group, PowerMethod::kNonlinear, Solver::kNewton)
                           : fit_estimation(group, PowerMethod::kNonlinear, Solver::kNewton);
  if (fit.k && fit.a) place->second = core::PowerFunction{*fit.k, *fit.a};
  return place->second;
}

PublishedStatistics::Law PublishedStatistics::law(const PublishedStatistic& statistic,
                                                  const Places& drawn) {
  if (statistic.kind != Kind::kCombinedPowerLaw) {
    return group_law(statistic.block, drawn, statistic.kind == Kind::kProductionPowerLaw);
  }
  const Law first = group_law(statistic.block, drawn, false);
  const Law second = group_law(statistic.other_block, drawn, true);
  if (!first || !second) return std::nullopt;
  std::map<double, bool> estimated;
  for (const std::size_t place : drawn) {
    const auto found = people_[place].means.find(statistic.block);
    if (found == people_[place].means.end()) continue;
    for (const auto& [intensity, mean] : found->second) estimated[intensity] = true;
  }
  std::vector<double> intensities;
  for (const auto& [intensity, is_in] : estimated) intensities.push_back(intensity);
  const PowerFit fit = power_between(*first, *second, intensities, Solver::kNewton);
  if (!fit.k || !fit.a) return std::nullopt;
  return core::PowerFunction{*fit.k, *fit.a};
}

std::vector<double> PublishedStatistics::numbers(const PublishedStatistic& statistic,
                                                 const Places& drawn) {
  std::vector<double> values;
  for (const std::size_t place : drawn) {
    const PersonOutcome& person = people_[place];
    if (statistic.kind == Kind::kNumbers) {
      for (const std::string& name : statistic.names) {
        const auto found = person.numbers.find(name);
        if (found != person.numbers.end()) values.push_back(found->second);
      }
    } else if (statistic.kind == Kind::kOwnWeberFractions) {
      if (const auto& own = own_fractions(statistic.block)[place]) values.push_back(*own);
    } else if (const auto means = person.means.find(statistic.block);
               means != person.means.end()) {
      const auto low = means->second.find(statistic.low_target);
      const auto high = means->second.find(statistic.high_target);
      const bool has_both = low != means->second.end() && high != means->second.end();
      if (has_both && low->second > 0.0) values.push_back(high->second / low->second);
    }
  }
  return values;
}

std::optional<double> PublishedStatistics::value(const PublishedStatistic& statistic,
                                                 const std::vector<std::size_t>& drawn) {
  switch (statistic.kind) {
    case Kind::kPooledWeberFraction:
      return pooled_fraction(statistic.block, drawn);
    case Kind::kNumOwnAbovePooled: {
      const std::optional<double> pooled = pooled_fraction(statistic.other_block, drawn);
      const auto& own = own_fractions(statistic.block);
      if (!pooled) return std::nullopt;
      return static_cast<double>(std::ranges::count_if(
          drawn, [&](std::size_t place) { return own[place] && *own[place] > *pooled; }));
    }
    case Kind::kEstimationPowerLaw:
    case Kind::kProductionPowerLaw:
    case Kind::kCombinedPowerLaw: {
      const Law found = law(statistic, drawn);
      if (!found) return std::nullopt;
      return statistic.is_exponent ? found->a : found->k;
    }
    case Kind::kOwnWeberFractions:
    case Kind::kProductionRatio:
    case Kind::kNumbers:
      return summed_up(numbers(statistic, drawn), statistic.summary);
    case Kind::kDifferenceOfMeans: {
      PublishedStatistic one{.kind = Kind::kNumbers, .names = {statistic.names[0]}};
      const std::optional<double> first = value(one, drawn);
      one.names = {statistic.names[1]};
      const std::optional<double> second = value(one, drawn);
      return first && second ? std::optional(*first - *second) : std::nullopt;
    }
  }
  return std::nullopt;
}

std::vector<double> PublishedStatistics::averaged(const PublishedStatistic& statistic,
                                                  const std::vector<std::size_t>& drawn) {
  const bool is_summed_up = statistic.kind == Kind::kOwnWeberFractions ||
                            statistic.kind == Kind::kProductionRatio ||
                            statistic.kind == Kind::kNumbers;
  const bool is_mean = statistic.summary == PublishedStatistic::Summary::kMean;
  return is_summed_up && is_mean ? numbers(statistic, drawn) : std::vector<double>{};
}

}  // namespace jnd::analysis
