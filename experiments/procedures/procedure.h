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
  std::optional<double> response = 0.0;  ///< As it is stored; none: "cannot tell".
};

enum class AnswerKind {
  kPercent,   ///< A number >= 0, water being 100.
  kYesNo,     ///< 1 is yes, or different; 0 is no, or the same.
  kInterval,  ///< An interval. Stored is 1 for that of the test, or the right one, else 0.
  kMatch,     ///< "It matches"; the answer is the intensity that was set.
  kNumber,    ///< A number > 0, in the unit of a standard or of one's own.
  kStep,      ///< A step of a scale, counted from 1; the block's `num_steps` is the last.
};

/// What the experimenter can do in a trial of this procedure.
struct TrialForm {
  AnswerKind answer = AnswerKind::kPercent;
  bool has_reference = false;  ///< The reference comes first; free switching back and forth.
  bool adjustable = false;     ///< The intensity moves by steps until it matches.
  /// Two intervals instead, "first" and "second"; the trial's `test_interval` holds the test.
  /// Or three, with a "third"; `intervals` of the trial says what they hold.
  bool order_is_drawn = false;
  int num_intervals = 2;                  ///< Where the order is drawn.
  int first_choice = 1, num_choices = 2;  ///< Which intervals an answer chooses among.
};

/// What the answers of a block are about, which decides how they are analysed.
enum class Measure {
  kMagnitude,          ///< How strong each stimulus feels, in numbers: a power law.
  kProducedMagnitude,  ///< How strong a stimulus has to be for each number: a power law.
  kMatch,              ///< How strong it has to be to equal a standard: points of equality.
  kRating,             ///< On which step of a scale each stimulus is: means, and a trend.
  kComparison,         ///< Whether it is more than a reference: a psychometric function.
  kDetection,          ///< Whether it is felt at all: an absolute threshold.
  kDifference,         ///< Whether it differs from a reference: how far the two must be apart.
  kIdentification,  ///< Which of several intervals is the right one: the share of right ones.
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

/// How a block asks: which trials, in which order, answered how. Stateless: what was drawn and
/// answered is passed in, and randomness comes from the stream, so a session can be replayed.
class Procedure {
 public:
  virtual ~Procedure() = default;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// As a heading calls it, for people: "Limits".
  [[nodiscard]] virtual std::string title() const = 0;
  /// As a sentence calls it, for people: "method of limits".
  [[nodiscard]] virtual std::string words() const = 0;
  /// In a sentence, for who chooses one.
  [[nodiscard]] virtual std::string meaning() const = 0;
  /// What a block with it has besides the keys of every block, in the order of the reference.
  [[nodiscard]] virtual std::vector<BlockKey> keys() const = 0;
  /// Blocks with it as a study file has them, one at least: schema, snippets of editors and
  /// reference show them, and the reader takes them as they stand, in English.
  [[nodiscard]] virtual std::vector<std::string> examples() const { return {}; }
  [[nodiscard]] virtual TrialForm form(const Block& block) const = 0;
  [[nodiscard]] virtual Measure measures(const Block& block) const = 0;
  /// The trials to be run next, once all of `answered` are; none when the block is finished.
  /// Throws `Error` if the block lacks what the procedure needs.
  [[nodiscard]] virtual std::vector<PlannedTrial> draw_next(
      const Block& block, const std::vector<AnsweredTrial>& answered,
      core::RandomStream& stream) const = 0;
  /// Test stimuli that a trial may present, at least the ends of their range. Not of an
  /// adjustment, which goes where the participant wants.
  [[nodiscard]] virtual std::vector<double> possible_intensities(const Block& block) const {
    return block.intensities;
  }
  /// The response, as stored, that is right for a trial; none where no answer is, as to the
  /// question which of two equal stimuli is more.
  [[nodiscard]] virtual std::optional<double> right_response(const Block&,
                                                             const PlannedTrial&) const {
    return std::nullopt;
  }
  /// The response that feedback calls right; see `experiments::feedback_response`.
  [[nodiscard]] virtual std::optional<double> feedback_response(
      const Block& block, const PlannedTrial& trial) const {
    return right_response(block, trial);
  }
  /// Throws `Error`, "staircase.highest: expected ...", where a block whose trials can be drawn
  /// cannot come to what it is for; the name behind the dot is that of a key.
  virtual void check(const Block&) const {}
  /// What the answers of a block at its end say against what it comes to, for whoever runs the
  /// session, in half a sentence; "" where nothing does.
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
  /// How many trials to expect, for progress and planning; no more than `most_trials`.
  [[nodiscard]] virtual int expected_trials(const Block& block) const = 0;
  /// How many there can be, with as many catch trials as are to be expected among them.
  [[nodiscard]] virtual int most_trials(const Block& block) const noexcept {
    return expected_trials(block);
  }
};

}  // namespace jnd::experiments
