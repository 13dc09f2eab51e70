#include <cmath>

#include "analysis/fits/detection_fit.h"
#include "analysis/results/threshold_answers.h"
#include "analysis/results/threshold_group.h"
#include "analysis/results/threshold_results.h"
#include "analysis/statistics/wilson_interval.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

constexpr int kRedraws = 1000;
constexpr const char* kModel = said_later(
    "P = g + (1 - g) Phi(ln(x / threshold) / s), g the rate of false alarms, estimated with "
    "it");

/// Everybody's own numbers in one block, and the participants who have none.
class Detection {
 public:
  Detection(const BlockDesign& block, const ResultsOptions& options)
      : block_(block), options_(options) {}

  /// Adds one participant's values to the section.
  void add(ResultsSection& section, const ThresholdAnswers& answers) {
    const PsychometricFit fit = own_detection_fit(answers, false, kRedraws, options_.seed);
    tell(section, answers, "threshold", fit.pse, fit.pse_ci95.value_or(Interval{}), fit.reason);
    tell(section, answers, "spread_ln", in_ln(fit.weber_fraction),
         {in_ln(fit.weber_fraction_ci95.low), in_ln(fit.weber_fraction_ci95.high)}, fit.reason);
    if (fit.goodness.p_value) {
      tell(section, answers, "goodness_p", fit.goodness.p_value, {}, "");
    }
    if (fit.pse) {
      thresholds_[answers.participant] = *fit.pse;
      spreads_[answers.participant] = *in_ln(fit.weber_fraction);
    } else {
      leave_out(section, answers, fit.reason);
    }
    if (answers.catches.num_trials > 0) add_catches(section, answers);
  }

  void add_group(ResultsSection& section) const {
    const std::string unit = experiments::unit_of_quantity(block_.quantity);
    const auto name = [&](const std::string& what) { return block_.block + "." + what; };
    add_geometric_mean(
        section,
        {.name = name("threshold"),
         .meaning = said("intensity felt in 50 %: geometric mean of participants' own, by "
                         "maximum likelihood of Phi(ln(x / threshold) / s)"),
         .unit = unit},
        thresholds_);
    if (!mended_.empty()) {
      OwnNumbers all = thresholds_;
      all.insert(mended_.begin(), mended_.end());
      add_geometric_mean(
          section,
          {.name = name("threshold"),
           .meaning = said("intensity felt in 50 %: geometric mean"),
           .unit = unit,
           .suffix = ".with_degenerate",
           .words = said("; with those who have no threshold of their own, half a yes and half "
                         "a no added to theirs alone, spread evenly over the levels")},
          all);
    }
    add_geometric_mean(
        section,
        {.name = name("spread_ln"),
         .meaning = said("s, standard deviation of the curve in ln intensity: geometric mean")},
        spreads_);
    add_geometric_mean(
        section,
        {.name = name("threshold_corrected"),
         .meaning =
             said("threshold corrected for false alarms: geometric mean; {}", said(kModel)),
         .unit = unit},
        corrected_);
    add_mean_rate(section,
                  {.name = name("false_alarm_rate"),
                   .meaning = said("\"yes\" to catch trials: mean over participants")},
                  false_alarms_);
    add_mean(section,
             {.name = name("d_prime"),
              .meaning = said("d' = z(H) - z(F), all stimuli of the block against catch "
                              "trials, log-linear correction: mean over participants")},
             sensitivities_);
    add_mean(section,
             {.name = name("criterion"),
              .meaning = said("c = -(z(H) + z(F)) / 2, above 0 reluctant to say \"yes\": mean "
                              "over participants")},
             criteria_);
  }

 private:
  static std::optional<double> in_ln(const std::optional<double>& fraction) {
    return fraction ? std::optional(std::log1p(*fraction)) : std::nullopt;
  }

  void tell(ResultsSection& section, const ThresholdAnswers& answers, const std::string& name,
            const std::optional<double>& value, const Interval& ci95,
            const std::string& reason) const {
    section.participants.push_back(
        {answers.participant, block_.block + "." + name, value, ci95, reason});
  }

  void leave_out(ResultsSection& section, const ThresholdAnswers& answers,
                 const std::string& reason) {
    const PsychometricFit mended = own_detection_fit(answers, true, 0, options_.seed);
    if (mended.pse) mended_[answers.participant] = *mended.pse;
    section.excluded.push_back(
        {answers.participant,
         said("{}: no threshold of their own, {}{}", block_.block, reason,
              (mended.pse ? "" : said("; nor with half an answer added")))});
  }

  void add_catches(ResultsSection& section, const ThresholdAnswers& answers) {
    const std::string& who = answers.participant;
    const DetectionFit fit = fit_detection(answers.rows_with_catches());
    tell(section, answers, "threshold_corrected", fit.threshold, fit.threshold_ci95,
         fit.reason);
    if (fit.threshold) corrected_[who] = *fit.threshold;
    const auto [low, high] =
        wilson_interval(answers.catches.num_yes, answers.catches.num_trials);
    false_alarms_[who] = static_cast<double>(answers.catches.num_yes) /
                         static_cast<double>(answers.catches.num_trials);
    tell(section, answers, "false_alarm_rate", false_alarms_[who], {low, high}, "");
    if (const std::optional<SignalDetection> found = answers.signal_detection()) {
      sensitivities_[who] = found->d_prime;
      criteria_[who] = found->criterion;
      tell(section, answers, "d_prime", found->d_prime, {}, "");
      tell(section, answers, "criterion", found->criterion, {}, "");
    }
  }

  const BlockDesign& block_;
  const ResultsOptions& options_;
  OwnNumbers thresholds_, mended_, spreads_, corrected_;
  OwnNumbers false_alarms_, sensitivities_, criteria_;
};

/// Adds the main estimate again, with the trials that were set aside.
void add_with_excluded_trials(ResultsSection& section, const StudyData& data,
                              const BlockDesign& block, const ResultsOptions& options) {
  std::vector<ExcludedParticipant> named_before;
  OwnNumbers thresholds;
  for (const ThresholdAnswers& one : threshold_answers(data, block, true, named_before)) {
    const PsychometricFit fit = own_detection_fit(one, false, 0, options.seed);
    if (fit.pse) thresholds[one.participant] = *fit.pse;
  }
  add_geometric_mean(section,
                     {.name = block.block + ".threshold",
                      .meaning = said("intensity felt in 50 %: geometric mean"),
                      .unit = experiments::unit_of_quantity(block.quantity),
                      .suffix = ".with_excluded_trials",
                      .words = said("; with the trials that were set aside")},
                     thresholds);
}

}  // namespace

ResultsSection detection_results(const StudyData& data, const BlockDesign& block,
                                 const ResultsOptions& options) {
  ResultsSection section{.name = block.block};
  Detection detection(block, options);
  for (const ThresholdAnswers& one : threshold_answers(data, block, false, section.excluded)) {
    detection.add(section, one);
  }
  detection.add_group(section);
  if (has_trials_set_aside(data, block)) {
    add_with_excluded_trials(section, data, block, options);
  }
  return section;
}

}  // namespace jnd::analysis
