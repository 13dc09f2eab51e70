#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/for_people.h"
#include "core/random_stream.h"
#include "experiments/adaptive/rule_outcome.h"
#include "experiments/procedures/block_key.h"
#include "experiments/procedures/planned_trial.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// A trial with its answer, as an adaptive procedure needs it.
struct AnsweredTrial {
  PlannedTrial planned;
  std::optional<double> response = 0.0;  ///< As stored; none means "cannot tell".
};

enum class AnswerKind {
  kPercent,  ///< A number >= 0 in percent of water.
  kYesNo,    ///< 1 is yes, or different; 0 is no, or the same.
  /// An interval. 1 is stored for that of the test, or the right one, and otherwise 0.
  kInterval,
  kMatch,   ///< "It matches"; the answer is the intensity that was set.
  kNumber,  ///< A number > 0, in the unit of a standard or of the participant's own.
  kStep,    ///< A step of a scale, from 1 to the block's `num_steps`.
};

/// What the experimenter can do in a trial of this procedure.
struct TrialForm {
  AnswerKind answer = AnswerKind::kPercent;
  /// The reference comes first, with free switching back and forth.
  bool has_reference = false;
  bool adjustable = false;  ///< The intensity moves by steps until it matches.
  /// The stimuli come in two intervals, "first" and "second", and the trial's `test_interval`
  /// holds the test. Or there are three, with a "third", and the trial's `intervals` says what
  /// they hold.
  bool order_is_drawn = false;
  int num_intervals = 2;                  ///< Number of intervals if the order is drawn.
  int first_choice = 1, num_choices = 2;  ///< Intervals among which an answer chooses.
};

/// What the answers of a block are about, which determines their analysis.
enum class Measure {
  kMagnitude,          ///< How strong each stimulus feels, in numbers: a power law.
  kProducedMagnitude,  ///< How strong a stimulus must be for each number: a power law.
  kMatch,              ///< How strong it must be to equal a standard: points of equality.
  kRating,             ///< The step of a scale for each stimulus: means, and a trend.
  kComparison,         ///< Whether it is more than a reference: a psychometric function.
  kDetection,          ///< Whether it is felt at all: an absolute threshold.
  kDifference,         ///< Whether it differs from a reference: the distance needed.
  /// Which of several intervals is the right one: the share of right answers.
  kIdentification,
};

/// By which rule answers decide what is presented next. All that results tell of `kOther` is
/// the threshold that it comes to.
enum class AdaptiveRule { kNone, kStaircase, kLimits, kQuestPlus, kOther };

/// How results tell of such a rule, for people.
struct RuleWords {
  const char* section = "";        ///< Of results, after the block's title: ": staircases".
  const char* tracks = "";         ///< Heading of a chart of its trials: "Staircases".
  const char* caption = "";        ///< What is in it; a hole is the `rule` of the outcome.
  const char* heading = "";        ///< Of a paragraph of the report's methods.
  const char* method = "";         ///< The paragraph, with a hole for each source.
  std::vector<const char*> cited;  ///< The sources: "Levitt 1971".
};

/// How a block asks: which trials, in which order, and how they are answered. It has no state:
/// drawn and answered trials are passed in, and randomness comes from the stream, so a session
/// can be replayed.
class Procedure {
 public:
  virtual ~Procedure() = default;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// As a heading calls it, for people: "Limits".
  [[nodiscard]] virtual std::string title() const = 0;
  /// As a sentence calls it, for people: "method of limits".
  [[nodiscard]] virtual std::string words() const = 0;
  /// Returns a sentence for those who choose a procedure.
  [[nodiscard]] virtual std::string meaning() const = 0;
  /// Returns the keys of its blocks besides the common ones, in the order of the reference.
  [[nodiscard]] virtual std::vector<BlockKey> keys() const = 0;
  /// Blocks with it as a study file has them, one at least: schema, snippets of editors and
  /// reference show them, and the reader takes them as they stand, in English.
  [[nodiscard]] virtual std::vector<std::string> examples() const { return {}; }
  [[nodiscard]] virtual TrialForm form(const Block& block) const = 0;
  [[nodiscard]] virtual Measure measures(const Block& block) const = 0;
  /// Returns the trials to run next, once all of `answered` are done, or none if the block is
  /// finished. Throws `Error` if the block lacks what the procedure needs.
  [[nodiscard]] virtual std::vector<PlannedTrial> draw_next(
      const Block& block, const std::vector<AnsweredTrial>& answered,
      core::RandomStream& stream) const = 0;
  /// Returns the test stimuli that a trial may present, at least the ends of their range. This
  /// does not cover an adjustment, which goes where the participant wants.
  [[nodiscard]] virtual std::vector<double> possible_intensities(const Block& block) const {
    return block.intensities;
  }
  /// Returns the right response to a trial, as stored, or none if no answer is right, for
  /// example to the question which of two equal stimuli is more.
  [[nodiscard]] virtual std::optional<double> right_response(const Block&,
                                                             const PlannedTrial&) const {
    return std::nullopt;
  }
  /// Returns the response that feedback calls right; see `experiments::feedback_response`.
  [[nodiscard]] virtual std::optional<double> feedback_response(
      const Block& block, const PlannedTrial& trial) const {
    return right_response(block, trial);
  }
  /// Throws `Error`, "staircase.highest: expected ...", for a block whose trials can be drawn
  /// but that cannot reach its goal. The name after the dot is a key.
  virtual void check(const Block&) const {}
  /// Returns half a sentence for the experimenter if the answers of a finished block cast doubt
  /// on its result, or "".
  [[nodiscard]] virtual std::string caution(const Block&,
                                            const std::vector<AnsweredTrial>&) const {
    return "";
  }
  [[nodiscard]] virtual AdaptiveRule rule() const noexcept { return AdaptiveRule::kNone; }
  [[nodiscard]] virtual RuleWords rule_words() const { return {}; }
  /// Fills in what the trials of a block, in their order, come to by the rule. Throws `Error`
  /// where the answers do not follow it.
  virtual void run(const Block&, const std::vector<LevelTrial>&, RuleOutcome&) const {}
  /// Whether the answers decide what is presented, and how many trials there are.
  [[nodiscard]] virtual bool adapts() const noexcept { return rule() != AdaptiveRule::kNone; }
  /// Returns how many trials to expect, for progress and planning; at most `most_trials`.
  [[nodiscard]] virtual int expected_trials(const Block& block) const = 0;
  /// Returns the largest number of trials, including the expected number of catch trials.
  [[nodiscard]] virtual int most_trials(const Block& block) const noexcept {
    return expected_trials(block);
  }
};

}  // namespace jnd::experiments
