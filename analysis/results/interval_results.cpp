#include <algorithm>
#include <array>
#include <tuple>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/results/discrimination_answers.h"
#include "analysis/results/threshold_group.h"
#include "analysis/results/threshold_results.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

constexpr const char* kOneIntervalAlone = said_later("the test came in one interval alone");

struct OrderedTrial {
  double ratio = 0.0;  ///< Test divided by reference.
  double order = 0.0;
  bool more = false;  ///< Whether the test was chosen.
};

std::vector<OrderedTrial> ordered_trials(const ParticipantData& participant,
                                         const std::string& block) {
  std::vector<OrderedTrial> trials;
  for (const core::TrialRow& trial : participant.trials_in(block)) {
    if (!trial.test_interval || !trial.intensity || !trial.reference_intensity) continue;
    if (!trial.response || !(*trial.intensity > 0.0)) continue;
    trials.push_back({*trial.intensity / *trial.reference_intensity,
                      order_of(trial.test_interval), *trial.response > 0.5});
  }
  return trials;
}

/// How much more often than in half of the trials the second interval is chosen, with both
/// orders weighted equally.
std::optional<double> bias_of(const std::vector<OrderedTrial>& trials) {
  std::array<double, 2> num_second_chosen{};
  std::array<double, 2> num_trials{};
  for (const OrderedTrial& trial : trials) {
    const bool test_is_second = trial.order == kTestSecond;
    num_second_chosen[test_is_second] += trial.more == test_is_second ? 1.0 : 0.0;
    ++num_trials[test_is_second];
  }
  if (num_trials[0] == 0.0 || num_trials[1] == 0.0) return std::nullopt;
  return 0.5 * (num_second_chosen[0] / num_trials[0] + num_second_chosen[1] / num_trials[1]) -
         0.5;
}

/// The fit whose order effect says how far apart the pses of both orders lie, with a free pse.
PsychometricFit fit_of(const std::vector<OrderedTrial>& trials) {
  std::vector<AnswerCount> rows;
  for (const OrderedTrial& trial : trials) {
    rows.push_back({.intensity = trial.ratio,
                    .num_yes = trial.more ? 1 : 0,
                    .num_trials = 1,
                    .order = trial.order});
  }
  return fit_psychometric(rows, {.reference = 1.0,
                                 .free_pse = true,
                                 .by_order = true,
                                 .intervals = false,
                                 .solver = Solver::kNewton});
}

}  // namespace

bool has_intervals(const StudyData& data, const BlockDesign& block) {
  return std::ranges::any_of(data.participants, [&](const ParticipantData& one) {
    return !ordered_trials(one, block.block).empty();
  });
}

ResultsSection interval_results(const StudyData& data, const BlockDesign& block) {
  ResultsSection section{.name = block.block + "_intervals"};
  OwnNumbers biases, effects;
  for (const ParticipantData& participant : data.participants) {
    const std::vector<OrderedTrial> trials = ordered_trials(participant, block.block);
    if (trials.empty()) continue;
    const std::optional<double> bias = bias_of(trials);
    const PsychometricFit fit = fit_of(trials);
    const auto tell = [&](const std::string& name, const std::optional<double>& value,
                          const std::string& reason) {
      section.participants.push_back(
          {participant.participant, block.block + "." + name, value, {}, reason});
    };
    tell("interval_bias", bias, bias ? "" : said(kOneIntervalAlone));
    tell("order_effect_ln", fit.order_effect_ln,
         fit.status == FitStatus::kOk && !bias ? said(kOneIntervalAlone) : why_no_pse(fit));
    if (bias) biases[participant.participant] = *bias;
    if (fit.order_effect_ln) effects[participant.participant] = *fit.order_effect_ln;
  }
  add_mean(section,
           {.name = block.block + ".interval_bias",
            .meaning = said("share of answers that choose the second interval, both orders "
                            "weighed equally, less one half: mean over participants")},
           biases);
  add_mean(section,
           {.name = block.block + ".order_effect_ln",
            .meaning = said("ln pse with the test second less ln pse with the test first, one "
                            "slope for both: mean over participants")},
           effects);
  for (const auto& [name, own, ratio_of] :
       {std::tuple{said("second interval chosen - half of the answers"), biases, ""},
        std::tuple{said("ln pse, test second - test first"), effects, "pse"}}) {
    std::vector<double> values;
    for (const auto& [participant, value] : own) values.push_back(value);
    section.comparisons.push_back({.name = block.block + ": " + name,
                                   .comparison = one_sample_t_test(values),
                                   .ratio_of = ratio_of});
  }
  return section;
}

}  // namespace jnd::analysis
