#include "experiments/adaptive/quest_plus.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/require.h"
#include "experiments/adaptive/level_scale.h"
#include "experiments/adaptive/quest_plus_estimate.h"

namespace jnd::experiments {
namespace {

using core::require;

/// Two amounts of information closer than this count as equal. Rounding errors are a thousand
/// times smaller.
constexpr double kAlikeBits = 1e-10;

/// Returns -p log2 p, which is 0 at 0.
double surprise_bits(double p) noexcept { return p > 0.0 ? -p * std::log2(p) : 0.0; }

void require_rule(const QuestPlusRule& rule) {
  require_model(rule.model);
  const auto num_intensities = static_cast<double>(rule.intensities.size());
  require(num_intensities >= 1, "quest_plus.intensities", "one or more", num_intensities);
  require_ascending(LevelScale::kLinear, "quest_plus.intensities", rule.intensities);
  require(rule.intensities.front() >= 0.0, "quest_plus.intensities", "intensities >= 0",
          rule.intensities.front());
  require(rule.num_best >= 1 && rule.num_best <= num_intensities, "quest_plus.num_best",
          "1 or more, and no more than there are intensities", rule.num_best);
  require(rule.max_trials >= 1, "quest_plus.max_trials", "1 or more", rule.max_trials);
  require(rule.min_trials >= 0, "quest_plus.min_trials", "0 or more", rule.min_trials);
  const double entropy_bits = rule.entropy_bits.value_or(0.0);
  require(entropy_bits >= 0.0, "quest_plus.entropy_bits", "0 or more", entropy_bits);
  if (!rule.marginal) return;
  require(rule.marginal->sd > 0.0, "quest_plus.marginal.sd", "a number > 0", rule.marginal->sd);
  const auto& parameters = rule.model.parameters;
  if (std::none_of(parameters.begin(), parameters.end(), [&](const auto& parameter) {
        return parameter.name == rule.marginal->parameter;
      })) {
    throw core::Error("quest_plus.marginal.parameter: expected one of the model, found `" +
                      rule.marginal->parameter + "`");
  }
}

}  // namespace

QuestPlus::QuestPlus(QuestPlusRule rule) : rule_(std::move(rule)) {
  require_rule(rule_);
  prior_.probability = prior_of(rule_.model);
  const auto num_intensities = static_cast<Eigen::Index>(rule_.intensities.size());
  for (Eigen::MatrixXd& table : likelihood_) {
    table.resize(prior_.probability.size(), num_intensities);
  }
  for (Eigen::Index row = 0; row < prior_.probability.size(); ++row) {
    const std::vector<double> values = values_at(row);
    for (Eigen::Index i = 0; i < num_intensities; ++i) {
      for (const bool yes : {false, true}) {
        likelihood_[yes](row, i) = rule_.model.probability(yes, rule_.intensities[i], values);
      }
      const double no = likelihood_[false](row, i), yes = likelihood_[true](row, i);
      require(no >= 0.0 && yes >= 0.0 && std::abs(no + yes - 1.0) < 1e-9, "quest_plus.model",
              "two probabilities that sum to 1", yes);
    }
  }
  entropy_ = likelihood_[false].unaryExpr(&surprise_bits) +
             likelihood_[true].unaryExpr(&surprise_bits);
}

std::vector<double> QuestPlus::values_at(Eigen::Index combination) const {
  const auto& parameters = rule_.model.parameters;
  std::vector<double> values(parameters.size());
  for (std::size_t i = parameters.size(); i-- > 0;) {
    const auto& grid = parameters[i].grid.values;
    values[i] = grid[combination % grid.size()];
    combination /= static_cast<Eigen::Index>(grid.size());
  }
  return values;
}

Eigen::VectorXd QuestPlus::likelihood(const LevelAnswer& answer) const {
  const auto& intensities = rule_.intensities;
  const auto found = std::lower_bound(intensities.begin(), intensities.end(), answer.level);
  if (found != intensities.end() && *found == answer.level) {
    return likelihood_[answer.yes].col(found - intensities.begin());
  }
  require(answer.level >= 0.0 && std::isfinite(answer.level), "quest_plus.answers",
          "an intensity >= 0", answer.level);
  Eigen::VectorXd column(prior_.probability.size());
  for (Eigen::Index row = 0; row < column.size(); ++row) {
    column[row] = rule_.model.probability(answer.yes, answer.level, values_at(row));
  }
  return column;
}

QuestPlusPosterior QuestPlus::posterior(const std::vector<LevelAnswer>& answers) const {
  QuestPlusPosterior posterior = prior_;
  bring_up_to_date(posterior, answers);
  return posterior;
}

void QuestPlus::bring_up_to_date(QuestPlusPosterior& posterior,
                                 const std::vector<LevelAnswer>& answers) const {
  const auto& known = posterior.answers;
  if (known.size() > answers.size() ||
      !std::equal(known.begin(), known.end(), answers.begin())) {
    posterior = prior_;
  }
  for (std::size_t i = posterior.answers.size(); i < answers.size(); ++i) {
    const Eigen::VectorXd joint = posterior.probability.cwiseProduct(likelihood(answers[i]));
    const double evidence = joint.sum();
    require(evidence > 0.0, "quest_plus.answers",
            "answers that are possible with some parameters (widen the grids, or allow lapses)",
            evidence);
    posterior.probability = joint / evidence;
    posterior.answers.push_back(answers[i]);
  }
}

Eigen::VectorXd QuestPlus::expected_information_bits(
    const QuestPlusPosterior& posterior) const {
  const Eigen::VectorXd yes = likelihood_[true].transpose() * posterior.probability;
  Eigen::VectorXd information = -(entropy_.transpose() * posterior.probability);
  for (Eigen::Index i = 0; i < yes.size(); ++i) {
    information[i] += surprise_bits(yes[i]) + surprise_bits(1.0 - yes[i]);
  }
  return information;
}

double QuestPlus::next_intensity(const QuestPlusPosterior& posterior,
                                 core::RandomStream& stream) const {
  const Eigen::VectorXd information = expected_information_bits(posterior);
  std::vector<Eigen::Index> left(rule_.intensities.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<Eigen::Index>(i);
  std::uint64_t rank = rule_.num_best > 1 ? stream.below(rule_.num_best) : 0;
  while (true) {
    double most = -1.0;
    for (const Eigen::Index i : left) most = std::max(most, information[i]);
    const auto best = std::find_if(left.begin(), left.end(), [&](Eigen::Index i) {
      return information[i] >= most - kAlikeBits;
    });
    if (rank-- == 0) return rule_.intensities[*best];
    left.erase(best);
  }
}

double QuestPlus::entropy_bits(const QuestPlusPosterior& posterior) const {
  return posterior.probability.unaryExpr(&surprise_bits).sum();
}

QuestPlusEnd QuestPlus::end(const QuestPlusPosterior& posterior) const {
  const auto num_trials = static_cast<int>(posterior.answers.size());
  if (num_trials >= rule_.max_trials) return QuestPlusEnd::kTrials;
  if (num_trials < rule_.min_trials) return QuestPlusEnd::kNotFinished;
  if (rule_.entropy_bits && entropy_bits(posterior) <= *rule_.entropy_bits) {
    return QuestPlusEnd::kEntropy;
  }
  if (rule_.marginal) {
    for (const QuestPlusEstimate& estimate : estimates(posterior)) {
      if (estimate.name == rule_.marginal->parameter && estimate.sd <= rule_.marginal->sd) {
        return QuestPlusEnd::kMarginal;
      }
    }
  }
  return QuestPlusEnd::kNotFinished;
}

std::vector<double> QuestPlus::marginal(const QuestPlusPosterior& posterior,
                                        std::size_t parameter) const {
  const auto& parameters = rule_.model.parameters;
  std::size_t stride = 1;
  for (std::size_t i = parameter + 1; i < parameters.size(); ++i) {
    stride *= parameters[i].grid.values.size();
  }
  std::vector<double> weights(parameters[parameter].grid.values.size(), 0.0);
  for (Eigen::Index i = 0; i < posterior.probability.size(); ++i) {
    weights[i / stride % weights.size()] += posterior.probability[i];
  }
  return weights;
}

std::vector<QuestPlusEstimate> QuestPlus::estimates(const QuestPlusPosterior& posterior,
                                                    double confidence) const {
  require(confidence > 0.0 && confidence < 1.0, "quest_plus.confidence",
          "a probability in (0, 1)", confidence);
  std::vector<QuestPlusEstimate> found;
  for (std::size_t i = 0; i < rule_.model.parameters.size(); ++i) {
    found.push_back(estimate_of(rule_.model.parameters[i], marginal(posterior, i), confidence));
  }
  return found;
}

}  // namespace jnd::experiments
