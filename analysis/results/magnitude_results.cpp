#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/data/magnitude_means.h"
#include "analysis/results/magnitude_fits.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/study_results.h"
#include "analysis/results/trial_correlations.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

constexpr const char* kZeroRule =
    said_later("answers of 0 as half the person's smallest above 0");

/// The functions in which estimation and production differ.
struct Kind {
  PowerFit (*fit)(const Means&, PowerMethod, Solver);
  PowerFit (*fit_logs)(const Means&);
};
constexpr Kind kEstimation = {fit_estimation, fit_log_estimation};
constexpr Kind kProduction = {fit_production, fit_log_production};

/// Names participants who have answers, but none with a logarithm.
void name_without_logarithms(ResultsSection& section, const std::string& name,
                             const MagnitudeBlock& block) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (with_mean_above_zero({block.means[i]}).empty() || !block.log_means[i].empty()) continue;
    section.excluded.push_back(
        {block.names[i],
         said("{}.geometric: every answer is 0, which has no logarithm", name)});
  }
}

/// Names participants who have answers only at intensity 0.
void name_without_intensities(ResultsSection& section, const std::string& name,
                              const MagnitudeBlock& block) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (!with_mean_above_zero({block.means[i]}).empty()) continue;
    section.excluded.push_back(
        {block.names[i], said("{}: no power law, no answer at an intensity above 0", name)});
  }
}

/// Adds the line through the logarithms of geometric means, which is the customary analysis of
/// magnitudes since Stevens. It also adds the fit after modulus equalisation, and how far the
/// moduli differ.
void add_geometric(ResultsSection& section, const BlockDesign& design,
                   const MagnitudeBlock& block, const Kind& kind,
                   const ResultsOptions& options) {
  const std::string& name = design.block;
  const std::string zeros = block.num_zeros > 0 ? std::string(", ") + said(kZeroRule) : "";
  const std::vector<Means> log_means = with_mean_above_zero(block.log_means);
  const std::vector<Means> without_zeros = with_mean_above_zero(block.log_means_without_zeros);
  (void)add_power_law(
      section, name + ".geometric",
      said("line through the logarithms of the geometric means{}", zeros), log_means.size(),
      [&](const std::vector<std::size_t>& drawn, Solver) {
        return kind.fit_logs(group_means(log_means, drawn));
      },
      options);
  if (block.num_zeros > 0) {
    (void)add_power_law(
        section, name + ".geometric_without_zeros",
        said("line through the logarithms of the geometric means, answers of 0 left out"),
        without_zeros.size(),
        [&](const std::vector<std::size_t>& drawn, Solver) {
          return kind.fit_logs(group_means(without_zeros, drawn));
        },
        options);
  }
  section.estimates.push_back(
      {.name = name + ".num_zeros",
       .value = block.num_zeros,
       .unit = "1",
       .meaning = said("answers of 0 where one above 0 was expected; for logarithms: {}{}",
                       said(kZeroRule),
                       (log_means.size() < with_mean_above_zero(block.means).size()
                            ? said(", and nothing of who has none above 0")
                            : "")),
       .n = static_cast<int>(block.size())});
  name_without_logarithms(section, name, block);
  // Here every fit is already one of equalised moduli.
  if (!design.own_log_moduli.empty()) return;
  const auto moduli = log_moduli(block);
  if (!moduli) {
    section.excluded.push_back(
        {"everyone",
         said("{}.equalised: no stimulus that all participants answered above 0", name)});
    return;
  }
  (void)add_power_law(
      section, name + ".equalised", said("power law through the group means, moduli equalised"),
      block.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return kind.fit(equalised_means(block.means, *moduli, drawn), PowerMethod::kNonlinear,
                        solver);
      },
      options);
  add_spread(section, name + ".modulus_sd_ln",
             said("standard deviation between participants of the logarithm of their modulus, "
                  "the geometric mean of their answers"),
             *moduli, options);
}

/// Adds statistics of the participants' own exponents, which need no curve of averages.
void add_own_exponents(ResultsSection& section, const std::string& name,
                       const ResultsOptions& options) {
  std::vector<double> exponents;
  for (const ParticipantEstimate& own : section.participants) {
    if (own.name == name + ".a" && own.value) exponents.push_back(*own.value);
  }
  add_mean(section, name + ".individual_a_mean",
           said("mean of the participants' own exponents"), exponents);
  section.estimates.push_back(
      {.name = name + ".individual_a_median",
       .value = summary_of(exponents).median,
       .ci95 =
           resampled(exponents, options, [](const Summary& sample) { return sample.median; }),
       .unit = "1",
       .meaning = said("median of the participants' own exponents"),
       .n = static_cast<int>(exponents.size())});
  add_spread(section, name + ".individual_a_sd",
             said("standard deviation between participants of their own exponents"), exponents,
             options);
}

/// The participants' values at each x.
std::map<double, std::vector<double>> by_x(const std::vector<Means>& participants) {
  std::map<double, std::vector<double>> values;
  for (const Means& own : participants) {
    for (const auto& [x, mean] : own) values[x].push_back(mean);
  }
  return values;
}

/// What a magnitude of 1 means.
std::string unit_words(const BlockDesign& design) {
  if (design.counts_in_water()) return said("water being 1");
  return design.counts_in_standard() ? said("the standard being 1")
                                     : said("everybody's own modulus being 1");
}

/// Adds the moduli. If people chose their own numbers, only the ratios between the numbers have
/// a meaning.
void add_moduli(ResultsSection& section, const BlockDesign& design, const MagnitudeBlock& block,
                const ResultsOptions& options) {
  if (design.counts_in_water()) return;
  if (design.counts_in_standard()) {
    section.excluded.push_back(
        {"everyone",
         said("{}: comparisons in percent of water, for magnitudes are ratios to the standard",
              design.block)});
    return;
  }
  if (design.own_log_moduli.empty()) {
    section.excluded.push_back(
        {"everyone", said("{}: equalised moduli, no stimulus that all participants answered; "
                          "the numbers stand as they were said",
                          design.block)});
    return;
  }
  section.excluded.push_back(
      {"everyone", said("{}: k as a size and comparisons in percent of water, for everybody "
                        "chose their own numbers; moduli were equalised before every fit",
                        design.block)});
  std::vector<double> moduli;
  for (const auto& [participant, log_modulus] : design.own_log_moduli) {
    if (std::ranges::find(block.names, participant) == block.names.end())
      continue;  // This participant was left out.
    moduli.push_back(log_modulus);
    section.participants.push_back(
        {participant, design.block + ".modulus", std::exp(log_modulus), {}, ""});
  }
  add_spread(section, design.block + ".modulus_sd_ln",
             said("standard deviation between participants of the logarithm of their modulus, "
                  "the geometric mean of their numbers"),
             moduli, options);
}

void add_estimation_means(ResultsSection& section, const BlockDesign& design,
                          const MagnitudeBlock& block) {
  const std::string& name = design.block;
  for (const auto& [intensity, values] : by_x(block.means)) {
    add_mean(section, name + ".mean_at_" + number_text(intensity),
             said("arithmetic mean of the participants' means, {}", unit_words(design)),
             values);
  }
  for (const auto& [intensity, logs] : by_x(block.log_means)) {
    add_geometric_mean(section, name + ".geometric_mean_at_" + number_text(intensity),
                       said("geometric mean of the participants' geometric means"), logs);
  }
}

std::string percent_name(double target) { return std::to_string(std::lround(target)); }

void add_set_intensities(ResultsSection& section, const BlockDesign& design,
                         const MagnitudeBlock& block) {
  for (const auto& [target, values] : by_x(block.means)) {
    add_mean(section, "set_intensity." + percent_name(target) + "_percent",
             said("mean set value for this target"), values,
             experiments::unit_of_quantity(design.quantity));
  }
  for (const auto& [target, logs] : by_x(block.log_means)) {
    add_geometric_mean(section,
                       "set_intensity." + percent_name(target) + "_percent.geometric_mean",
                       said("geometric mean of the set values for this target"), logs,
                       experiments::unit_of_quantity(design.quantity));
  }
}

/// Adds ratios of successive targets, as in fig. D.13 of the thesis.
void add_production_ratios(ResultsSection& section, const MagnitudeBlock& block,
                           const ResultsOptions& options) {
  const auto by_target = by_x(block.means);
  for (auto low = by_target.begin(); low != by_target.end(); ++low) {
    const auto high = std::next(low);
    if (high == by_target.end()) break;
    const std::string name =
        "production_ratio_" + percent_name(high->first) + "_" + percent_name(low->first);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto a = block.means[i].find(low->first);
      const auto b = block.means[i].find(high->first);
      const bool has_both = a != block.means[i].end() && b != block.means[i].end();
      if (!has_both || !(a->second > 0.0)) {
        section.participants.push_back({block.names[i],
                                        name,
                                        std::nullopt,
                                        {},
                                        has_both ? said("0 was set for the lower target")
                                                 : said("one of the targets has no answer")});
        continue;
      }
      ratios.push_back(b->second / a->second);
      section.participants.push_back({block.names[i], name, ratios.back(), {}, ""});
    }
    add_mean(section, name,
             said("ratio of the set values of two targets, mean of the participants"), ratios);
    add_spread(section, name + ".sd", said("standard deviation between participants"), ratios,
               options);
  }
}

/// The means of the drawn participants as rows of the regression of I on S.
std::vector<Produced> produced(const Means& log_means_at_target) {
  std::vector<Produced> rows;
  for (const auto& [target_percent, log_intensity] : log_means_at_target) {
    rows.push_back({target_percent / 100.0, log_intensity});
  }
  return rows;
}

void add_intensity_on_magnitude(ResultsSection& section, const std::string& name,
                                const MagnitudeBlock& block, const ResultsOptions& options) {
  const std::vector<Means> log_means = with_mean_above_zero(block.log_means);
  (void)add_power_law(
      section, name + ".intensity_on_magnitude",
      said("regression of I on S, in logarithms: what was answered is fitted, not what was "
           "asked"),
      log_means.size(),
      [&](const std::vector<std::size_t>& drawn, Solver) {
        return fit_intensity_on_magnitude(produced(group_means(log_means, drawn)));
      },
      options);
  add_own_power_laws(
      section, name + ".intensity_on_magnitude", block.names,
      [&](std::size_t i) { return fit_own_intensity_on_magnitude(block.answers[i]); });
}

}  // namespace

ResultsSection estimation_results(const StudyData& data, const BlockDesign& design,
                                  const ResultsOptions& options) {
  const MagnitudeBlock block = estimation_block(data, design);
  const std::string& name = design.block;
  ResultsSection section{.name = name, .excluded = block.excluded};
  if (block.size() == 0) return section;
  name_without_intensities(section, name, block);
  const std::vector<Means> means = with_mean_above_zero(block.means);
  const PowerFit whole = add_power_law(
      section, name, said("power law through the group means"), means.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return fit_estimation(group_means(means, drawn), PowerMethod::kNonlinear, solver);
      },
      options);
  add_r_squared(section, name, whole, static_cast<int>(means.size()));
  (void)add_power_law(
      section, name + ".data_points",
      said("power law through the participants' means (where everybody answered every stimulus "
           "the same as through the group means, by construction)"),
      means.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        std::vector<Magnitude> rows;
        for (const std::size_t index : drawn) {
          for (const auto& [intensity, magnitude] : means[index]) {
            rows.push_back({intensity, magnitude});
          }
        }
        return fit_power(rows, PowerMethod::kNonlinear, solver);
      },
      options);
  (void)add_power_law(
      section, name + ".log_log", said("line through the logarithms of the group means"),
      means.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return fit_estimation(group_means(means, drawn), PowerMethod::kLogLog, solver);
      },
      options);
  add_geometric(section, design, block, kEstimation, options);
  add_own_power_laws(section, name, block.names, [&](std::size_t i) {
    return fit_estimation(block.means[i], PowerMethod::kNonlinear, Solver::kCeres);
  });
  add_own_power_laws(section, name + ".geometric", block.names,
                     [&](std::size_t i) { return fit_log_estimation(block.log_means[i]); });
  add_own_exponents(section, name, options);
  add_estimation_means(section, design, block);
  add_moduli(section, design, block, options);
  add_trial_correlations(section, data, design, options);
  return section;
}

ResultsSection production_results(const StudyData& data, const BlockDesign& design,
                                  const ResultsOptions& options) {
  const MagnitudeBlock block = production_block(data, design);
  const std::string& name = design.block;
  ResultsSection section{.name = name, .excluded = block.excluded};
  if (block.size() == 0) return section;
  const std::size_t num_means = by_x(block.means).size();
  const PowerFit whole = add_power_law(
      section, name,
      said("power law through the mean set values ({} means, two parameters: the interval is "
           "over resampled participants and says nothing of the curve's shape)",
           std::to_string(num_means)),
      block.size(),
      [&](const std::vector<std::size_t>& drawn, Solver solver) {
        return fit_production(group_means(block.means, drawn), PowerMethod::kNonlinear, solver);
      },
      options);
  add_r_squared(section, name, whole, static_cast<int>(block.size()));
  add_geometric(section, design, block, kProduction, options);
  add_own_power_laws(section, name, block.names, [&](std::size_t i) {
    return fit_production(block.means[i], PowerMethod::kNonlinear, Solver::kCeres);
  });
  add_own_exponents(section, name, options);
  add_intensity_on_magnitude(section, name, block, options);
  add_set_intensities(section, design, block);
  add_production_ratios(section, block, options);
  return section;
}

}  // namespace jnd::analysis
