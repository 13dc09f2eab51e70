#include "analysis/results/published_comparison.h"

#include <algorithm>
#include <cmath>

#include "analysis/data/magnitude_means.h"
#include "analysis/results/predictive_comparison.h"
#include "analysis/results/published_statistics.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// Adds published statistics for which `results` has no estimate yet.
void add_own_statistics(StudyResults& results, const StudyData& data,
                        const Published& published, const ResultsOptions& options) {
  const std::vector<PersonOutcome> people = person_outcomes(data);
  PublishedStatistics statistics(people);
  ResultsSection section{.name = "as_published"};
  const std::vector<std::size_t> all = everyone(people.size());
  for (const auto& [name, value] : published.values) {
    if (!value.compute || results.find(name) != nullptr) continue;
    const PublishedStatistic& statistic = *value.compute;
    const std::optional<double> found = statistics.value(statistic, all);
    if (!found) continue;
    Estimate estimate{.name = name,
                      .value = found,
                      .unit = value.unit,
                      .meaning = value.statistic,
                      .n = static_cast<int>(people.size())};
    if (!std::isfinite(*found)) {
      estimate.value.reset();
      estimate.reason = said("somebody's own is not bounded by their answers");
      section.excluded.push_back({"everyone", said("{}: no value, {}", name, estimate.reason)});
    } else if (people.size() > 1) {
      estimate.ci95 = resample_participants(people.size(), options.num_resamples, options.seed,
                                            [&](const std::vector<std::size_t>& drawn) {
                                              return statistics.value(statistic, drawn);
                                            })
                          .ci95;
    }
    section.estimates.push_back(std::move(estimate));
  }
  if (!section.estimates.empty()) results.sections.push_back(std::move(section));
}

/// The difference of two means divided by their joint standard error.
std::optional<double> published_z(const std::vector<double>& ours,
                                  const PublishedValue& value) {
  if (!value.standard_deviation || !value.n || *value.n < 1) return std::nullopt;
  if (!std::ranges::all_of(ours, [](double one) { return std::isfinite(one); })) {
    return std::nullopt;
  }
  const Summary summary = summary_of(ours);
  if (!summary.standard_deviation) return std::nullopt;
  const double variance = std::pow(*summary.standard_deviation, 2) / summary.num_values +
                          std::pow(*value.standard_deviation, 2) / *value.n;
  if (!(variance > 0.0)) return std::nullopt;
  return (*summary.mean - *value.value) / std::sqrt(variance);
}

void put_beside(Estimate& estimate, const PublishedValue& value) {
  estimate.published = value.value;
  estimate.published_positive = value.positive;
  estimate.published_sd = value.standard_deviation;
  estimate.published_place = value.place;
  estimate.published_statistic = value.statistic;
}

}  // namespace

void add_published(StudyResults& results, const StudyData& data, const Published& published,
                   const ResultsOptions& options) {
  if (published.values.empty()) return;
  add_own_statistics(results, data, published, options);
  const std::vector<PersonOutcome> people = person_outcomes(data);
  PublishedStatistics statistics(people);
  for (ResultsSection& section : results.sections) {
    // Numbers relative to a participant's own modulus, or to another standard, are not percent
    // of water.
    const bool counts_alike = std::ranges::all_of(data.blocks, [&](const BlockDesign& block) {
      return block.block != section.name || block.counts_in_water();
    });
    if (!counts_alike) continue;
    for (Estimate& estimate : section.estimates) {
      const auto found = published.values.find(estimate.name);
      if (found == published.values.end()) continue;
      put_beside(estimate, found->second);
      if (!found->second.value || !found->second.compute) continue;
      estimate.published_z = published_z(
          statistics.averaged(*found->second.compute, everyone(people.size())), found->second);
    }
  }
}

void add_predictive(StudyResults& results, const Published& published,
                    const PredictivePeople& people) {
  const PredictiveStudies studies(people, published.num_participants, kPredictiveStudies);
  results.predictive = {.num_people = people.num_people(),
                        .num_studies = studies.num_studies(),
                        .num_participants = published.num_participants};
  std::vector<PublishedValue> all, held_out;
  for (ResultsSection& section : results.sections) {
    for (Estimate& estimate : section.estimates) {
      const auto found = published.values.find(estimate.name);
      if (!estimate.published || found == published.values.end()) continue;
      estimate.predictive = studies.tail_of(found->second);
      all.push_back(found->second);
      if (!estimate.calibrated && !estimate.implied) held_out.push_back(found->second);
    }
  }
  results.predictive.joint = studies.joint_tail(all);
  results.predictive.joint_held_out = studies.joint_tail(held_out);
}

}  // namespace jnd::analysis
