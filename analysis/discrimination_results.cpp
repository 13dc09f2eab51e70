#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/groups/summary.h"
#include "analysis/study_results.h"

namespace jnd::analysis {
namespace {

/// Answers of one participant in one block, by level.
struct Answers {
  std::string participant;
  double reference = 0.0;
  std::map<double, AnswerCount> levels;
};

std::vector<AnswerCount> rows_of(const std::map<double, AnswerCount>& levels) {
  std::vector<AnswerCount> rows;
  for (const auto& [intensity, count] : levels) rows.push_back(count);
  return rows;
}

std::vector<Answers> answers_in(const StudyData& data, const BlockDesign& block,
                                std::vector<ExcludedParticipant>& excluded) {
  std::vector<Answers> all;
  for (const ParticipantData& participant : data.participants) {
    Answers answers{.participant = participant.participant};
    for (const core::TrialRow& trial : participant.trials_in(block.block)) {
      if (!trial.intensity || !trial.response || !trial.reference_intensity) continue;
      answers.reference = *trial.reference_intensity;
      AnswerCount& count = answers.levels[*trial.intensity];
      count.intensity = *trial.intensity;
      count.num_yes += *trial.response > 0.5 ? 1 : 0;
      ++count.num_trials;
    }
    if (answers.levels.empty()) {
      excluded.push_back({participant.participant, "no answers in " + block.block});
    } else {
      all.push_back(std::move(answers));
    }
  }
  return all;
}

PsychometricFit pooled_fit(const std::vector<Answers>& all,
                           const std::vector<std::size_t>& drawn, PsychometricMethod method,
                           Solver solver) {
  std::map<double, AnswerCount> pooled;
  for (const std::size_t index : drawn) {
    for (const auto& [intensity, count] : all[index].levels) {
      AnswerCount& sum = pooled[intensity];
      sum.intensity = intensity;
      sum.num_yes += count.num_yes;
      sum.num_trials += count.num_trials;
    }
  }
  return fit_psychometric(rows_of(pooled), {.reference = all.front().reference,
                                            .method = method,
                                            .intervals = false,
                                            .solver = solver});
}

/// The Weber fraction of a fit; where there is none, its limit: 0 if thicker was said of the
/// thicker ones all the same (separated), else infinite (flat, inverted).
double fraction_or_limit(const PsychometricFit& fit, const std::vector<Answers>& all,
                         const std::vector<std::size_t>& drawn) {
  if (fit.weber_fraction) return *fit.weber_fraction;
  double order = 0.0;
  for (const std::size_t index : drawn) {
    for (const auto& [intensity, count] : all[index].levels) {
      order +=
          (2.0 * static_cast<double>(count.num_yes) - static_cast<double>(count.num_trials)) *
          std::log(intensity / all[index].reference);
    }
  }
  return order > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

PsychometricFit individual_fit(const Answers& answers) {
  return fit_psychometric(rows_of(answers.levels),
                          {.reference = answers.reference, .intervals = false});
}

/// The fit with half a "yes" and half a "no" added in all, spread over the levels (the count of
/// Firth 1993 for one parameter): it exists for answers that separate the stimuli perfectly,
/// and moves the others little. Counts are multiplied to stay whole, which leaves the estimate
/// as it is.
PsychometricFit corrected_fit(const Answers& answers) {
  std::vector<AnswerCount> rows = rows_of(answers.levels);
  const auto factor = 2 * static_cast<std::int64_t>(rows.size());
  for (AnswerCount& row : rows) {
    row.num_yes = factor * row.num_yes + 1;
    row.num_trials = factor * row.num_trials + 2;
  }
  return fit_psychometric(rows, {.reference = answers.reference, .intervals = false});
}

/// Individual Weber fractions; those without one are named.
std::map<std::string, double> individual_weber_fractions(
    const std::vector<Answers>& all, bool corrected, std::vector<ExcludedParticipant>& excluded,
    const std::string& block) {
  std::map<std::string, double> fractions;
  for (const Answers& answers : all) {
    const PsychometricFit fit = corrected ? corrected_fit(answers) : individual_fit(answers);
    if (fit.weber_fraction) {
      fractions[answers.participant] = *fit.weber_fraction;
    } else {
      excluded.push_back(
          {answers.participant, block + ": no Weber fraction of their own, " + fit.reason});
    }
  }
  return fractions;
}

std::vector<double> values_of(const std::map<std::string, double>& by_participant) {
  std::vector<double> values;
  for (const auto& [participant, value] : by_participant) values.push_back(value);
  return values;
}

/// One participant's own fraction, or what stands for it in ranks: nothing above the stimuli
/// can be told from anything else up there, so it counts as infinite, as do flat and inverted
/// answers; perfectly separated ones count as 0.
struct IndividualFraction {
  double for_ranks = 0.0;
  bool beyond_stimuli = false;
};

/// Median, quartiles and robust spread, which some fractions beyond the stimuli leave as they
/// are.
void add_individual(ResultsSection& section, const std::vector<Answers>& all,
                    const BlockDesign& block, const ResultsOptions& options) {
  std::vector<IndividualFraction> individual;
  std::vector<double> with_fit;
  for (const Answers& answers : all) {
    const PsychometricFit fit =
        fit_psychometric(rows_of(answers.levels), {.reference = answers.reference});
    section.participants.push_back({answers.participant, block.block + ".weber_fraction",
                                    fit.weber_fraction, fit.weber_fraction_ci95, fit.reason});
    const double largest = answers.levels.rbegin()->first / answers.reference - 1.0;
    IndividualFraction one{.for_ranks = std::numeric_limits<double>::infinity(),
                           .beyond_stimuli = true};
    if (fit.weber_fraction) {
      with_fit.push_back(*fit.weber_fraction);
      if (*fit.weber_fraction <= largest) one = {.for_ranks = *fit.weber_fraction};
    } else {
      section.excluded.push_back(
          {answers.participant,
           block.block + ": no Weber fraction of their own, " + fit.reason});
      if (corrected_fit(answers).weber_fraction.value_or(largest) < largest) one = {};
    }
    individual.push_back(one);
  }
  const auto quantile = [&](const std::vector<std::size_t>& drawn,
                            double probability) -> std::optional<double> {
    std::vector<double> values;
    for (const std::size_t i : drawn) values.push_back(individual[i].for_ranks);
    std::sort(values.begin(), values.end());
    const double value = percentile(values, probability);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  using Statistic = std::function<std::optional<double>(const std::vector<std::size_t>&)>;
  std::vector<std::size_t> everyone(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) everyone[i] = i;
  const auto add = [&](const std::string& name, const std::string& meaning,
                       const Statistic& statistic) {
    Estimate estimate{.name = block.block + ".individual_weber_fraction_" + name,
                      .value = statistic(everyone),
                      .unit = "1",
                      .meaning = meaning,
                      .n = static_cast<int>(all.size())};
    if (estimate.value && all.size() > 1) {
      estimate.ci95 =
          resample_participants(all.size(), options.num_resamples, options.seed, statistic)
              .ci95;
    }
    section.estimates.push_back(std::move(estimate));
  };
  add("median", "median of the participants' own fractions (the published one is a mean)",
      [&](const std::vector<std::size_t>& drawn) { return quantile(drawn, 0.5); });
  add("robust_sd",
      "interquartile range / 1.349 of the participants' own fractions (the published one is a "
      "plain standard deviation, which one flat curve can make as large as it likes)",
      [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
        const auto low = quantile(drawn, 0.25);
        const auto high = quantile(drawn, 0.75);
        if (!low || !high) return std::nullopt;
        return (*high - *low) / 1.349;
      });
  int num_beyond = 0;
  for (const IndividualFraction& one : individual) num_beyond += one.beyond_stimuli ? 1 : 0;
  const Summary summary = summary_of(with_fit);
  const auto add_plain = [&](const std::string& name, std::optional<double> value, int n,
                             const std::string& meaning) {
    section.estimates.push_back({.name = block.block + ".individual_weber_fraction_" + name,
                                 .value = value,
                                 .unit = "1",
                                 .meaning = meaning,
                                 .n = n});
  };
  add_plain(
      "beyond_stimuli", num_beyond, static_cast<int>(all.size()),
      "participants whose own fraction lies beyond the largest stimulus, or is not finite");
  // One fraction beyond the stimuli, which they cannot tell from any other, makes both
  // meaningless.
  const bool all_within = num_beyond == 0 && with_fit.size() == all.size();
  add_plain("mean", all_within ? summary.mean : std::nullopt, summary.num_values,
            "plain mean, where all lie within the stimuli (biased upwards at few answers)");
  add_plain("sd", all_within ? summary.standard_deviation : std::nullopt, summary.num_values,
            "plain standard deviation, where all lie within the stimuli");
}

/// Where individual Weber fractions are compared: their spread is even there.
double log_log(double weber_fraction) { return std::log(std::log1p(weber_fraction)); }

/// Student's t with pooled variance, the test that was published.
Comparison pooled(const std::vector<double>& a, const std::vector<double>& b) {
  const Summary first = summary_of(a);
  const Summary second = summary_of(b);
  if (!first.standard_deviation || !second.standard_deviation) {
    return {.status = FitStatus::kDegenerate, .reason = "fewer than two values on one side"};
  }
  return pooled_t_test({*first.mean, *first.standard_deviation, first.num_values},
                       {*second.mean, *second.standard_deviation, second.num_values});
}

}  // namespace

ResultsSection discrimination_results(const StudyData& data, const BlockDesign& block,
                                      const ResultsOptions& options) {
  ResultsSection section{.name = block.block};
  const std::vector<Answers> all = answers_in(data, block, section.excluded);
  if (all.empty()) return section;
  std::vector<std::size_t> everyone(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) everyone[i] = i;

  const auto add_pooled = [&](const std::string& name, PsychometricMethod method,
                              const std::string& meaning) {
    const PsychometricFit pooled_curve = pooled_fit(all, everyone, method, Solver::kCeres);
    if (!pooled_curve.weber_fraction) {
      section.excluded.push_back({"everyone", block.block + "." + name +
                                                  ": no value, the pooled " + "answers are " +
                                                  pooled_curve.reason});
    }
    Estimate estimate{.name = block.block + "." + name,
                      .value = pooled_curve.weber_fraction,
                      .unit = "1",
                      .meaning = meaning,
                      .n = static_cast<int>(all.size())};
    if (estimate.value && all.size() > 1) {
      estimate.ci95 =
          resample_participants(all.size(), options.num_resamples, options.seed,
                                [&](const std::vector<std::size_t>& drawn) {
                                  const PsychometricFit fit =
                                      pooled_fit(all, drawn, method, Solver::kNewton);
                                  return std::optional(fraction_or_limit(fit, all, drawn));
                                })
              .ci95;
    }
    section.estimates.push_back(std::move(estimate));
  };
  add_pooled("weber_fraction", PsychometricMethod::kLeastSquares,
             "Weber fraction of the pooled curve, least squares on proportions");
  add_pooled("weber_fraction_ml", PsychometricMethod::kMaximumLikelihood,
             "Weber fraction of the pooled curve, maximum likelihood");

  add_individual(section, all, block, options);
  return section;
}

ResultsSection discrimination_comparison(const StudyData& data, const BlockDesign& first,
                                         const BlockDesign& second) {
  ResultsSection section{.name = first.block + "_against_" + second.block};
  const std::vector<Answers> first_answers = answers_in(data, first, section.excluded);
  const std::vector<Answers> second_answers = answers_in(data, second, section.excluded);
  for (const bool corrected : {false, true}) {
    std::vector<ExcludedParticipant> without_fit;
    const auto a =
        individual_weber_fractions(first_answers, corrected, without_fit, first.block);
    const auto b =
        individual_weber_fractions(second_answers, corrected, without_fit, second.block);
    std::vector<double> paired_a;
    std::vector<double> paired_b;
    for (const auto& [participant, fraction] : a) {
      const auto other = b.find(participant);
      if (other == b.end()) continue;
      paired_a.push_back(log_log(fraction));
      paired_b.push_back(log_log(other->second));
    }
    // Everybody with the same small correction, so that a perfect observer has a fraction too.
    const std::string who = corrected ? ", with degenerate participants (half an answer added)"
                                      : ", without degenerate participants";
    if (corrected) {
      section.excluded.insert(section.excluded.end(), without_fit.begin(), without_fit.end());
    }
    const std::string pair = first.block + " - " + second.block + ": ";
    section.comparisons.push_back(
        {pair + "ln ln(1 + w), paired" + who, paired_t_test(paired_a, paired_b)});
    section.comparisons.push_back(
        {pair + "w, unpaired, Welch" + who, welch_t_test(values_of(a), values_of(b))});
    section.comparisons.push_back({pair + "w, unpaired, pooled variance, as published" + who,
                                   pooled(values_of(a), values_of(b))});
  }
  return section;
}

}  // namespace jnd::analysis
