#include "experiments/procedures/quest_plus_procedure.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "core/error.h"
#include "experiments/adaptive/level_scale.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

/// Tasks whose curve is that of a comparison.
std::vector<std::string> comparisons() { return {"reminder", "two_interval"}; }
/// Tasks whose curve is that of an absolute threshold.
std::vector<std::string> detections() { return {"yes_no"}; }
/// Tasks whose curve rises from guessing.
std::vector<std::string> identifications() {
  return {"three_interval", "oddity", "abx", "match_to_sample"};
}
std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Returns a key for the values of a parameter of the curve: the ends of a grid that is even in
/// ln.
BlockKey grid(const char* key, const char* meaning, const std::vector<std::string>& tasks,
              bool of_quantity, const std::string& default_json) {
  BlockKey made{.parameter = {.key = key,
                              .kind = ValueKind::kNumbers,
                              .meaning = meaning,
                              .required = default_json.empty(),
                              .default_json = default_json,
                              .range = {0.0, 1000.0, true},
                              .min_items = 2,
                              .max_items = 2,
                              .only_where = {{"task", tasks}}},
                .of_quantity = of_quantity,
                .is_positive = true};
  return made;
}

BlockKey stop(const char* key, const char* meaning, const char* unit) {
  return {.parameter = {.key = key,
                        .kind = ValueKind::kNumber,
                        .meaning = meaning,
                        .required = false,
                        .unit = unit,
                        .range = {0.0, 100.0, true}}};
}

ParameterGrid grid_of(const Block& block, const char* key) {
  const std::vector<double> ends = block.settings.numbers(key);
  if (ends[0] > ends[1]) {
    throw core::Error(std::string("quest_plus.") + key +
                      ": expected the least value and then the largest, found " +
                      plain_number(ends[0]) + " and then " + plain_number(ends[1]));
  }
  const int count = block.settings.integer("grid_values");
  return {.values = ends[0] == ends[1]
                        ? std::vector<double>{ends[0]}
                        : equally_spaced(LevelScale::kLogarithmic, ends[0], ends[1], count)};
}

std::string range_words(const ParameterGrid& grid) {
  const double least = grid.values.front(), largest = grid.values.back();
  return least == largest ? plain_number(least)
                          : plain_number(least) + " to " + plain_number(largest);
}

/// `shown` is the largest fraction for which there is a stimulus.
void check_fraction(const Block& block, double shown, const std::string& tests) {
  const ParameterGrid fraction = grid_of(block, "weber_fraction");
  constexpr double kShortest = 1000.0;
  if (fraction.values.front() <= shown) return;
  throw core::Error("quest_plus.weber_fraction: expected a range that begins at no more than " +
                    plain_number(std::round(kShortest * shown) / kShortest) +
                    ", the largest fraction that the test stimuli (" + tests +
                    ") show around the reference (" +
                    plain_number(block.reference_intensity.value()) + "), found " +
                    range_words(fraction));
}

/// If a grid excludes what the block asks for, the estimate ends at the grid's edge, whatever
/// the answers are.
void check_grids(const Block& block, double lowest, double highest) {
  const std::string tests = plain_number(lowest) + " to " + plain_number(highest);
  if (!block.reference_intensity) {
    const ParameterGrid threshold = grid_of(block, "threshold");
    if (threshold.values.back() >= lowest && threshold.values.front() <= highest) return;
    throw core::Error(
        "quest_plus.threshold: expected a range that holds some of the test stimuli (" + tests +
        "), which are all felt or all not felt otherwise, found " + range_words(threshold));
  }
  const double reference = *block.reference_intensity;
  const double shown = std::max(highest / reference, reference / lowest) - 1.0;
  if (num_choices_to_guess(task_of(block)) > 0) return check_fraction(block, shown, tests);
  const ParameterGrid pse = grid_of(block, "pse");
  const bool is_known = pse.values.size() == 1;
  const double least = pse.values.front(), largest = pse.values.back();
  if (is_known ? least != reference : least >= reference || largest <= reference) {
    throw core::Error(
        "quest_plus.pse: expected a range that goes from below the reference to above it (" +
        plain_number(reference) + "), for the point of subjective equality lies about there, " +
        "found " + range_words(pse));
  }
  check_fraction(block, shown, tests);
}

}  // namespace

std::string QuestPlusProcedure::meaning() const {
  return "Each trial shows the stimulus whose answer is expected to tell the most (Watson "
         "2017).";
}

std::vector<BlockKey> QuestPlusProcedure::keys() const {
  std::vector<BlockKey> keys = {
      stimuli_key(),
      grid("pse",
           "Least and largest point of subjective equality that is thought possible; the "
           "reference lies between them. Where answers take the posterior to an end, no "
           "interval is told, so better too wide than too narrow.",
           comparisons(), true, ""),
      grid("weber_fraction",
           "Least and largest Weber fraction that is thought possible; of tasks with three "
           "intervals that at which the share of right answers is half way from a guess to 1.",
           joined(comparisons(), identifications()), false, "[0.05, 2.0]"),
      grid("threshold", "Least and largest threshold that is thought possible.", detections(),
           true, ""),
      grid("slope", "Least and largest slope at the threshold, per ln, thought possible.",
           joined(detections(), identifications()), false, "[0.5, 10.0]"),
      whole_number_key("grid_values", "Values of each of them, evenly in ln.", {2, 200}, "30"),
      {.parameter = {.key = "lapse_rate",
                     .kind = ValueKind::kNumber,
                     .meaning = "Answers thought to be given at random, at either end.",
                     .required = false,
                     .default_json = "0.02",
                     .range = {0.0, 0.4}}},
      whole_number_key("max_trials", "The block ends after so many trials.", {1, 1000}, "40"),
      whole_number_key("min_trials", "Before, nothing else ends it.", {0, 1000}, "0"),
      stop("stop_entropy_bits", "It also ends at this entropy of what is thought.", "bit"),
      stop("stop_sd_ln",
           "It also ends when the Weber fraction, or the threshold, is known to this standard "
           "deviation of its ln.",
           ""),
      whole_number_key(
          "num_best",
          "The stimulus is drawn among so many of the best: a little less is learned, and "
          "less can be guessed.",
          {1, 50}, "1")};
  for (BlockKey& key : adaptive_keys()) keys.push_back(std::move(key));
  return keys;
}

std::vector<std::string> QuestPlusProcedure::examples() const {
  return {R"json({"kind": "block", "name": "most_telling",
  "procedure": "quest_plus", "medium": "viscous",
  "viscosity_pa_s": [3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 18, 24], "reference_viscosity_pa_s": 8,
  "pse_viscosity_pa_s": [4, 16], "weber_fraction": [0.05, 2], "max_trials": 40,
  "instruction": {"en": "First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"};
}

TrialForm QuestPlusProcedure::form(const Block& block) const { return form_of(task_of(block)); }

Measure QuestPlusProcedure::measures(const Block& block) const {
  return measure_of(task_of(block));
}

std::optional<double> QuestPlusProcedure::right_response(const Block& block,
                                                         const PlannedTrial& trial) const {
  return experiments::right_response(task_of(block), trial);
}

std::optional<double> QuestPlusProcedure::feedback_response(const Block& block,
                                                            const PlannedTrial& trial) const {
  return experiments::feedback_response(task_of(block), trial);
}

QuestPlusRule quest_plus_rule_of(const Block& block) {
  const Settings& given = block.settings;
  const ParameterGrid lapse{{given.number("lapse_rate")}};
  const Task task = task_of(block);
  const bool compares = task != Task::kYesNo;
  const int num_choices = num_choices_to_guess(task);
  QuestPlusRule rule{
      .model = num_choices > 0
                   ? identification_model({.threshold = grid_of(block, "weber_fraction"),
                                           .slope = grid_of(block, "slope"),
                                           .guess_rate = {{1.0 / num_choices}},
                                           .lapse_rate = lapse},
                                          block.reference_intensity.value())
               : compares ? weber_model({.pse = grid_of(block, "pse"),
                                         .weber_fraction = grid_of(block, "weber_fraction"),
                                         .lapse_rate = lapse})
                          : gauss_model({.threshold = grid_of(block, "threshold"),
                                         .slope = grid_of(block, "slope"),
                                         .guess_rate = lapse,
                                         .lapse_rate = lapse}),
      .intensities = block.intensities,
      .num_best =
          std::min(given.integer("num_best"), static_cast<int>(block.intensities.size())),
      .max_trials = given.integer("max_trials"),
      .min_trials = given.integer("min_trials"),
      .entropy_bits = given.optional_number("stop_entropy_bits")};
  std::ranges::sort(rule.intensities);
  if (const std::optional<double> sd = given.optional_number("stop_sd_ln")) {
    rule.marginal = MarginalStop{compares ? "weber_fraction" : "threshold", *sd};
  }
  return rule;
}

/// Returns the QUEST+ of a block's rule. Its tables take longer to make than to use, and every
/// trial needs them. So each thread keeps those of the blocks from which it drew last.
static std::shared_ptr<const QuestPlus> quest_of(const Block& block) {
  struct Known {
    std::vector<double> intensities;
    Settings settings;
    std::shared_ptr<const QuestPlus> quest;
  };
  constexpr std::size_t kMost = 4;
  thread_local std::deque<Known> all_known;
  for (const Known& known : all_known) {
    if (known.intensities == block.intensities && known.settings == block.settings) {
      return known.quest;
    }
  }
  if (all_known.size() == kMost) all_known.pop_front();
  auto quest = std::make_shared<const QuestPlus>(quest_plus_rule_of(block));
  all_known.push_back({block.intensities, block.settings, std::move(quest)});
  return all_known.back().quest;
}

std::vector<PlannedTrial> QuestPlusProcedure::draw_next(
    const Block& block, const std::vector<AnsweredTrial>& answered,
    core::RandomStream& stream) const {
  const std::shared_ptr<const QuestPlus> quest = quest_of(block);
  const QuestPlusPosterior posterior = quest->posterior(level_answers(answered));
  if (quest->end(posterior) != QuestPlusEnd::kNotFinished) return {};
  const double level = quest->next_intensity(posterior, stream);
  return {adaptive_trial(block, answered, level, 0, stream)};
}

std::vector<std::string> reached_ends(const Block& block,
                                      const std::vector<QuestPlusEstimate>& estimates) {
  std::vector<std::string> ends;
  for (const QuestPlusEstimate& one : estimates) {
    if (!one.reaches_an_end()) continue;
    const bool of_quantity = one.name == "pse" || one.name == "threshold";
    const std::string key = "`" + one.name + (of_quantity ? "_" + block.quantity : "") + "`";
    const std::vector<double> given = block.settings.numbers(one.name);
    if (one.reached_low) {
      ends.push_back("the lower end of " + key + " (" + plain_number(given.front()) + ")");
    }
    if (one.reached_high) {
      ends.push_back("the upper end of " + key + " (" + plain_number(given.back()) + ")");
    }
  }
  return ends;
}

std::string QuestPlusProcedure::caution(const Block& block,
                                        const std::vector<AnsweredTrial>& answered) const {
  const std::shared_ptr<const QuestPlus> quest = quest_of(block);
  std::string words;
  for (const std::string& end :
       reached_ends(block, quest->estimates(quest->posterior(level_answers(answered))))) {
    words += (words.empty() ? "" : " and ") + end;
  }
  if (words.empty()) return "";
  return "the posterior of QUEST+ reaches " + words +
         ", so that what it says rests on where the grid ends; a wider one would let the "
         "answers "
         "speak";
}

void QuestPlusProcedure::check(const Block& block) const {
  const auto [lowest, highest] = std::ranges::minmax(block.intensities);
  const double reference = block.reference_intensity.value_or(lowest);
  if (reference < lowest || reference > highest) {
    throw core::Error(
        "quest_plus.reference: expected a number from the smallest to the largest test "
        "stimulus (" +
        plain_number(lowest) + " and " + plain_number(highest) + "), found " +
        plain_number(reference));
  }
  const int max_trials = block.settings.integer("max_trials");
  const int min_trials = block.settings.integer("min_trials");
  if (min_trials > max_trials) {
    throw core::Error("quest_plus.min_trials: expected no more than `max_trials` (" +
                      std::to_string(max_trials) + "), found " + std::to_string(min_trials));
  }
  check_grids(block, lowest, highest);
}

int QuestPlusProcedure::expected_trials(const Block& block) const {
  return with_catch_trials(block, block.settings.integer("max_trials"));
}

void QuestPlusProcedure::run(const Block& block, const std::vector<LevelTrial>& trials,
                             RuleOutcome& run) const {
  const QuestPlus quest(quest_plus_rule_of(block));
  std::vector<LevelTrial> standing;
  std::ranges::copy_if(trials, std::back_inserter(standing),
                       [](const LevelTrial& trial) { return !trial.set_aside; });
  run.is_logarithmic = true;
  run.tracks.push_back(track_of(1, trials));
  const std::vector<QuestPlusEstimate> estimates =
      quest.estimates(quest.posterior(answers_of(standing)));
  run.reached_ends = reached_ends(block, estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (quest.rule().model.parameters[i].grid.values.size() == 1) continue;  // Taken for known.
    const QuestPlusEstimate& one = estimates[i];
    run.posterior.push_back({one.name, one.mean, one.sd, one.low, one.high});
    if (!run.reached_ends.empty()) run.posterior.back().low = run.posterior.back().high = {};
  }
}

RuleWords QuestPlusProcedure::rule_words() const {
  return {.section = core::for_people(": QUEST+"),
          .tracks = core::for_people("Stimuli of QUEST+"),
          .caption = core::for_people("In the title: mean of the posterior at the end"),
          .heading = core::for_people("QUEST+"),
          .method = core::for_people(
              "Each stimulus was the one whose answer was expected to tell the most ({}). "
              "Values are means of the posterior after the last answer, of ratios in ln, "
              "with its central 95 %; the prior is even over a grid in ln, given in the "
              "study file. Where the posterior reaches an end of a grid (it is at least as "
              "high there, seen from its highest, as a normal density is at the end of its "
              "central 95 %), the grid decides about the values: they have no interval, and "
              "a caution."),
          .cited = {"Watson 2017"}};
}

}  // namespace jnd::experiments
