#include <cmath>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/results/number_words.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/results/threshold_group.h"
#include "analysis/results/threshold_results.h"
#include "analysis/words/said.h"
#include "experiments/procedures/task.h"

namespace jnd::analysis {
namespace {

PsychometricFit fit_of(const ThresholdAnswers& answers, double guess_rate) {
  std::vector<AnswerCount> rows;
  for (AnswerCount row : answers.rows()) {
    row.intensity = std::abs(std::log(row.intensity / answers.reference));
    rows.push_back(row);
  }
  // The reference only scales the search. The curve may lie anywhere.
  return fit_psychometric(
      rows, {.reference = rows.back().intensity, .free_pse = true, .guess_rate = guess_rate});
}

std::optional<double> as_fraction(const std::optional<double>& distance_ln) {
  return distance_ln ? std::optional(std::expm1(*distance_ln)) : std::nullopt;
}

/// Writes the section of one block.
class IdentificationWriter {
 public:
  explicit IdentificationWriter(const BlockDesign& block)
      : block_(block),
        num_choices_(experiments::num_choices_to_guess(task_of(block.written))),
        section_{.name = block.block} {}

  [[nodiscard]] std::vector<ExcludedParticipant>& excluded() { return section_.excluded; }

  void add(const ThresholdAnswers& answers) {
    const PsychometricFit fit = fit_of(answers, guess_rate());
    const Interval ci95 = fit.pse_ci95.value_or(Interval{});
    const std::optional<double> fraction = as_fraction(fit.pse);
    tell(answers.participant, "weber_fraction", fraction,
         {as_fraction(ci95.low), as_fraction(ci95.high)}, fit.reason);
    const std::optional<double> spread =
        fit.weber_fraction ? std::optional(std::log1p(*fit.weber_fraction)) : std::nullopt;
    tell(answers.participant, "spread_ln", spread, {}, fit.reason);
    if (fraction) {
      fractions_[answers.participant] = *fraction;
      if (spread) spreads_[answers.participant] = *spread;
    } else {
      section_.excluded.push_back(
          {answers.participant,
           said("{}: no Weber fraction of their own, {}", block_.block, fit.reason)});
    }
    std::int64_t num_right = 0, num_trials = 0;
    for (const AnswerCount& row : answers.rows()) {
      num_right += row.num_yes;
      num_trials += row.num_trials;
    }
    const double ratio = static_cast<double>(num_right) / static_cast<double>(num_trials);
    tell(answers.participant, "right_ratio", ratio, {}, "");
    right_[answers.participant] = ratio;
  }

  /// Adds how often each interval was chosen, right or wrong.
  void add_choices(const ParticipantData& participant) {
    std::map<std::int64_t, double> counts;
    double all = 0.0;
    for (const auto* const list : {&participant.trials, &participant.catch_trials}) {
      for (const core::TrialRow& trial : *list) {
        if (trial.block != block_.block || !trial.measures.chosen_interval) continue;
        ++counts[*trial.measures.chosen_interval];
        ++all;
      }
    }
    if (all == 0.0) return;
    const int first = form_of(task_of(block_.written)).first_choice;
    for (int interval = first; interval < first + num_choices_; ++interval) {
      choices_[interval][participant.participant] = counts[interval] / all;
    }
  }

  [[nodiscard]] ResultsSection finish() && {
    const std::string guess = "1/" + std::to_string(num_choices_);
    const std::string half_way = number_words(50.0 * (1.0 + guess_rate()), 1) + " %";
    add_median_fraction(
        section_, block_.block,
        {.name = block_.block + ".weber_fraction",
         .meaning = said("w so that of the interval of reference (1 + w) {} of the answers are "
                         "right, half way from {}, by guessing, to 1; no d' model: mean of "
                         "participants' own ln ln(1 + w), Student's t",
                         half_way, guess)},
        fractions_);
    add_geometric_mean(section_,
                       {.name = block_.block + ".spread_ln",
                        .meaning = said("s of P(right) = {} + (1 - {}) Phi(ln(d / ln(1 + w)) / "
                                        "s), d = |ln(x / reference)|: geometric mean",
                                        guess, guess)},
                       spreads_);
    add_mean_rate(section_,
                  {.name = block_.block + ".right_ratio",
                   .meaning = said("share of right answers, all stimuli together, {} by "
                                   "guessing: mean over participants",
                                   guess)},
                  right_);
    std::vector<double> above_guess;
    for (const auto& [participant, ratio] : right_) above_guess.push_back(ratio - guess_rate());
    section_.comparisons.push_back({.name = said("{}: right answers - {}", block_.block, guess),
                                    .comparison = one_sample_t_test(above_guess)});
    constexpr const char* kNames[] = {"first", "second", "third"};
    for (const auto& [interval, own] : choices_) {
      add_mean_rate(section_,
                    {.name = block_.block + ".chosen_" + kNames[interval - 1] + "_ratio",
                     .meaning = said("share of answers that name the {} interval, which is "
                                     "right as often as any other: mean over participants",
                                     kNames[interval - 1])},
                    own);
    }
    return std::move(section_);
  }

 private:
  [[nodiscard]] double guess_rate() const { return 1.0 / num_choices_; }
  void tell(const std::string& participant, const std::string& name,
            const std::optional<double>& value, const Interval& ci95,
            const std::string& reason) {
    section_.participants.push_back(
        {participant, block_.block + "." + name, value, ci95, value ? "" : reason});
  }

  const BlockDesign& block_;
  int num_choices_;
  ResultsSection section_;
  OwnNumbers fractions_, spreads_, right_;
  std::map<int, OwnNumbers> choices_;
};

}  // namespace

ResultsSection identification_results(const StudyData& data, const BlockDesign& block) {
  IdentificationWriter writer(block);
  const std::vector<ThresholdAnswers> all =
      threshold_answers(data, block, false, writer.excluded());
  if (all.empty()) return ResultsSection{.name = block.block, .excluded = writer.excluded()};
  for (const ThresholdAnswers& one : all) writer.add(one);
  for (const ParticipantData& participant : data.participants) writer.add_choices(participant);
  return std::move(writer).finish();
}

}  // namespace jnd::analysis
