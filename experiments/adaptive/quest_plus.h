#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/random_stream.h"
#include "experiments/adaptive/level_answer.h"
#include "experiments/adaptive/quest_plus_estimate.h"
#include "experiments/adaptive/quest_plus_model.h"

namespace jnd::experiments {

/// Ends a run once a parameter is known precisely enough.
struct MarginalStop {
  std::string parameter;  ///< Name of a parameter of the model.
  double sd = 0.0;        ///< Standard deviation of the marginal, > 0, in ln for ratios.
};

struct QuestPlusRule {
  QuestPlusModel model;
  std::vector<double> intensities;  ///< One or more, ascending, >= 0.
  /// The next intensity is drawn among this many of the best ones, >= 1. More of them make the
  /// next one harder to guess, but each trial tells a little less.
  int num_best = 1;
  int max_trials = 0;  ///< >= 1.
  /// >= 0; neither of the following rules ends a run earlier.
  int min_trials = 0;
  /// >= 0; the run ends at this entropy of the posterior.
  std::optional<double> entropy_bits;
  std::optional<MarginalStop> marginal;  ///< The run ends at this standard deviation.
};

/// Probability of each combination of parameters after some answers. The last parameter runs
/// fastest. It contains the answers, so that it can be brought up to date.
struct QuestPlusPosterior {
  std::vector<LevelAnswer> answers;
  Eigen::VectorXd probability;  ///< Sums to 1.
};

enum class QuestPlusEnd { kNotFinished, kTrials, kEntropy, kMarginal };

/// QUEST+ (Watson 2017, J. Vision 17(3):10). The next stimulus is the one whose answer is
/// expected to leave the least uncertainty about the parameters, by Bayes' rule on a grid. The
/// object holds tables that depend on the rule alone; everything else is a function of the
/// answers. Not real time.
///
/// With p the posterior, L the probability of "yes" and h(q) = -q log2 q - (1-q) log2 (1-q),
///
///   entropy expected after the answer = entropy - ( h(sum p L) - sum p h(L) ),
///
/// and the bracket is the information expected from the answer. It takes two products of a
/// matrix and a vector, and one pair of logarithms for each stimulus.
class QuestPlus {
 public:
  /// Throws `Error` naming the field of the rule that is wrong.
  explicit QuestPlus(QuestPlusRule rule);

  [[nodiscard]] const QuestPlusRule& rule() const noexcept { return rule_; }
  /// Returns the values of the parameters at an index of the posterior.
  [[nodiscard]] std::vector<double> values_at(Eigen::Index combination) const;

  [[nodiscard]] const QuestPlusPosterior& prior() const noexcept { return prior_; }
  /// Computes the posterior from the prior. Throws `Error` if the answers are impossible for
  /// all parameters, or if an intensity is no number >= 0. Intensities need not be those of the
  /// rule.
  [[nodiscard]] QuestPlusPosterior posterior(const std::vector<LevelAnswer>& answers) const;
  /// Computes exactly the same, but processes only the new answers. It starts from the prior if
  /// `posterior` contains an answer that was taken back. If it throws, `posterior` is still
  /// that of the answers that it contains.
  void bring_up_to_date(QuestPlusPosterior& posterior,
                        const std::vector<LevelAnswer>& answers) const;

  /// Returns a value for each intensity, >= 0 apart from rounding.
  [[nodiscard]] Eigen::VectorXd expected_information_bits(
      const QuestPlusPosterior& posterior) const;
  /// Returns the intensity with the most expected information, or one drawn among the best. If
  /// two are equal to 1e-10 bits, the lower one counts as better. Draws from the stream if
  /// `num_best` is above 1.
  [[nodiscard]] double next_intensity(const QuestPlusPosterior& posterior,
                                      core::RandomStream& stream) const;
  [[nodiscard]] double entropy_bits(const QuestPlusPosterior& posterior) const;
  [[nodiscard]] QuestPlusEnd end(const QuestPlusPosterior& posterior) const;
  /// Returns one estimate for each parameter. `confidence` is in (0, 1).
  [[nodiscard]] std::vector<QuestPlusEstimate> estimates(const QuestPlusPosterior& posterior,
                                                         double confidence = 0.95) const;

 private:
  [[nodiscard]] Eigen::VectorXd likelihood(const LevelAnswer& answer) const;
  [[nodiscard]] std::vector<double> marginal(const QuestPlusPosterior& posterior,
                                             std::size_t parameter) const;

  QuestPlusRule rule_;
  QuestPlusPosterior prior_;
  // One column for each intensity, one row for each combination.
  std::array<Eigen::MatrixXd, 2> likelihood_;  // For "no" and for "yes".
  Eigen::MatrixXd entropy_;                    // h(L), in bits.
};

}  // namespace jnd::experiments
