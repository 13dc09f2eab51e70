#include "analysis/report/threshold_methods.h"

#include <algorithm>

#include "analysis/results/block_words.h"
#include "analysis/results/threshold_results.h"
#include "analysis/words/said.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

using experiments::Procedure;
using experiments::RuleWords;

bool any(const StudyData& data, const std::function<bool(const BlockDesign&)>& holds) {
  return std::ranges::any_of(data.blocks, holds);
}

bool has_catch_trials(const StudyData& data, const std::string& block) {
  return std::ranges::any_of(data.participants, [&](const ParticipantData& one) {
    return std::ranges::any_of(
        one.catch_trials, [&](const core::TrialRow& trial) { return trial.block == block; });
  });
}

}  // namespace

void add_threshold_methods(
    const StudyData& data, const std::function<std::string(const std::string&)>& cite,
    const std::function<void(const std::string&, const std::string&)>& add) {
  if (any(data, &BlockDesign::detects)) {
    std::string text = said(
        "The test was presented alone and “is it felt?” was asked. P(yes) = Φ(ln(x / "
        "threshold) / s) was fitted to each participant’s answers by maximum likelihood: the "
        "threshold is felt in 50 %. Intervals are those of the likelihood ratio.");
    if (any(data, [&](const BlockDesign& block) {
          return block.detects() && has_catch_trials(data, block.block);
        })) {
      text += said(
          " Corrected thresholds are of P(yes) = g + (1 − g) Φ(ln(x / threshold) / s), g being "
          "the rate of “yes” in catch trials, estimated with the others: false alarms count as "
          "guesses that a stimulus does not prevent ({}). Sensitivity d′ = z(H) − z(F) and "
          "criterion c = −(z(H) + z(F)) / 2 ({}) take all stimuli of the block together; half "
          "an answer is added to every count and one trial to every number ({}).",
          cite("Abbott 1925"), cite("Green and Swets 1966"), cite("Hautus 1995"));
    }
    add(said("Absolute thresholds"), text);
  }
  if (any(data, &BlockDesign::tells_apart)) {
    add(said("Same or different"),
        said(
            "P(different) = Φ((−k + d) / s) + Φ((−k − d) / s) with d = ln(x / reference), the "
            "differencing model ({}), by maximum likelihood; k is the criterion, and ln(1 + w) "
            "= s, so that w is the Weber fraction of a comparison with the point of subjective "
            "equality at the reference. Pairs that were the same take part with d = 0.",
            cite("Macmillan and Creelman 2005")));
  }
  if (any(data, &BlockDesign::identifies)) {
    add(said("Choices among three intervals"),
        said("P(right) = g + (1 − g) Φ(ln(d / ln(1 + w)) / s) with d = |ln(x / reference)|, by "
             "maximum likelihood; g is the share of right answers by guessing, 1/3 where any "
             "of three intervals can be right and 1/2 where it is one of two. w is the Weber "
             "fraction at which the share of right answers is half way from g to 1. No "
             "observer model stands behind it: of the same ability, tasks have different "
             "fractions, and none is turned into a d′ ({}). Right answers less those by "
             "guessing are tested by a t test against 0.",
             cite("Macmillan and Creelman 2005")));
  }
  std::string with_feedback;
  for (const BlockDesign& block : data.blocks) {
    if (block.written.feedback) {
      with_feedback += (with_feedback.empty() ? "" : ", ") + block.block;
    }
  }
  if (!with_feedback.empty()) {
    add(said("Feedback"),
        said("Participants were told after every answer whether it was right in {}.",
             with_feedback));
  }
  if (std::ranges::any_of(data.blocks,
                          [](const BlockDesign& block) { return block.written.cannot_tell; })) {
    add(said("Cannot tell"),
        said("Where “cannot tell” was an answer, it is in no curve and in no rate, neither as "
             "right nor as wrong nor as half of either. What is estimated rests on the answers "
             "in which a choice was made, so that a Weber fraction comes out smaller than "
             "where everybody has to choose; the share of “cannot tell” is told beside it "
             "(cannot_tell_ratio)."));
  }
  if (std::ranges::any_of(data.blocks, [](const BlockDesign& block) {
        return block.written.answer_deadline_s.has_value();
      })) {
    add(said("Deadline"),
        said("An answer that missed the deadline of its block is in no estimate; its trial was "
             "run again, and the share of such answers is told (missed_deadline_ratio)."));
  }
  if (!data.practice.empty()) {
    add(said("Practice"),
        said("Listed among the results are the trials that everybody practised (num_trials), "
             "how many of the last ones that count (num_judged) were right (num_correct), and "
             "whether that met the criterion (criterion_met, 1 or 0). Practice is no data."));
  }
  for (const BlockDesign& block : data.blocks) {
    const bool is_told =
        std::ranges::find(data.runs, block.block, &AdaptiveRun::block) != data.runs.end() &&
        !(block.written.settings == experiments::Settings{});
    if (!is_told) continue;
    add(said("Levels of {}", block.block),
        adaptive_design_words(block.written, experiments::quantity_unit(block.quantity)) + ".");
  }
  std::vector<const Procedure*> by_rule = experiments::procedures();
  std::ranges::stable_sort(by_rule, {}, &Procedure::rule);
  for (const Procedure* procedure : by_rule) {
    const RuleWords words = procedure->rule_words();
    const bool is_used = any(data, [&](const BlockDesign& block) {
      return block.is_adaptive() && block.procedure == procedure->name();
    });
    if (!is_used || *words.method == '\0') continue;
    std::vector<std::string> cited;
    for (const char* source : words.cited) cited.push_back(cite(source));
    add(said(words.heading), said_with(words.method, cited));
  }
  if (any(data, &BlockDesign::is_adaptive) && any(data, &BlockDesign::compares)) {
    add(said("Raw answers of adaptive blocks"),
        said("Psychometric functions are fitted to them as to constant stimuli; levels that "
             "follow from answers make such fits slightly steep."));
  }
  if (any(data, [&](const BlockDesign& block) {
        return block.compares() && has_catch_trials(data, block.block);
      })) {
    add(said("Catch trials of comparisons"),
        said("In them the test equals the reference. They are in no curve; how often the test "
             "was called more, or of two intervals the one drawn for it was chosen, is told "
             "with Wilson’s intervals ({}).",
             cite("Wilson 1927")));
  }
  if (any(data, [&](const BlockDesign& block) { return has_intervals(data, block); })) {
    add(said("Order of the intervals"),
        said("Where either interval may hold the test, each order has a point of subjective "
             "equality of its own, and one Weber fraction serves both: P(test chosen) = "
             "Φ((ln(x / PSE) − o q) / ln(1 + w)), o = ±1/2 for the test second or first. q is "
             "the order effect, always free; the mean of both orders would have too large a "
             "Weber fraction ({}). In the hierarchical model q is what people differ by. "
             "Primary is the analysis with the point of subjective equality at the reference: "
             "two stimuli that are alike differ in nothing but their order, so over both "
             "orders either is chosen in half of the trials. Interval bias: the share of "
             "answers that choose the second interval, both orders weighed equally, less one "
             "half. Tests of both are t tests against 0.",
             cite("Ulrich and Vorberg 2009")));
  }
  if (any(data, [](const BlockDesign& block) {
        return block.detects() || block.tells_apart() || block.is_adaptive();
      })) {
    add(said("Thresholds of the group"),
        said("Geometric means over participants with Student’s t intervals in ln, and the "
             "standard deviation of ln between people; Weber fractions likewise in ln ln(1 + "
             "w). Who has no value of their own is named, and where half an answer of either "
             "kind, spread evenly over the levels, gives them one, everybody is shown "
             "besides."));
  }
}

}  // namespace jnd::analysis
