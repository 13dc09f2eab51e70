#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "analysis/fits/power_fit.h"
#include "analysis/groups/summary.h"
#include "analysis/study_results.h"

namespace jnd::analysis {
namespace {

/// One participant's mean at each x.
using Means = std::map<double, double>;

Means means_by(const std::vector<core::TrialRow>& trials,
               std::optional<double> core::TrialRow::*x, double response_unit) {
  std::map<double, std::pair<double, int>> sums;
  for (const core::TrialRow& trial : trials) {
    if (!(trial.*x) || !trial.response) continue;
    auto& [sum, count] = sums[*(trial.*x)];
    sum += *trial.response * response_unit;
    ++count;
  }
  Means means;
  for (const auto& [at, sum] : sums) means[at] = sum.first / sum.second;
  return means;
}

/// Participants with answers in a block, and those without.
struct BlockMeans {
  std::vector<Means> participants;
  std::vector<std::string> names;
  std::vector<ExcludedParticipant> excluded;
};

BlockMeans block_means(const StudyData& data, const BlockDesign& block,
                       std::optional<double> core::TrialRow::*x, double response_unit) {
  BlockMeans result;
  for (const ParticipantData& participant : data.participants) {
    const std::vector<core::TrialRow> trials = participant.trials_in(block.block);
    if (trials.empty()) {
      result.excluded.push_back({participant.participant, "no answers in " + block.block});
      continue;
    }
    result.participants.push_back(means_by(trials, x, response_unit));
    result.names.push_back(participant.participant);
  }
  return result;
}

/// Mean over the participants drawn, at each x.
Means group_means(const std::vector<Means>& participants,
                  const std::vector<std::size_t>& drawn) {
  std::map<double, std::pair<double, int>> sums;
  for (const std::size_t index : drawn) {
    for (const auto& [x, mean] : participants[index]) {
      sums[x].first += mean;
      ++sums[x].second;
    }
  }
  Means means;
  for (const auto& [x, sum] : sums) means[x] = sum.first / sum.second;
  return means;
}

std::vector<std::size_t> everyone(std::size_t num_participants) {
  std::vector<std::size_t> all(num_participants);
  for (std::size_t i = 0; i < num_participants; ++i) all[i] = i;
  return all;
}

/// Estimation: x is the intensity, the mean is the magnitude.
PowerFit estimation_fit(const BlockMeans& block, const std::vector<std::size_t>& drawn,
                        Solver solver) {
  std::vector<Magnitude> rows;
  for (const auto& [intensity, magnitude] : group_means(block.participants, drawn)) {
    rows.push_back({intensity, magnitude});
  }
  return fit_power(rows, PowerMethod::kNonlinear, solver);
}

/// Production: x is the target in percent, the mean is the intensity that was set.
PowerFit production_fit(const BlockMeans& block, const std::vector<std::size_t>& drawn,
                        Solver solver) {
  std::vector<Magnitude> rows;
  for (const auto& [target_percent, intensity] : group_means(block.participants, drawn)) {
    rows.push_back({intensity, target_percent / 100.0});
  }
  return fit_power(rows, PowerMethod::kNonlinear, solver);
}

/// Every participant's own power law.
void add_individual(ResultsSection& section, const std::string& prefix, const BlockMeans& block,
                    const std::function<PowerFit(std::size_t)>& fit) {
  for (std::size_t i = 0; i < block.participants.size(); ++i) {
    const PowerFit own = fit(i);
    section.participants.push_back(
        {block.names[i], prefix + ".k", own.k, own.k_ci95, own.reason});
    section.participants.push_back(
        {block.names[i], prefix + ".a", own.a, own.a_ci95, own.reason});
  }
}

using Fit = std::function<PowerFit(const std::vector<std::size_t>&, Solver)>;

/// k and a of a fit, each with its interval over resampled participants.
void add_power_law(ResultsSection& section, const std::string& prefix,
                   const std::string& meaning, std::size_t num_participants, const Fit& fit,
                   const ResultsOptions& options) {
  const PowerFit whole = fit(everyone(num_participants), Solver::kCeres);
  const auto interval = [&](std::optional<double> PowerFit::*value) {
    return resample_participants(num_participants, options.num_resamples, options.seed,
                                 [&](const std::vector<std::size_t>& drawn) {
                                   return fit(drawn, Solver::kNewton).*value;
                                 })
        .ci95;
  };
  for (const auto& [letter, value] : {std::pair{"k", &PowerFit::k}, {"a", &PowerFit::a}}) {
    Estimate estimate{.name = prefix + "." + letter,
                      .value = whole.*value,
                      .unit = "1",
                      .meaning = meaning + (*letter == 'k' ? ": factor" : ": exponent"),
                      .n = static_cast<int>(num_participants)};
    if (estimate.value && num_participants > 1) estimate.ci95 = interval(value);
    section.estimates.push_back(std::move(estimate));
  }
}

/// Mean and spread between participants of one number each.
void add_mean(ResultsSection& section, const std::string& name, const std::string& meaning,
              const std::vector<double>& values, const std::string& unit = "1") {
  const Summary summary = summary_of(values);
  section.estimates.push_back({.name = name,
                               .value = summary.mean,
                               .ci95 = summary.mean_ci95,
                               .unit = unit,
                               .meaning = meaning,
                               .n = summary.num_values});
}

/// Interval of something about one value a participant, over resampled participants.
Interval resampled(const std::vector<double>& values, const ResultsOptions& options,
                   const std::function<std::optional<double>(const Summary&)>& statistic) {
  if (values.empty()) return {};
  return resample_participants(values.size(), options.num_resamples, options.seed,
                               [&](const std::vector<std::size_t>& drawn) {
                                 std::vector<double> sample;
                                 for (const std::size_t i : drawn) sample.push_back(values[i]);
                                 return statistic(summary_of(sample));
                               })
      .ci95;
}

/// Standard deviation between participants.
void add_spread(ResultsSection& section, const std::string& name,
                const std::vector<double>& values, const ResultsOptions& options) {
  const Summary summary = summary_of(values);
  if (!summary.standard_deviation) return;
  section.estimates.push_back(
      {.name = name,
       .value = summary.standard_deviation,
       .ci95 = resampled(values, options,
                         [](const Summary& sample) { return sample.standard_deviation; }),
       .unit = "1",
       .meaning = "standard deviation between participants",
       .n = summary.num_values});
}

/// One participant's answers of one repetition, by intensity.
Means repetition_curve(const std::vector<core::TrialRow>& trials, std::int64_t repetition) {
  Means curve;
  for (const core::TrialRow& trial : trials) {
    if (trial.repetition == repetition && trial.intensity && trial.response) {
      curve[*trial.intensity] = *trial.response;
    }
  }
  return curve;
}

/// Of the intensities that both repetitions have; none with fewer than three.
std::optional<double> correlation_of(const Means& first, const Means& second) {
  std::vector<double> a;
  std::vector<double> b;
  for (const auto& [intensity, response] : first) {
    const auto other = second.find(intensity);
    if (other == second.end()) continue;
    a.push_back(response);
    b.push_back(other->second);
  }
  if (a.size() < 3) return std::nullopt;
  return pearson_correlation(a, b).estimate;
}

/// How well repetitions of the same estimation agree, as in table D.2 of the thesis.
void add_trial_correlations(ResultsSection& section, const StudyData& data,
                            const BlockDesign& block, const ResultsOptions& options) {
  std::int64_t num_repetitions = 0;
  for (const ParticipantData& participant : data.participants) {
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      num_repetitions = std::max(num_repetitions, trial.repetition);
    }
  }
  std::vector<std::vector<double>> by_participant(data.participants.size());
  for (std::int64_t first = 1; first <= num_repetitions; ++first) {
    for (std::int64_t second = first + 1; second <= num_repetitions; ++second) {
      std::vector<double> correlations;
      for (std::size_t i = 0; i < data.participants.size(); ++i) {
        const std::vector<core::TrialRow> trials = data.participants[i].trials_in(block.block);
        const std::optional<double> r =
            correlation_of(repetition_curve(trials, first), repetition_curve(trials, second));
        if (!r) continue;
        correlations.push_back(*r);
        by_participant[i].push_back(*r);
      }
      const Summary summary = summary_of(correlations);
      section.estimates.push_back(
          {.name =
               "trial_correlation.t" + std::to_string(first) + "_t" + std::to_string(second),
           .value = summary.mean,
           // Over resampled participants: Student's t would leave [-1, 1].
           .ci95 = resampled(correlations, options,
                             [](const Summary& sample) { return sample.mean; }),
           .unit = "1",
           .meaning = "correlation of two repetitions, mean of the participants",
           .n = summary.num_values});
    }
  }
  const auto median = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    std::vector<double> all;
    for (const std::size_t i : drawn) {
      all.insert(all.end(), by_participant[i].begin(), by_participant[i].end());
    }
    if (all.empty()) return std::nullopt;
    return summary_of(all).median;
  };
  Estimate estimate{.name = "trial_correlation_median",
                    .value = median(everyone(by_participant.size())),
                    .unit = "1",
                    .meaning = "median of the correlations of all participants and pairs",
                    .n = static_cast<int>(data.participants.size())};
  if (!estimate.value) return;
  estimate.ci95 =
      resample_participants(by_participant.size(), options.num_resamples, options.seed, median)
          .ci95;
  section.estimates.push_back(std::move(estimate));
}

}  // namespace

ResultsSection estimation_results(const StudyData& data, const BlockDesign& block,
                                  const ResultsOptions& options) {
  const BlockMeans means = block_means(data, block, &core::TrialRow::intensity, 0.01);
  ResultsSection section{.name = block.block, .excluded = means.excluded};
  if (means.participants.empty()) return section;
  add_power_law(
      section, block.block, "power law through the group means", means.participants.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return estimation_fit(means, drawn, solver);
      },
      options);
  add_power_law(
      section, block.block + ".data_points", "power law through the participants' means",
      means.participants.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        std::vector<Magnitude> rows;
        for (const std::size_t index : drawn) {
          for (const auto& [intensity, magnitude] : means.participants[index]) {
            rows.push_back({intensity, magnitude});
          }
        }
        return fit_power(rows, PowerMethod::kNonlinear, solver);
      },
      options);
  add_power_law(
      section, block.block + ".log_log", "line through the logarithms of the group means",
      means.participants.size(),
      [&](const std::vector<std::size_t>& drawn, Solver) {
        std::vector<Magnitude> rows;
        for (const auto& [x, mean] : group_means(means.participants, drawn)) {
          rows.push_back({x, mean});
        }
        return fit_power(rows, PowerMethod::kLogLog);
      },
      options);
  add_individual(section, block.block, means, [&](std::size_t index) {
    return estimation_fit(means, {index}, Solver::kCeres);
  });
  add_trial_correlations(section, data, block, options);
  return section;
}

ResultsSection production_results(const StudyData& data, const BlockDesign& block,
                                  const ResultsOptions& options) {
  const BlockMeans means = block_means(data, block, &core::TrialRow::target_percent, 1.0);
  ResultsSection section{.name = block.block, .excluded = means.excluded};
  if (means.participants.empty()) return section;
  add_power_law(
      section, block.block, "power law through the mean set values", means.participants.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return production_fit(means, drawn, solver);
      },
      options);
  add_individual(section, block.block, means, [&](std::size_t index) {
    return production_fit(means, {index}, Solver::kCeres);
  });
  std::map<double, std::vector<double>> by_target;
  for (const Means& participant : means.participants) {
    for (const auto& [target, set] : participant) by_target[target].push_back(set);
  }
  for (const auto& [target, values] : by_target) {
    add_mean(section, "set_intensity." + std::to_string(std::lround(target)) + "_percent",
             "mean set value for this target", values,
             block.quantity == "viscosity_pa_s" ? "Pa s" : "1");
  }
  // Ratios of successive targets, as in fig. D.13 of the thesis.
  for (auto low = by_target.begin(); low != by_target.end(); ++low) {
    const auto high = std::next(low);
    if (high == by_target.end()) break;
    std::vector<double> ratios;
    for (const Means& participant : means.participants) {
      const auto a = participant.find(low->first);
      const auto b = participant.find(high->first);
      if (a != participant.end() && b != participant.end() && a->second > 0.0) {
        ratios.push_back(b->second / a->second);
      }
    }
    const std::string targets = std::to_string(std::lround(high->first)) + "_" +
                                std::to_string(std::lround(low->first));
    add_mean(section, "production_ratio_" + targets,
             "ratio of the set values of two targets, mean of the participants", ratios);
    add_spread(section, "production_ratio_" + targets + ".sd", ratios, options);
  }
  return section;
}

ResultsSection combined_results(const StudyData& data, const BlockDesign& estimation,
                                const BlockDesign& production, const ResultsOptions& options) {
  ResultsSection section{.name = "combined"};
  BlockMeans estimated = block_means(data, estimation, &core::TrialRow::intensity, 0.01);
  BlockMeans produced = block_means(data, production, &core::TrialRow::target_percent, 1.0);
  // Only those with both parts, in one order, so that a draw takes both of a person.
  std::vector<Means> both_estimated;
  std::vector<Means> both_produced;
  for (std::size_t i = 0; i < estimated.names.size(); ++i) {
    const auto same =
        std::find(produced.names.begin(), produced.names.end(), estimated.names[i]);
    if (same == produced.names.end()) {
      section.excluded.push_back({estimated.names[i], "no answers in " + production.block});
      continue;
    }
    both_estimated.push_back(estimated.participants[i]);
    both_produced.push_back(
        produced.participants[static_cast<std::size_t>(same - produced.names.begin())]);
  }
  if (both_estimated.empty()) return section;
  estimated.participants = std::move(both_estimated);
  produced.participants = std::move(both_produced);
  std::vector<double> intensities;
  for (const auto& [intensity, mean] :
       group_means(estimated.participants, everyone(estimated.participants.size()))) {
    intensities.push_back(intensity);
  }
  add_power_law(
      section, "combined", "power law between estimation and production",
      estimated.participants.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) -> PowerFit {
        const PowerFit first = estimation_fit(estimated, drawn, solver);
        const PowerFit second = production_fit(produced, drawn, solver);
        if (!first.k || !first.a || !second.k || !second.a) return {};
        return power_between({*first.k, *first.a}, {*second.k, *second.a}, intensities, solver);
      },
      options);
  return section;
}

}  // namespace jnd::analysis
