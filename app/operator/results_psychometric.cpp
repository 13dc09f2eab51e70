#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "analysis/fits/interval_order_fit.h"
#include "analysis/groups/wilson_interval.h"
#include "analysis/quantity_unit.h"
#include "analysis/threshold_results.h"
#include "app/operator/results_model.h"
#include "app/operator/study_words.h"

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
double probability(double reference, double weber_fraction, double order_effect_ln,
                   double intensity) {
  if (!std::isfinite(weber_fraction)) return 0.5;
  return analysis::mean_over_orders(reference, weber_fraction, order_effect_ln, intensity);
}

void draw_curve(PsychometricFigure& figure, double reference, double low, double high) {
  if (!figure.weber_fraction) return;
  const double q = figure.order_effect_ln;
  // Of two orders drawn as their mean, no place shows the Weber fraction.
  if (q == 0.0) figure.weber_line = reference * (1.0 + *figure.weber_fraction);
  const bool has_band = figure.ci95.low || figure.ci95.high;
  const double least = figure.ci95.low.value_or(0.0);
  const double most = figure.ci95.high.value_or(std::numeric_limits<double>::infinity());
  for (const double x : logarithmic_grid(low, high)) {
    figure.curve.push_back({x, probability(reference, *figure.weber_fraction, q, x)});
    if (!has_band) continue;
    const double steep = probability(reference, least, q, x);
    const double flat = probability(reference, most, q, x);
    figure.band.push_back({x, std::min(steep, flat), std::max(steep, flat)});
  }
}

/// What was said of the pooled answers that have no curve: after "...: no value, ".
std::string pooled_reason(const analysis::ResultsSection& section, const std::string& name) {
  for (const analysis::ExcludedParticipant& one : section.excluded) {
    const std::string start = name + ": ";
    if (one.participant == "everyone" && one.reason.starts_with(start)) {
      return one.reason.substr(start.size());
    }
  }
  return "no value";
}

/// For whoever answered, not for whoever fits.
std::string in_plain_words(const std::string& reason) {
  if (reason.find("separated") == std::string::npos) return reason;
  return "every answer fell on its side of the reference, so the Weber fraction is smaller "
         "than "
         "these stimuli can show; stimuli nearer to the reference would find it";
}

std::optional<Discrimination> discrimination_of(const ResultsSource& source,
                                                const BlockDesign& block) {
  const analysis::ResultsSection* section = source.section(block.block);
  const std::string name = block.block + ".weber_fraction";
  const Estimate* pooled = source.results.find(name);
  if (section == nullptr || pooled == nullptr) return std::nullopt;
  Discrimination figure{
      .block = block.block,
      .title = source.title(block.block),
      .quantity = quantity_words(block.quantity),
      .unit = analysis::quantity_unit(block.quantity),
      .answer = block.protocol.task == "two_interval" ? "test chosen" : "“yes”",
      .has_fixed_levels = analysis::has_fixed_levels(block),
      .published = pooled->published,
      .published_sd = pooled->published_sd};
  Counts all;
  std::map<std::string, std::pair<Counts, double>> own;
  for (const ParticipantData& participant : source.data.participants) {
    auto& [counts, reference] = own[participant.participant];
    count(participant, block.block, counts, reference);
    if (figure.reference == 0.0) figure.reference = reference;
    double ignored = 0.0;
    count(participant, block.block, all, ignored);
  }
  if (all.empty()) return std::nullopt;
  const auto first =
      std::find_if(all.begin(), all.end(), [](const auto& level) { return level.first > 0.0; });
  const double low =
      0.9 * (first == all.end() ? figure.reference : std::min(first->first, figure.reference));
  const double high = 1.1 * std::max(all.rbegin()->first, figure.reference);
  figure.pooled = {
      .who = kEveryone,
      .points = proportions(all),
      .weber_fraction = pooled->value,
      .ci95 = pooled->ci95,
      .order_effect_ln = value_or_0(source.results.find(name + "_order_effect_ln")),
      .reason = pooled->value ? "" : in_plain_words(pooled_reason(*section, name))};
  figure.pooled_by_maximum_likelihood =
      source.results.find(name + "_order_effect_ln") != nullptr;
  if (const Estimate* person = source.results.find(name + "_median_person")) {
    figure.median_person = person->value;
    figure.median_person_ci95 = person->ci95;
  }
  draw_curve(figure.pooled, figure.reference, low, high);
  for (const auto& [participant, counted] : own) {
    const analysis::ParticipantEstimate* estimate = source.own(block.block, participant, name);
    if (estimate == nullptr) continue;
    PsychometricFigure one{
        .who = participant,
        .points = proportions(counted.first),
        .weber_fraction = estimate->value,
        .ci95 = estimate->ci95,
        .order_effect_ln = value_or_0(source.own(
            block.block, participant, block.block + ".order_effect_ln_at_reference")),
        .reason = in_plain_words(estimate->reason)};
    draw_curve(one, counted.second, low, high);
    figure.participants.push_back(std::move(one));
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
