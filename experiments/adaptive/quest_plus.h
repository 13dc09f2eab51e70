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

/// Ends a run once a parameter is known well enough.
struct MarginalStop {
  std::string parameter;  ///< One of the model.
  double sd = 0.0;        ///< > 0; of the marginal, in ln for ratios.
};

struct QuestPlusRule {
  QuestPlusModel model;
  std::vector<double> intensities;  ///< Ascending, one or more, >= 0.
  /// The next intensity is drawn among so many of the best, >= 1: a little less is learned, and
  /// less can be guessed.
  int num_best = 1;
  int max_trials = 0;                    ///< >= 1.
  int min_trials = 0;                    ///< >= 0; before, neither of the following ends it.
  std::optional<double> entropy_bits;    ///< >= 0; ends at this entropy of the posterior.
  std::optional<MarginalStop> marginal;  ///< Ends at this standard deviation.
};

/// Probability of each combination of parameters after some answers; the last parameter runs
/// fastest. It says of which answers, so that it can be brought up to date.
struct QuestPlusPosterior {
  std::vector<LevelAnswer> answers;
  Eigen::VectorXd probability;  ///< Sums to 1.
};

enum class QuestPlusEnd { kNotFinished, kTrials, kEntropy, kMarginal };

/// QUEST+ (Watson 2017, J. Vision 17(3):10): the next stimulus is the one after whose answer
/// the parameters are expected to be known best, by Bayes' rule on a grid. Holds tables that
/// depend on the rule alone; everything else is a function of the answers. Not real time.
///
/// With p the posterior, L the probability of "yes" and h(q) = -q log2 q - (1-q) log2 (1-q),
///
///     entropy expected after the answer = entropy - ( h(sum p L) - sum p h(L) ),
///
/// and the bracket is the information expected of the answer: two products of a matrix and a
/// vector, and no logarithm but one pair for each stimulus.
class QuestPlus {
 public:
  /// Throws `Error` naming the field of the rule that is wrong.
  explicit QuestPlus(QuestPlusRule rule);

  [[nodiscard]] const QuestPlusRule& rule() const noexcept { return rule_; }
  /// Values of the parameters at an index of the posterior.
  [[nodiscard]] std::vector<double> values_at(Eigen::Index combination) const;

  [[nodiscard]] const QuestPlusPosterior& prior() const noexcept { return prior_; }
  /// From the prior. Throws `Error` if the answers are impossible with all parameters, or an
  /// intensity is no number >= 0. Intensities may be others than those of the rule.
  [[nodiscard]] QuestPlusPosterior posterior(const std::vector<LevelAnswer>& answers) const;
  /// The same, to the bit, with no more work than the new answers need; from the prior if
  /// `posterior` holds one that was taken back. If it throws, `posterior` is that of the
  /// answers it says.
  void bring_up_to_date(QuestPlusPosterior& posterior,
                        const std::vector<LevelAnswer>& answers) const;

  /// For each intensity; >= 0 but for rounding.
  [[nodiscard]] Eigen::VectorXd expected_information_bits(
      const QuestPlusPosterior& posterior) const;
  /// The intensity with the most expected information, or one drawn among the best; the lower
  /// one where two are alike to 1e-10 bits. Draws from the stream if `num_best` is above 1.
  [[nodiscard]] double next_intensity(const QuestPlusPosterior& posterior,
                                      core::RandomStream& stream) const;
  [[nodiscard]] double entropy_bits(const QuestPlusPosterior& posterior) const;
  [[nodiscard]] QuestPlusEnd end(const QuestPlusPosterior& posterior) const;
  /// One for each parameter; `confidence` in (0, 1).
  [[nodiscard]] std::vector<QuestPlusEstimate> estimates(const QuestPlusPosterior& posterior,
                                                         double confidence = 0.95) const;

 private:
  [[nodiscard]] Eigen::VectorXd likelihood(const LevelAnswer& answer) const;
  [[nodiscard]] std::vector<double> marginal(const QuestPlusPosterior& posterior,
                                             std::size_t parameter) const;

  QuestPlusRule rule_;
  QuestPlusPosterior prior_;
  // A column for each intensity, a row for each combination.
  std::array<Eigen::MatrixXd, 2> likelihood_;  // Of "no" and of "yes".
  Eigen::MatrixXd entropy_;                    // h(L), bits.
};

}  // namespace jnd::experiments
