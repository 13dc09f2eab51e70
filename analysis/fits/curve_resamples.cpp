#include "analysis/fits/curve_resamples.h"

#include <algorithm>
#include <cmath>

#include "analysis/fits/bootstrap_ends.h"
#include "analysis/fits/psychometric_redraw.h"
#include "analysis/fits/psychometric_refit.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using Kind = CurveQuantity::Kind;
using enum PsychometricMethod;

/// The value of a quantity for a redraw that has no optimum. The curve then tends to a step or
/// to a flat line.
class LimitOfRedraw {
 public:
  LimitOfRedraw(const CurveModel& model, const PsychometricLevels& redrawn,
                PsychometricSupremum supremum, const PsychometricCurve& fitted)
      : model_(model), levels_(redrawn), is_step_(supremum == PsychometricSupremum::kStep) {
    curve_ = fitted;
    if (!is_step_) return;
    step_place_ = step_place();
    curve_.slope = 1e12;
    curve_.offset = -curve_.slope * step_place_;
  }

  [[nodiscard]] double value(const CurveQuantity& quantity) const {
    switch (quantity.kind) {
      case Kind::kGuess:
      case Kind::kLapse:
        return value_of(quantity, model_, levels_, curve_);
      case Kind::kThreshold:
        return place_of(quantity, quantity.level);
      case Kind::kLocation:
        return place_of(quantity, traits_of(model_.family).at_location);
      case Kind::kThresholdOfProportion:
        return place_of(quantity, level_of_proportion(model_, levels_, curve_, quantity.level));
      case Kind::kDistance:
        return is_step_ ? 0.0 : core::kInfinity;
      case Kind::kScale:
        return is_step_ == (model_.family != CurveFamily::kWeibull) ? 0.0 : core::kInfinity;
      case Kind::kSlope:
      case Kind::kSlopeOfProportion:
        if (!is_step_) return 0.0;
        return model_.falling ? -core::kInfinity : core::kInfinity;
    }
    return std::nan("");
  }

 private:
  [[nodiscard]] double low_end() const { return levels_.ends.low(curve_.lapse, curve_.guess); }
  [[nodiscard]] double rise() const { return levels_.ends.rise(curve_.lapse, curve_.guess); }

  /// The place where F has a level. On a step this is the step. A level line has it beyond all
  /// stimuli: above them if yes is rarer than the fitted curve has it at that level. (The
  /// engine's curve rises, whatever the model does.)
  [[nodiscard]] double place_of(const CurveQuantity& quantity, double level) const {
    if (is_step_ && std::isfinite(step_place_)) {
      return value_of(quantity, model_, levels_, curve_);
    }
    if (is_step_) return step_place_;
    double yes = 0.0, trials = 0.0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      yes += levels_.num_yes[i];
      trials += levels_.num_trials[i];
    }
    return yes > (low_end() + level * rise()) * trials ? -core::kInfinity : core::kInfinity;
  }

  /// The place of the likeliest step between the ends of the fitted curve: at a level, whose
  /// probability may then be any between the ends, in the middle between two levels, or beyond
  /// all of them. An answer that an end at 0 or 1 excludes is very unlikely, so that the step
  /// with the fewest of them is chosen.
  [[nodiscard]] double step_place() const {
    constexpr double kUnlikely = 1e-9;
    const double low = std::clamp(low_end(), kUnlikely, 1.0 - kUnlikely);
    const double high = std::clamp(low_end() + rise(), kUnlikely, 1.0 - kUnlikely);
    // Minus the log-likelihood, less that of a step below every level.
    double cost = 0.0, least = 0.0, place = -core::kInfinity;
    const auto consider = [&](double its_cost, double its_place) {
      if (!(its_cost < least)) return;
      least = its_cost;
      place = its_place;
    };
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double yes = levels_.num_yes[i], no = levels_.num_trials[i] - yes;
      // What it costs that level i has this probability instead of the upper end.
      const auto more_at = [&](double probability) {
        return yes * std::log(high / probability) +
               no * std::log((1.0 - high) / (1.0 - probability));
      };
      const double share = yes / levels_.num_trials[i];
      if (low < share && share < high) consider(cost + more_at(share), levels_.abscissa[i]);
      cost += more_at(low);
      const bool is_last = i + 1 == levels_.size();
      consider(cost, is_last ? core::kInfinity
                             : 0.5 * (levels_.abscissa[i] + levels_.abscissa[i + 1]));
    }
    return place;
  }

  const CurveModel& model_;
  const PsychometricLevels& levels_;
  bool is_step_;
  double step_place_ = 0.0;
  PsychometricCurve curve_;
};

std::vector<double> values_or_limits(const std::vector<CurveQuantity>& quantities,
                                     const CurveModel& model, const PsychometricRefit& refit,
                                     const PsychometricLevels& redrawn,
                                     const PsychometricCurve& fitted, bool& is_degenerate) {
  const PsychometricSearchResult found = refit.find(redrawn);
  std::vector<double> values;
  is_degenerate = found.supremum != PsychometricSupremum::kAttained;
  if (!is_degenerate) {
    for (const CurveQuantity& one : quantities) {
      values.push_back(value_of(one, model, redrawn, found.optimum.curve));
    }
    return values;
  }
  const LimitOfRedraw limit(model, redrawn, found.supremum, fitted);
  for (const CurveQuantity& one : quantities) values.push_back(limit.value(one));
  return values;
}

}  // namespace

CurveResamples resampled(const FoundCurve& fit, const CurveModel& model,
                         const std::vector<CurveQuantity>& quantities, int num_redraws,
                         BootstrapKind kind, std::uint64_t seed) {
  const PsychometricCurve& fitted = fit.found.optimum.curve;
  const AnswerRedraw redraw = kind == BootstrapKind::kParametric
                                  ? AnswerRedraw(fit.levels, fitted)
                                  : AnswerRedraw(fit.levels);
  const PsychometricSearch search(fit.levels, kMaximumLikelihood, true, fit.free[2]);
  const PsychometricRefit refit(search, fit.levels, fitted);
  core::RandomStream random(seed, "bootstrap of a psychometric function");
  PsychometricLevels redrawn = fit.levels;
  CurveResamples result;
  result.values.resize(quantities.size());
  for (int draw = 0; draw < num_redraws; ++draw) {
    redraw.draw(random, redrawn);
    bool is_degenerate = false;
    const std::vector<double> values =
        values_or_limits(quantities, model, refit, redrawn, fitted, is_degenerate);
    if (is_degenerate) ++result.num_degenerate;
    for (std::size_t i = 0; i < values.size(); ++i) result.values[i].push_back(values[i]);
  }
  return result;
}

std::vector<std::optional<double>> accelerations(const FoundCurve& fit, const CurveModel& model,
                                                 const std::vector<CurveQuantity>& quantities) {
  const PsychometricLevels& levels = fit.levels;
  const PsychometricCurve& fitted = fit.found.optimum.curve;
  const PsychometricSearch search(levels, kMaximumLikelihood, true, fit.free[2]);
  const PsychometricRefit refit(search, levels, fitted);
  std::vector<std::vector<LeftOut>> all(quantities.size());
  std::vector<bool> has_all(quantities.size(), true);
  PsychometricLevels without = levels;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (const double yes : {1.0, 0.0}) {
      const double num =
          yes == 1.0 ? levels.num_yes[level] : levels.num_trials[level] - levels.num_yes[level];
      if (num == 0.0 || levels.num_trials[level] < 2.0) continue;
      without.num_yes[level] -= yes;
      without.num_trials[level] -= 1.0;
      bool is_degenerate = false;
      const std::vector<double> values =
          values_or_limits(quantities, model, refit, without, fitted, is_degenerate);
      without.num_yes[level] += yes;
      without.num_trials[level] += 1.0;
      for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (is_degenerate || !std::isfinite(values[i])) has_all[i] = false;
        all[i].push_back({values[i], num});
      }
    }
  }
  std::vector<std::optional<double>> found;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    found.push_back(has_all[i] ? acceleration_of(all[i]) : std::nullopt);
  }
  return found;
}

}  // namespace jnd::analysis
