#include <cmath>
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
                           const std::vector<std::size_t>& drawn, PsychometricMethod method) {
  std::map<double, AnswerCount> pooled;
  for (const std::size_t index : drawn) {
    for (const auto& [intensity, count] : all[index].levels) {
      AnswerCount& sum = pooled[intensity];
      sum.intensity = intensity;
      sum.num_yes += count.num_yes;
      sum.num_trials += count.num_trials;
    }
  }
  return fit_psychometric(
      rows_of(pooled),
      {.reference = all.front().reference, .method = method, .intervals = false});
}

PsychometricFit individual_fit(const Answers& answers) {
  return fit_psychometric(rows_of(answers.levels),
                          {.reference = answers.reference, .intervals = false});
}

/// The fit with half an answer added to "yes" and to "no" at every level, which always exists
/// but for answers against the order of the stimuli. Doubled counts leave the estimate as it
/// is.
PsychometricFit corrected_fit(const Answers& answers) {
  std::vector<AnswerCount> rows = rows_of(answers.levels);
  for (AnswerCount& row : rows) {
    row.num_yes = 2 * row.num_yes + 1;
    row.num_trials = 2 * row.num_trials + 2;
  }
  return fit_psychometric(rows, {.reference = answers.reference, .intervals = false});
}

/// Individual Weber fractions; those without one are named.
std::map<std::string, double> individual_weber_fractions(
    const std::vector<Answers>& all, bool correct_degenerate,
    std::vector<ExcludedParticipant>& excluded, const std::string& block) {
  std::map<std::string, double> fractions;
  for (const Answers& answers : all) {
    PsychometricFit fit = individual_fit(answers);
    if (!fit.weber_fraction && correct_degenerate) fit = corrected_fit(answers);
    if (fit.weber_fraction) {
      fractions[answers.participant] = *fit.weber_fraction;
    } else {
      excluded.push_back({answers.participant, block + ": " + fit.reason});
    }
  }
  return fractions;
}

std::vector<double> values_of(const std::map<std::string, double>& by_participant) {
  std::vector<double> values;
  for (const auto& [participant, value] : by_participant) values.push_back(value);
  return values;
}

/// Where individual Weber fractions are compared: their spread is even there.
double log_log(double weber_fraction) { return std::log(std::log1p(weber_fraction)); }

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
    Estimate estimate{.name = block.block + "." + name,
                      .value = pooled_fit(all, everyone, method).weber_fraction,
                      .unit = "1",
                      .meaning = meaning,
                      .n = static_cast<int>(all.size())};
    if (estimate.value && all.size() > 1) {
      estimate.ci95 =
          resample_participants(all.size(), options.num_resamples, options.seed,
                                [&](const std::vector<std::size_t>& drawn) {
                                  return pooled_fit(all, drawn, method).weber_fraction;
                                })
              .ci95;
    }
    section.estimates.push_back(std::move(estimate));
  };
  add_pooled("weber_fraction", PsychometricMethod::kLeastSquares,
             "Weber fraction of the pooled curve, least squares on proportions");
  add_pooled("weber_fraction_ml", PsychometricMethod::kMaximumLikelihood,
             "Weber fraction of the pooled curve, maximum likelihood");

  const std::vector<double> individual =
      values_of(individual_weber_fractions(all, false, section.excluded, block.block));
  const Summary summary = summary_of(individual);
  const auto add_individual = [&](const std::string& name, std::optional<double> value,
                                  Interval ci95, const std::string& meaning) {
    section.estimates.push_back({.name = block.block + ".individual_weber_fraction_" + name,
                                 .value = value,
                                 .ci95 = ci95,
                                 .unit = "1",
                                 .meaning = meaning,
                                 .n = summary.num_values});
  };
  add_individual("median", summary.median, {}, "median of the participants' own fractions");
  add_individual("mean", summary.mean, summary.mean_ci95,
                 "mean of the participants' own fractions (biased upwards at few answers)");
  add_individual("sd", summary.standard_deviation, {},
                 "standard deviation of the participants' own fractions");
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
    if (!corrected) {
      section.excluded.insert(section.excluded.end(), without_fit.begin(), without_fit.end());
    }
    std::vector<double> paired_a;
    std::vector<double> paired_b;
    for (const auto& [participant, fraction] : a) {
      const auto other = b.find(participant);
      if (other == b.end()) continue;
      paired_a.push_back(log_log(fraction));
      paired_b.push_back(log_log(other->second));
    }
    const std::string who =
        corrected ? ", degenerate participants corrected by half an answer" : "";
    const std::string pair = first.block + " - " + second.block + ": ";
    section.comparisons.push_back(
        {pair + "ln ln(1 + w), paired" + who, paired_t_test(paired_a, paired_b)});
    section.comparisons.push_back(
        {pair + "w, unpaired" + who, welch_t_test(values_of(a), values_of(b))});
  }
  return section;
}

}  // namespace jnd::analysis
