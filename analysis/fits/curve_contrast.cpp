#include "analysis/fits/curve_contrast.h"

#include <algorithm>
#include <cmath>

#include "analysis/fits/bootstrap_ends.h"
#include "analysis/fits/curve_resamples.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/multiplicity.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// The joint likelihood of two groups as a function of the contrast of their thresholds. Its
/// parameters are the contrast (a difference or a log ratio), the first group's threshold, and
/// all other parameters of both groups.
class ThresholdPair {
 public:
  enum class Way { kDifference, kLogRatio };

  ThresholdPair(const JointCurves& joint, std::size_t one, std::size_t other, double level)
      : joint_(joint), one_(one), other_(other), level_(level) {}

  [[nodiscard]] double least_cost() const {
    return joint_.found_cost(one_) + joint_.found_cost(other_);
  }
  [[nodiscard]] double threshold(std::size_t group) const {
    return joint_.levels(group).intensity_at(joint_.at_level(group, level_)[0]);
  }

  /// The unit of the contrast. One unit is about as much as the answers can resolve.
  [[nodiscard]] double unit(Way way) const {
    const PsychometricLevels& levels = joint_.levels(one_);
    if (way == Way::kLogRatio) return levels.logarithmic() ? levels.unit : 1.0;
    return levels.unit * (levels.logarithmic() ? threshold(one_) : 1.0);
  }

  [[nodiscard]] std::vector<double> start(Way way, double least_angle) const {
    std::vector<double> x = joint_.at_level(one_, level_);
    const std::vector<double> other = joint_.at_level(other_, level_);
    x.insert(x.end(), other.begin() + 1, other.end());
    const double apart = way == Way::kDifference
                             ? threshold(other_) - threshold(one_)
                             : std::log(threshold(other_) / threshold(one_));
    x.insert(x.begin(), apart / unit(way));
    const std::size_t size = joint_.size_of_group();
    for (std::size_t i = 2; i < size; ++i) {
      x[1 + i] = std::max(x[1 + i], least_angle);
      x[size + i] = std::max(x[size + i], least_angle);
    }
    return x;
  }

  [[nodiscard]] SmoothCost cost(Way way) const {
    return [this, way](std::span<const double> x, double& value, std::span<double> gradient) {
      const std::size_t size = joint_.size_of_group();
      std::vector<double> by_one(size), by_other(size);
      std::vector<double> other = {place_of_other(way, x[0], x[1])};
      other.insert(other.end(), x.begin() + 1 + static_cast<std::ptrdiff_t>(size), x.end());
      double of_other = 0.0;
      if (!std::isfinite(other[0]) ||
          !joint_.cost(one_, level_, x.subspan(1, size), value, by_one) ||
          !joint_.cost(other_, level_, other, of_other, by_other)) {
        return false;
      }
      value += of_other;
      constexpr double kStep = 1e-6;
      const double by_apart =
          (place_of_other(way, x[0] + kStep, x[1]) - place_of_other(way, x[0] - kStep, x[1])) /
          (2.0 * kStep);
      const double by_place =
          (place_of_other(way, x[0], x[1] + kStep) - place_of_other(way, x[0], x[1] - kStep)) /
          (2.0 * kStep);
      if (!std::isfinite(by_apart) || !std::isfinite(by_place)) return false;
      gradient[0] = by_other[0] * by_apart;
      for (std::size_t i = 0; i < size; ++i) gradient[1 + i] = by_one[i];
      gradient[1] += by_other[0] * by_place;
      for (std::size_t i = 1; i < size; ++i) gradient[size + i] = by_other[i];
      return true;
    };
  }

  [[nodiscard]] Interval interval(Way way) const {
    const std::vector<double> at = start(way, 0.0);
    std::vector<std::vector<double>> starts;
    if (joint_.size_of_group() > 2) starts.push_back(start(way, 0.2));
    constexpr double kFarthest = 100.0;
    const SmoothCost its = cost(way);
    Interval ends =
        likelihood_ratio_interval(its, {at, least_cost(), true}, starts, 0, kFarthest);
    const double its_unit = unit(way);
    for (auto* end : {&ends.low, &ends.high}) {
      if (!*end) continue;
      **end *= its_unit;
      if (way == Way::kLogRatio) **end = std::exp(**end);
    }
    return ends;
  }

  /// The p value of the likelihood ratio against equal thresholds, by chi-squared with one
  /// degree of freedom.
  [[nodiscard]] std::optional<double> p_value() const {
    const SmoothCost its = cost(Way::kDifference);
    const auto size = start(Way::kDifference, 0.0).size() - 1;
    const SmoothCost equal = [&](std::span<const double> x, double& value,
                                 std::span<double> gradient) {
      std::vector<double> whole = {0.0}, by_whole(size + 1);
      whole.insert(whole.end(), x.begin(), x.end());
      if (!its(whole, value, by_whole)) return false;
      std::ranges::copy(by_whole.begin() + 1, by_whole.end(), gradient.begin());
      return true;
    };
    std::vector<std::vector<double>> starts;
    for (const double share : {0.0, 0.5, 1.0}) {
      std::vector<double> from = start(Way::kDifference, 0.2);
      const double other = joint_.at_level(other_, level_)[0];
      from.erase(from.begin());
      from[0] += share * (other - from[0]);
      starts.push_back(std::move(from));
    }
    const LikelihoodOptimum best = likelihood_optimum(equal, starts);
    if (!best.converged) return std::nullopt;
    const double statistic = std::max(0.0, 2.0 * (best.cost - least_cost()));
    return chi_squared_above(statistic, 1.0);
  }

 private:
  /// The place of the second threshold on the abscissa. It is NaN if no such intensity exists.
  [[nodiscard]] double place_of_other(Way way, double apart, double place) const {
    const PsychometricLevels& levels = joint_.levels(one_);
    const double by = apart * unit(way);
    if (levels.logarithmic() && way == Way::kLogRatio) return place + by / levels.unit;
    const double one = levels.intensity_at(place);
    const double other = way == Way::kDifference ? one + by : one * std::exp(by);
    if (!levels.logarithmic()) return (other - levels.origin) / levels.unit;
    return std::log(other / levels.origin) / levels.unit;
  }

  const JointCurves& joint_;
  std::size_t one_, other_;
  double level_;
};

/// A redraw without a value may lie beyond either end.
Interval ends_of(const std::vector<double>& values, const std::optional<double>& estimate) {
  if (values.empty() || !estimate) return {};
  const auto ends_if = [&](double undefined) {
    std::vector<double> ascending = values;
    for (double& value : ascending) {
      if (std::isnan(value)) value = undefined;
    }
    std::ranges::sort(ascending);
    return bootstrap_ends(ascending, *estimate, std::nullopt).ci95;
  };
  return {.low = ends_if(-core::kInfinity).low, .high = ends_if(core::kInfinity).high};
}

void add_bootstrap_ends(CurveContrast& contrast, const std::vector<double>& one,
                        const std::vector<double>& other) {
  std::vector<double> differences, ratios;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
    differences.push_back(other[i] - one[i]);
    ratios.push_back(one[i] > 0.0 && other[i] > 0.0 ? other[i] / one[i] : std::nan(""));
  }
  contrast.difference.bootstrap_ci95 = ends_of(differences, contrast.difference.value);
  contrast.ratio.bootstrap_ci95 = ends_of(ratios, contrast.ratio.value);
}

}  // namespace

std::vector<CurveContrast> contrasts_of(const std::vector<ComparedGroup>& groups,
                                        const std::vector<FoundCurve>& found,
                                        const JointCurves& joint, const CurveOptions& options) {
  using Way = ThresholdPair::Way;
  std::vector<CurveQuantity> thresholds;
  for (const double at : options.at) {
    thresholds.push_back({CurveQuantity::Kind::kThreshold, level_of_f(options.model, at)});
  }
  std::vector<CurveResamples> redrawn;
  for (std::size_t group = 0; options.num_bootstrap > 0 && group < groups.size(); ++group) {
    redrawn.push_back(resampled(found[group], options.model, thresholds, options.num_bootstrap,
                                options.bootstrap_kind, options.seed + group));
  }
  std::vector<CurveContrast> all;
  for (std::size_t level = 0; level < thresholds.size(); ++level) {
    std::vector<CurveContrast> of_level;
    std::vector<std::optional<double>> p_values;
    for (std::size_t one = 0; one < groups.size(); ++one) {
      for (std::size_t other = one + 1; other < groups.size(); ++other) {
        const ThresholdPair pair(joint, one, other, thresholds[level].level);
        CurveContrast contrast = {.one = groups[one].name,
                                  .other = groups[other].name,
                                  .at = options.at[level],
                                  .difference = {},
                                  .ratio = {},
                                  .p_value = {},
                                  .p_value_holm = {}};
        const double first = pair.threshold(one), second = pair.threshold(other);
        contrast.difference.value = second - first;
        contrast.difference.ci95 = pair.interval(Way::kDifference);
        if (first > 0.0 && second > 0.0) {
          contrast.ratio.value = second / first;
          contrast.ratio.ci95 = pair.interval(Way::kLogRatio);
        }
        contrast.p_value = pair.p_value();
        if (!redrawn.empty()) {
          add_bootstrap_ends(contrast, redrawn[one].values[level],
                             redrawn[other].values[level]);
        }
        p_values.push_back(contrast.p_value);
        of_level.push_back(std::move(contrast));
      }
    }
    const std::vector<std::optional<double>> adjusted = holm_adjusted(p_values);
    for (std::size_t i = 0; i < of_level.size(); ++i) {
      of_level[i].p_value_holm = adjusted[i];
      all.push_back(std::move(of_level[i]));
    }
  }
  return all;
}

}  // namespace jnd::analysis
