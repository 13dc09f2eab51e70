#include <cmath>
#include <map>

#include "analysis/results/magnitude_fits.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/study_results.h"
#include "analysis/statistics/within_slope.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

/// The matches of one participant, as logarithms.
struct Matches {
  std::string participant;
  MagnitudeAnswers at_standard;      ///< ln(match) at each standard.
  std::vector<GroupedPoint> starts;  ///< ln(match) over ln(start), grouped by standard.
  int num_zeros = 0;                 ///< The number of matches of 0, which have no logarithm.
};

Matches matches_of(const ParticipantData& participant, const std::string& block) {
  Matches own{.participant = participant.participant};
  for (const core::TrialRow& trial : participant.trials_in(block)) {
    if (!trial.reference_intensity || !trial.response) continue;
    if (!(*trial.response > 0.0)) {
      ++own.num_zeros;
      continue;
    }
    const double match_ln = std::log(*trial.response);
    own.at_standard[*trial.reference_intensity].push_back(match_ln);
    if (trial.starting_intensity.value_or(0.0) > 0.0) {
      own.starts.push_back({{trial.session, *trial.reference_intensity},
                            std::log(*trial.starting_intensity),
                            match_ln});
    }
  }
  return own;
}

/// The standard deviation about the mean of each standard, pooled over all standards.
std::optional<double> pooled_sd(const MagnitudeAnswers& logs, const Means& means) {
  double squares = 0.0;
  std::size_t degrees_of_freedom = 0;
  for (const auto& [standard, values] : logs) {
    for (const double value : values) squares += std::pow(value - means.at(standard), 2);
    degrees_of_freedom += values.size() - 1;
  }
  if (degrees_of_freedom == 0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(degrees_of_freedom));
}

class MatchingSection {
 public:
  MatchingSection(const StudyData& data, const BlockDesign& design,
                  const ResultsOptions& options)
      : design_(design), options_(options), section_{.name = design.block} {
    for (const ParticipantData& participant : data.participants) {
      Matches own = matches_of(participant, design.block);
      num_zeros_ += own.num_zeros;
      if (own.at_standard.empty()) {
        if (own.num_zeros == 0) {
          name_without_answers(section_.excluded, participant, design.block);
        } else {
          section_.excluded.push_back(
              {participant.participant, said("no match above 0 in {}", design.block)});
        }
        continue;
      }
      names_.push_back(own.participant);
      log_means_.push_back(means_of(own.at_standard));
      matches_.push_back(std::move(own));
    }
  }

  ResultsSection finish() && {
    if (matches_.empty()) return std::move(section_);
    add_matches();
    add_overall();
    if (design_.standard_is_of_its_quantity()) add_ratio();
    add_matching_function();
    add_own("match_sd_ln",
            said("standard deviation of ln(match) about its mean at each standard, within a "
                 "participant: like ln(1 + Weber fraction), with the noise of standard and "
                 "comparison in it"),
            [](const Matches& own, const Means& means) {
              return pooled_sd(own.at_standard, means);
            });
    const std::vector<double> slopes =
        add_own("starting_value_slope",
                said("how far ln(match) follows the logarithm of the starting value, within a "
                     "standard: 0 not at all, 1 wholly"),
                [](const Matches& own, const Means&) { return within_slope(own.starts); });
    add_test("starting_value_slope", slopes);
    section_.estimates.push_back(
        {.name = design_.block + ".num_zeros",
         .value = num_zeros_,
         .unit = "1",
         .meaning = said("matches of 0, which have no logarithm: left out"),
         .n = static_cast<int>(matches_.size())});
    return std::move(section_);
  }

 private:
  [[nodiscard]] std::string standard_words(double standard) const {
    const std::string unit = experiments::unit_of_quantity(design_.standard_quantity());
    return said("{}{} of {}", number_text(standard), (unit == "1" ? "" : " " + unit),
                design_.written.standard_medium);
  }

  void add_matches() {
    std::map<double, std::vector<double>> by_standard;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      for (const auto& [standard, mean_ln] : log_means_[i]) {
        by_standard[standard].push_back(mean_ln);
        section_.participants.push_back(
            {names_[i], name_at(standard), std::exp(mean_ln), {}, ""});
      }
    }
    for (const auto& [standard, logs] : by_standard) {
      add_geometric_mean(section_, name_at(standard),
                         said("geometric mean of the participants' geometric means of what "
                              "they matched to the standard {}",
                              standard_words(standard)),
                         logs, experiments::unit_of_quantity(design_.quantity));
    }
  }

  [[nodiscard]] std::string name_at(double standard) const {
    return design_.block + ".match_at_" + number_text(standard);
  }

  /// Adds the mean over all standards, each with equal weight. `jnd power` plans for this
  /// value.
  void add_overall() {
    std::vector<double> logs;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      double sum = 0.0;
      for (const auto& [standard, mean_ln] : log_means_[i]) sum += mean_ln;
      logs.push_back(sum / static_cast<double>(log_means_[i].size()));
      section_.participants.push_back(
          {names_[i], design_.block + ".match", std::exp(logs.back()), {}, ""});
    }
    add_geometric_mean(section_, design_.block + ".match",
                       said("geometric mean of the participants' matches over all standards"),
                       logs, experiments::unit_of_quantity(design_.quantity));
  }

  /// Adds the constant error as a ratio. For each participant it is the mean over standards in
  /// ln.
  void add_ratio() {
    std::vector<double> logs;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      double sum = 0.0;
      for (const auto& [standard, mean_ln] : log_means_[i]) sum += mean_ln - std::log(standard);
      logs.push_back(sum / static_cast<double>(log_means_[i].size()));
      section_.participants.push_back(
          {names_[i], design_.block + ".ratio_to_standard", std::exp(logs.back()), {}, ""});
    }
    add_geometric_mean(section_, design_.block + ".ratio_to_standard",
                       said("match over standard, geometric mean over standards and "
                            "participants: 1 is without constant error"),
                       logs);
    add_test("ln ratio_to_standard", logs, "match");
  }

  /// Adds the matching function, which says what feels alike over the range. Its exponent is
  /// that of the standard's growth of sensation divided by that of the comparison's.
  void add_matching_function() {
    const auto fit = [&](const std::vector<std::size_t>& drawn, Solver) {
      return fit_log_estimation(group_means(log_means_, drawn));
    };
    if (group_means(log_means_, everyone(matches_.size())).size() < 2) return;
    (void)add_power_law(section_, design_.block,
                        said("matching function, match = k standard^a: line through the "
                             "logarithms of the geometric means"),
                        matches_.size(), fit, options_);
    add_own_power_laws(section_, design_.block, names_,
                       [&](std::size_t i) { return fit_log_estimation(log_means_[i]); });
  }

  /// Adds one number for each participant, and their mean.
  template <typename OfOne>
  std::vector<double> add_own(const std::string& name, const std::string& meaning,
                              const OfOne& of_one) {
    std::vector<double> values;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      const std::optional<double> own = of_one(matches_[i], log_means_[i]);
      if (own) values.push_back(*own);
      section_.participants.push_back({names_[i],
                                       design_.block + "." + name,
                                       own,
                                       {},
                                       own ? "" : said("too few matches that tell it")});
    }
    if (!values.empty()) {
      add_mean(section_, design_.block + "." + name,
               said("{}; mean of the participants", meaning), values);
    }
    return values;
  }

  void add_test(const std::string& name, const std::vector<double>& values,
                const std::string& ratio_of = "") {
    if (values.empty()) return;
    const std::string test = said("{}: {} against 0", design_.block, name);
    section_.comparisons.push_back(
        {.name = test + ", t", .comparison = one_sample_t_test(values), .ratio_of = ratio_of});
    section_.comparisons.push_back(
        {.name = said("{}, ranks, sensitivity", test),
         .comparison = wilcoxon_test(values, std::vector<double>(values.size(), 0.0)),
         .ratio_of = ratio_of});
  }

  const BlockDesign& design_;
  const ResultsOptions& options_;
  ResultsSection section_;
  std::vector<std::string> names_;
  std::vector<Matches> matches_;
  std::vector<Means> log_means_;  ///< In the order of `matches_`.
  double num_zeros_ = 0.0;
};

}  // namespace

ResultsSection matching_results(const StudyData& data, const BlockDesign& design,
                                const ResultsOptions& options) {
  return MatchingSection(data, design, options).finish();
}

}  // namespace jnd::analysis
