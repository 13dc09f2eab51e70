#include <cmath>
#include <limits>

#include "analysis/fits/power_fit.h"
#include "analysis/statistics/summary.h"
#include "app/operator/results_model.h"
#include "app/operator/study_words.h"
#include "core/power_function.h"
#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using namespace results;
using analysis::BlockDesign;
using analysis::Estimate;
using analysis::ParticipantData;

/// Values at each x: a target's ratio, or an intensity.
using Samples = std::map<double, std::vector<double>>;

Mean mean_of(double at, const std::vector<double>& values) {
  const analysis::Summary summary = analysis::summary_of(values);
  const double spread = summary.standard_deviation.value_or(0.0);
  Mean mean{.at = at, .n = summary.num_values};
  mean.arithmetic = summary.mean.value_or(0.0);
  mean.arithmetic_low = mean.arithmetic - spread;
  mean.arithmetic_high = mean.arithmetic + spread;
  std::vector<double> logarithms;
  for (const double value : values) {
    if (value > 0.0) logarithms.push_back(std::log(value));
  }
  if (logarithms.empty() || logarithms.size() < values.size()) return mean;
  const analysis::Summary logs = analysis::summary_of(logarithms);
  const double log_spread = logs.standard_deviation.value_or(0.0);
  mean.geometric = std::exp(*logs.mean);
  mean.geometric_low = std::exp(*logs.mean - log_spread);
  mean.geometric_high = std::exp(*logs.mean + log_spread);
  return mean;
}

std::vector<Mean> means_of(const Samples& samples) {
  std::vector<Mean> means;
  for (const auto& [at, values] : samples) means.push_back(mean_of(at, values));
  return means;
}

constexpr double kRatioPerPercent = 0.01;

/// A participant's answers by intensity, as ratios; or the intensities set by target ratio.
Samples samples_of(const ParticipantData& participant, const std::string& block,
                   bool production) {
  Samples samples;
  for (const core::TrialRow& trial : participant.trials_in(block)) {
    const std::optional<double> at = production ? trial.target_percent : trial.intensity;
    if (!at || !trial.response) continue;
    if (production) {
      samples[*at * kRatioPerPercent].push_back(*trial.response);
    } else {
      samples[*at].push_back(*trial.response * kRatioPerPercent);
    }
  }
  return samples;
}

/// Every participant weighs the same, however often they answered.
void add_means(const Samples& of_one, Samples& of_all) {
  for (const auto& [at, values] : of_one) {
    of_all[at].push_back(*analysis::summary_of(values).mean);
  }
}

/// Where curves are drawn: the intensities that were presented or set, > 0.
std::pair<double, double> range_of(const MagnitudeFigure& figure) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  const auto include = [&](double intensity) {
    if (!(intensity > 0.0)) return;
    low = std::min(low, intensity);
    high = std::max(high, intensity);
  };
  for (const Mean& mean : figure.estimation) include(mean.at);
  for (const Mean& mean : figure.production) include(mean.arithmetic);
  return {0.9 * low, 1.1 * high};
}

void draw_curve(PowerCurve& power, std::pair<double, double> range) {
  if (!power.k || !power.a || !(range.second > range.first)) return;
  const core::PowerFunction function{*power.k, *power.a};
  for (const double x : logarithmic_grid(range.first, range.second)) {
    const double magnitude = function.magnitude(x);
    if (std::isfinite(magnitude) && magnitude > 0.0) power.curve.push_back({x, magnitude});
  }
}

/// Why there is no power law through these means, in the words of the fit.
std::string reason_of(const MagnitudeFigure& figure, bool production) {
  std::vector<analysis::Magnitude> rows;
  for (const Mean& mean : production ? figure.production : figure.estimation) {
    rows.push_back(production ? analysis::Magnitude{mean.arithmetic, mean.at}
                              : analysis::Magnitude{mean.at, mean.arithmetic});
  }
  const std::string reason = analysis::fit_power(rows).reason;
  return reason.empty() ? "no value" : reason;
}

PowerCurve group_curve(const ResultsSource& source, const std::string& name) {
  PowerCurve curve{.name = name};
  if (const Estimate* k = source.results.find(name + ".k"); k != nullptr) {
    curve.k = k->value;
    curve.k_ci95 = k->ci95;
    curve.published_k = k->published;
  }
  if (const Estimate* a = source.results.find(name + ".a"); a != nullptr) {
    curve.a = a->value;
    curve.a_ci95 = a->ci95;
    curve.published_a = a->published;
  }
  return curve;
}

PowerCurve own_curve(const ResultsSource& source, const std::string& block,
                     const std::string& participant) {
  PowerCurve curve{.name = block};
  if (const auto* k = source.own(block, participant, block + ".k"); k != nullptr) {
    curve.k = k->value;
    curve.k_ci95 = k->ci95;
    curve.reason = k->reason;
  }
  if (const auto* a = source.own(block, participant, block + ".a"); a != nullptr) {
    curve.a = a->value;
    curve.a_ci95 = a->ci95;
  }
  return curve;
}

void finish(std::optional<PowerCurve>& curve, MagnitudeFigure& figure, bool production) {
  if (!curve) return;
  if (!curve->k && curve->reason.empty()) curve->reason = reason_of(figure, production);
  draw_curve(*curve, range_of(figure));
}

MagnitudeFigure own_figure(const ResultsSource& source, const Magnitude& magnitude,
                           const ParticipantData& participant) {
  MagnitudeFigure figure{.who = participant.participant};
  if (!magnitude.estimation_block.empty()) {
    figure.estimation =
        means_of(samples_of(participant, magnitude.estimation_block, /*production=*/false));
    figure.estimation_curve =
        own_curve(source, magnitude.estimation_block, participant.participant);
  }
  if (!magnitude.production_block.empty()) {
    figure.production =
        means_of(samples_of(participant, magnitude.production_block, /*production=*/true));
    figure.production_curve =
        own_curve(source, magnitude.production_block, participant.participant);
  }
  finish(figure.estimation_curve, figure, false);
  finish(figure.production_curve, figure, true);
  return figure;
}

/// Of an estimation, of a production, or of both.
Magnitude magnitude_of(const ResultsSource& source,
                       const std::vector<const BlockDesign*>& estimations,
                       const std::vector<const BlockDesign*>& productions) {
  const BlockDesign* estimation = estimations.empty() ? nullptr : estimations.front();
  const BlockDesign* production = productions.empty() ? nullptr : productions.front();
  Magnitude magnitude;
  for (const BlockDesign* block : {production, estimation}) {
    if (block == nullptr) continue;
    const std::string title = source.title(block->block);
    magnitude.title = title + (magnitude.title.empty() ? "" : " and " + magnitude.title);
    magnitude.quantity = experiments::quantity_words(block->quantity);
    magnitude.unit = experiments::quantity_unit(block->quantity);
  }
  if (estimation != nullptr) magnitude.estimation_block = estimation->block;
  if (production != nullptr) magnitude.production_block = production->block;
  Samples estimated;
  Samples produced;
  for (const ParticipantData& participant : source.data.participants) {
    if (estimation != nullptr) {
      add_means(samples_of(participant, estimation->block, false), estimated);
    }
    if (production != nullptr) {
      add_means(samples_of(participant, production->block, true), produced);
    }
    MagnitudeFigure own = own_figure(source, magnitude, participant);
    if (own.estimation.empty() && own.production.empty()) continue;
    magnitude.participants.push_back(std::move(own));
  }
  MagnitudeFigure& pooled = magnitude.pooled;
  pooled.who = kEveryone;
  pooled.estimation = means_of(estimated);
  pooled.production = means_of(produced);
  if (estimation != nullptr) pooled.estimation_curve = group_curve(source, estimation->block);
  if (production != nullptr) pooled.production_curve = group_curve(source, production->block);
  finish(pooled.estimation_curve, pooled, false);
  finish(pooled.production_curve, pooled, true);
  if (estimation != nullptr && production != nullptr && source.section("combined") != nullptr) {
    pooled.combined_curve = group_curve(source, "combined");
    if (!pooled.combined_curve->k) {
      pooled.combined_curve->reason = "estimation or production has no power law";
    }
    draw_curve(*pooled.combined_curve, range_of(pooled));
  }
  return magnitude;
}

}  // namespace

std::vector<Magnitude> magnitudes_of(const ResultsSource& source) {
  std::vector<const BlockDesign*> estimations;
  std::vector<const BlockDesign*> productions;
  for (const BlockDesign& block : source.data.blocks) {
    if (block.estimates()) estimations.push_back(&block);
    if (block.produces()) productions.push_back(&block);
  }
  // The two that results combine stand in one figure.
  if (estimations.size() == 1 && productions.size() == 1 &&
      estimations[0]->quantity == productions[0]->quantity) {
    return {magnitude_of(source, estimations, productions)};
  }
  std::vector<Magnitude> figures;
  for (const BlockDesign* block : estimations) {
    figures.push_back(magnitude_of(source, {block}, {}));
  }
  for (const BlockDesign* block : productions) {
    figures.push_back(magnitude_of(source, {}, {block}));
  }
  return figures;
}

}  // namespace jnd::app
