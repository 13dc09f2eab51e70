#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "analysis/fits/interval_order_fit.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/wilson_interval.h"
#include "app/operator/results_model.h"
#include "app/operator/study_words.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using namespace results;
using analysis::BlockDesign;
using analysis::Estimate;
using analysis::ParticipantData;

/// Counts at the intensities of one or more participants.
using Counts = std::map<double, Proportion>;

void count(const ParticipantData& participant, const std::string& block, Counts& counts,
           double& reference) {
  for (const core::TrialRow& trial : participant.trials_in(block)) {
    if (!trial.intensity || !trial.response || !trial.reference_intensity) continue;
    reference = *trial.reference_intensity;
    Proportion& level = counts[*trial.intensity];
    level.intensity = *trial.intensity;
    level.num_yes += *trial.response > 0.5 ? 1 : 0;
    ++level.num_trials;
  }
}

std::vector<Proportion> proportions(const Counts& counts) {
  std::vector<Proportion> points;
  for (const auto& [intensity, counted] : counts) {
    Proportion point = counted;
    point.ratio = static_cast<double>(point.num_yes) / static_cast<double>(point.num_trials);
    std::tie(point.low, point.high) =
        analysis::wilson_interval(point.num_yes, point.num_trials);
    points.push_back(point);
  }
  return points;
}

/// With the limits that an open interval stands for: a step at 0, a flat line at infinity.
double probability(const PsychometricFigure& figure, double weber_fraction, double intensity) {
  if (!std::isfinite(weber_fraction)) return 0.5;
  const double ratio =
      analysis::mean_over_orders(figure.pse, weber_fraction, figure.order_effect_ln, intensity);
  return figure.lapse_rate + (1.0 - 2.0 * figure.lapse_rate) * ratio;
}

void draw_curve(PsychometricFigure& figure, double low, double high) {
  if (!figure.weber_fraction) return;
  // Of two orders drawn as their mean, no place shows the Weber fraction.
  if (figure.order_effect_ln == 0.0) {
    figure.weber_line = figure.pse * (1.0 + *figure.weber_fraction);
  }
  const bool has_band = figure.ci95.low || figure.ci95.high;
  const double least = figure.ci95.low.value_or(0.0);
  const double most = figure.ci95.high.value_or(std::numeric_limits<double>::infinity());
  for (const double x : logarithmic_grid(low, high)) {
    figure.curve.push_back({x, probability(figure, *figure.weber_fraction, x)});
    if (!has_band) continue;
    const double steep = probability(figure, least, x);
    const double flat = probability(figure, most, x);
    figure.band.push_back({x, std::min(steep, flat), std::max(steep, flat)});
  }
}

/// For whoever answered, not for whoever fits.
std::string in_plain_words(const std::string& reason, bool is_separated, bool free_pse) {
  if (!is_separated) return reason;
  const std::string place = free_pse ? "one level" : "the reference";
  return "every answer fell on its side of " + place +
         ", so the Weber fraction is smaller than these stimuli can show; stimuli nearer to " +
         (free_pse ? "it" : place) + " would find it";
}

/// "0.70", or that there is none.
std::string fraction_words(const std::optional<double>& value) {
  if (!value) return "none";
  return fmt::format(fmt::runtime(*value < 0.1 ? "{:.3f}" : "{:.2f}"), *value);
}

/// The curve of the median person, the primary value; and through everybody's answers that
/// which published values are of.
void add_group_curves(const ResultsSource& source, Discrimination& block, double low,
                      double high) {
  PsychometricFigure& all = block.pooled;
  const auto find = [&](const std::string& name) {
    return source.results.find(block.block + "." + name);
  };
  if (const Estimate* person = find("weber_fraction_median_person")) {
    all.weber_fraction = person->value;
    all.ci95 = person->ci95;
    all.cautions = person->cautions;
    all.reason = person->value
                     ? ""
                     : in_plain_words(person->reason, person->is_separated, block.has_free_pse);
  }
  const Estimate* const pse = find("pse_median_person");
  const bool has_pse = block.has_free_pse && pse != nullptr && pse->value;
  all.pse = has_pse ? *pse->value : block.reference;
  all.lapse_rate = value_or_0(find("lapse_rate"));
  draw_curve(all, low, high);
  const Estimate* const pooled = find("weber_fraction");
  if (pooled == nullptr) return;
  all.others.push_back("curve through all answers " + fraction_words(pooled->value));
  if (pooled->published) {
    all.others.back() += " (published " + fraction_words(pooled->published) + ")";
  }
  if (!pooled->value) return;
  const double order_effect_ln = value_or_0(find("weber_fraction_order_effect_ln"));
  for (const double x : logarithmic_grid(low, high)) {
    all.pooled_curve.push_back(
        {x, analysis::mean_over_orders(block.reference, *pooled->value, order_effect_ln, x)});
  }
}

/// The participant's own curve, with the pse as the primary value has it; and what their
/// fraction is with the other one.
PsychometricFigure own_figure(const ResultsSource& source, const Discrimination& block,
                              const std::string& participant, const Counts& counts, double low,
                              double high) {
  const auto own = [&](const std::string& name) {
    return source.own(block.block, participant, block.block + "." + name);
  };
  const bool free_pse = block.has_free_pse;
  const analysis::ParticipantEstimate* const fixed = own("weber_fraction");
  const analysis::ParticipantEstimate* const freed = own("weber_fraction_free_pse");
  const analysis::ParticipantEstimate* const primary = free_pse ? freed : fixed;
  const analysis::ParticipantEstimate* const other = free_pse ? fixed : freed;
  PsychometricFigure one{
      .who = participant,
      .points = proportions(counts),
      .weber_fraction = primary->value,
      .ci95 = primary->ci95,
      .pse = block.reference,
      .reason = in_plain_words(primary->reason, primary->is_separated, free_pse),
      .cautions = primary->cautions};
  const analysis::ParticipantEstimate* const pse = own("pse");
  if (free_pse && pse != nullptr && pse->value) one.pse = *pse->value;
  if (!free_pse) one.order_effect_ln = value_or_0(own("order_effect_ln_at_reference"));
  if (other != nullptr) {
    one.others.push_back(std::string("with the PSE ") +
                         (free_pse ? "at the reference " : "free ") +
                         fraction_words(other->value));
  }
  draw_curve(one, low, high);
  return one;
}

std::optional<Discrimination> discrimination_of(const ResultsSource& source,
                                                const BlockDesign& block) {
  const analysis::ResultsSection* section = source.section(block.block);
  if (section == nullptr) return std::nullopt;
  Discrimination figure{.block = block.block,
                        .title = source.title(block.block),
                        .quantity = experiments::quantity_words(block.quantity),
                        .unit = experiments::quantity_unit(block.quantity),
                        .answer = task_of(block.written) == experiments::Task::kTwoInterval
                                      ? "test chosen"
                                      : "“yes”",
                        .has_fixed_levels = block.has_fixed_levels(),
                        .has_free_pse = section->own_fractions_free_pse};
  Counts all;
  std::map<std::string, Counts> own;
  for (const ParticipantData& participant : source.data.participants) {
    double reference = 0.0;
    count(participant, block.block, own[participant.participant], reference);
    count(participant, block.block, all, reference);
    if (figure.reference == 0.0) figure.reference = reference;
  }
  if (all.empty()) return std::nullopt;
  const auto first =
      std::find_if(all.begin(), all.end(), [](const auto& level) { return level.first > 0.0; });
  const double low =
      0.9 * (first == all.end() ? figure.reference : std::min(first->first, figure.reference));
  const double high = 1.1 * std::max(all.rbegin()->first, figure.reference);
  figure.pooled = {.who = kEveryone, .points = proportions(all), .reason = "no value"};
  add_group_curves(source, figure, low, high);
  for (const auto& [participant, counts] : own) {
    if (source.own(block.block, participant, block.block + ".weber_fraction") == nullptr) {
      continue;
    }
    figure.participants.push_back(own_figure(source, figure, participant, counts, low, high));
  }
  return figure;
}

}  // namespace

std::vector<Discrimination> discriminations_of(const ResultsSource& source) {
  std::vector<Discrimination> figures;
  for (const BlockDesign& block : source.data.blocks) {
    if (!block.compares()) continue;
    if (auto figure = discrimination_of(source, block)) figures.push_back(std::move(*figure));
  }
  return figures;
}

}  // namespace jnd::app
