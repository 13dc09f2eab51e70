#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/fits/probit_regression.h"
#include "analysis/threshold_group.h"
#include "analysis/threshold_results.h"

namespace jnd::analysis {
namespace {

struct OrderedTrial {
  double log_ratio = 0.0;  ///< ln(test / reference)
  bool test_is_second = false;
  bool more = false;  ///< The test was chosen.
};

std::vector<OrderedTrial> ordered_trials(const ParticipantData& participant,
                                         const std::string& block) {
  std::vector<OrderedTrial> trials;
  for (const core::TrialRow& trial : participant.trials_in(block)) {
    if (!trial.test_interval || !trial.intensity || !trial.reference_intensity) continue;
    if (!trial.response || !(*trial.intensity > 0.0)) continue;
    trials.push_back({std::log(*trial.intensity / *trial.reference_intensity),
                      *trial.test_interval == 2, *trial.response > 0.5});
  }
  return trials;
}

/// How much more often than in half of the trials the second interval is chosen, both orders
/// weighed equally.
std::optional<double> bias_of(const std::vector<OrderedTrial>& trials) {
  std::array<double, 2> num_second_chosen{};
  std::array<double, 2> num_trials{};
  for (const OrderedTrial& trial : trials) {
    const std::size_t order = trial.test_is_second ? 1 : 0;
    num_second_chosen[order] += trial.more == trial.test_is_second ? 1.0 : 0.0;
    ++num_trials[order];
  }
  if (num_trials[0] == 0.0 || num_trials[1] == 0.0) return std::nullopt;
  return 0.5 * (num_second_chosen[0] / num_trials[0] + num_second_chosen[1] / num_trials[1]) -
         0.5;
}

struct OrderEffect {
  std::optional<double> value;  ///< ln pse, test second, less ln pse, test first.
  std::string reason;
};

/// P(test chosen) = Phi(b0 ln(x / reference) + b1 + b2 o), o = 1/2 where the test is second and
/// -1/2 where it is first: the pses of both orders lie -b2 / b0 apart.
OrderEffect order_effect_of(const std::vector<OrderedTrial>& trials) {
  const auto rows = static_cast<Eigen::Index>(trials.size());
  Eigen::MatrixXd design(rows, 3);
  Eigen::VectorXd yes(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const OrderedTrial& trial = trials[static_cast<std::size_t>(row)];
    design.row(row) << trial.log_ratio, 1.0, trial.test_is_second ? 0.5 : -0.5;
    yes(row) = trial.more ? 1.0 : 0.0;
  }
  const ProbitRegression fit = fit_probit(design, yes, Eigen::VectorXd::Ones(rows));
  if (fit.status != FitStatus::kOk) return {.reason = fit.reason};
  if (!(fit.coefficients(0) > 0.0)) {
    return {.reason = "the test is not chosen more often as it grows"};
  }
  return {.value = -fit.coefficients(2) / fit.coefficients(0)};
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
    const OrderEffect effect = order_effect_of(trials);
    const auto tell = [&](const std::string& name, const std::optional<double>& value,
                          const std::string& reason) {
      section.participants.push_back(
          {participant.participant, block.block + "." + name, value, {}, reason});
    };
    tell("interval_bias", bias, bias ? "" : "the test came in one interval alone");
    tell("order_effect_ln", effect.value, effect.reason);
    if (bias) biases[participant.participant] = *bias;
    if (effect.value) effects[participant.participant] = *effect.value;
  }
  add_mean(section,
           {.name = block.block + ".interval_bias",
            .meaning = "share of answers that choose the second interval, both orders weighed "
                       "equally, less one half: mean over participants"},
           biases);
  add_mean(section,
           {.name = block.block + ".order_effect_ln",
            .meaning = "ln pse with the test second less ln pse with the test first, one slope "
                       "for both: mean over participants"},
           effects);
  for (const auto& [name, own] :
       {std::pair{"second interval chosen - half of the answers", biases},
        std::pair{"ln pse, test second - test first", effects}}) {
    std::vector<double> values;
    for (const auto& [participant, value] : own) values.push_back(value);
    section.comparisons.push_back(
        {.name = block.block + ": " + name, .comparison = one_sample_t_test(values)});
  }
  return section;
}

}  // namespace jnd::analysis
