#include "analysis/fits/same_different_fit.h"
#include "analysis/results/discrimination_answers.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/results/threshold_group.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/wilson_interval.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

SameDifferentFit fit_of(const ThresholdAnswers& answers, bool corrected) {
  std::vector<AnswerCount> rows = answers.rows_with_catches();
  if (corrected) rows = with_half_an_answer(std::move(rows));
  return fit_same_different(rows, answers.reference);
}

/// Everybody's own Weber fractions. `mended` includes people who have one only with half an
/// answer added.
struct Fractions {
  OwnNumbers plain, mended;
};

void add_fractions(ResultsSection& section, const std::string& block, const Fractions& all) {
  const std::string meaning = said(
      "median person's w, ln(1 + w) = s of the differencing model: mean of participants' own "
      "ln ln(1 + w), Student's t");
  const std::string name = block + ".weber_fraction";
  add_median_fraction(section, block, {.name = name, .meaning = meaning}, all.plain);
  if (all.mended.empty()) return;
  OwnNumbers everybody = all.plain;
  everybody.insert(all.mended.begin(), all.mended.end());
  add_median_fraction(section, block,
                      {.name = name,
                       .meaning = meaning,
                       .suffix = ".with_degenerate",
                       .words = said("; with those who have no fraction of their own, half an "
                                     "answer of either kind added to theirs alone")},
                      everybody);
}

Fractions fractions_of(const std::vector<ThresholdAnswers>& all) {
  Fractions fractions;
  for (const ThresholdAnswers& one : all) {
    if (const SameDifferentFit fit = fit_of(one, false); fit.weber_fraction) {
      fractions.plain[one.participant] = *fit.weber_fraction;
    } else if (const SameDifferentFit mended = fit_of(one, true); mended.weber_fraction) {
      fractions.mended[one.participant] = *mended.weber_fraction;
    }
  }
  return fractions;
}

}  // namespace

ResultsSection same_different_results(const StudyData& data, const BlockDesign& block) {
  ResultsSection section{.name = block.block};
  const std::vector<ThresholdAnswers> all =
      threshold_answers(data, block, false, section.excluded);
  const auto tell = [&](const ThresholdAnswers& answers, const std::string& name,
                        const std::optional<double>& value, const Interval& ci95,
                        const std::string& reason) {
    section.participants.push_back(
        {answers.participant, block.block + "." + name, value, ci95, reason});
  };
  OwnNumbers criteria, false_alarms;
  for (const ThresholdAnswers& one : all) {
    const SameDifferentFit fit = fit_of(one, false);
    tell(one, "weber_fraction", fit.weber_fraction, fit.weber_fraction_ci95, fit.reason);
    tell(one, "criterion_ln", fit.criterion_ln, fit.criterion_ln_ci95, fit.reason);
    if (fit.criterion_ln) {
      criteria[one.participant] = *fit.criterion_ln;
    } else {
      section.excluded.push_back(
          {one.participant,
           said("{}: no Weber fraction of their own, {}", block.block, fit.reason)});
    }
    if (one.catches.num_trials == 0) continue;
    const auto [low, high] = wilson_interval(one.catches.num_yes, one.catches.num_trials);
    const double rate =
        static_cast<double>(one.catches.num_yes) / static_cast<double>(one.catches.num_trials);
    false_alarms[one.participant] = rate;
    tell(one, "false_alarm_rate", rate, {low, high}, "");
  }
  add_fractions(section, block.block, fractions_of(all));
  add_geometric_mean(section,
                     {.name = block.block + ".criterion_ln",
                      .meaning = said("criterion k: \"different\" is said where the two are "
                                      "felt further apart in ln intensity; geometric mean")},
                     criteria);
  add_mean_rate(
      section,
      {.name = block.block + ".false_alarm_rate",
       .meaning = said("\"different\" of pairs that were the same: mean over participants")},
      false_alarms);
  if (has_trials_set_aside(data, block)) {
    std::vector<ExcludedParticipant> named_before;
    add_median_fraction(section, block.block,
                        {.name = block.block + ".weber_fraction",
                         .meaning = said("median person's w by the differencing model"),
                         .suffix = ".with_excluded_trials",
                         .words = said("; with the trials that were set aside")},
                        fractions_of(threshold_answers(data, block, true, named_before)).plain);
  }
  return section;
}

}  // namespace jnd::analysis
