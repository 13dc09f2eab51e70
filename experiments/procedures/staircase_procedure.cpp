#include "experiments/procedures/staircase_procedure.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "experiments/adaptive/interleave.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

std::vector<BlockKey> step_size_keys() {
  BlockKey linear{.parameter = {.key = "step",
                                .kind = ValueKind::kNumbers,
                                .meaning = "Steps upwards: the first until the first reversal, "
                                           "the next until the second, and so on.",
                                .max_items = 20,
                                .only_where = {{"level_scale", {"linear"}}}},
                  .of_quantity = true,
                  .is_positive = true};
  BlockKey ratio{.parameter = {.key = "step_ratio",
                               .kind = ValueKind::kNumbers,
                               .meaning = "Steps upwards as factors, one for each "
                                          "reversal as in `step`: 1.2 is a step of 20 "
                                          "percent.",
                               .range = {1.0, 100.0, true},
                               .max_items = 20,
                               .only_where = {{"level_scale", {"logarithmic"}}}}};
  return {linear, ratio};
}

/// Returns the smallest number of trials for this many reversals. Each reversal is a turn
/// between a run of `num_up` and a run of `num_down` trials.
int least_trials(int num_up, int num_down, int num_reversals) {
  const int num_pairs = (num_reversals + 1) / 2;
  const int rest = num_reversals % 2 == 0 ? std::min(num_up, num_down) : 0;
  return num_pairs * (num_up + num_down) + rest;
}

std::string up_down_words(const StaircaseRule& rule) {
  return std::to_string(rule.num_up) + " up and " + std::to_string(rule.num_down) + " down";
}

/// Throws `Error` unless the levels lie on the side of the reference at which the rule aims.
void check_side(double target, double reference, const StaircaseRule& rule) {
  constexpr double kRounding = 1e-9;
  const auto refuse = [&](const char* key, const char* side, double found) {
    throw core::Error(std::string("staircase.") + key + ": expected a level " + side +
                      " the reference (" + plain_number(reference) +
                      "), as the staircase aims at the one that is called more in " +
                      plain_number(std::round(1000.0 * target) / 10.0) +
                      " % of trials, found " + plain_number(found));
  };
  if (target > 0.5 - kRounding && rule.highest <= reference) {
    refuse("highest", "above", rule.highest);
  }
  if (target < 0.5 + kRounding && rule.lowest >= reference) {
    refuse("lowest", "below", rule.lowest);
  }
}

/// Throws `Error` unless the rule aims above the share of right answers by guessing, and higher
/// levels are easier ones.
void check_identification(double target, double reference, const StaircaseRule& rule,
                          int num_choices) {
  constexpr double kRounding = 1e-9;
  const auto percent = [](double share) {
    return plain_number(std::round(1000.0 * share) / 10.0) + " %";
  };
  if (target < 1.0 / num_choices + kRounding) {
    throw core::Error("staircase.num_down: expected a rule that aims above " +
                      percent(1.0 / num_choices) +
                      ", the share of right answers by guessing, found " + up_down_words(rule) +
                      ", which aim at " + percent(target) + "; 1 up and 2 down aim at 70.7 %");
  }
  if (rule.lowest <= reference) {
    throw core::Error(
        "staircase.lowest: expected a level above the reference (" + plain_number(reference) +
        "), as a lower level has to be a harder one, found " + plain_number(rule.lowest));
  }
}

/// The observer for whom the number of trials is computed.
struct Observer {
  /// Level at which half of the answers are "yes", in the unit of the quantity.
  double threshold = 0.0;
  double spread = 0.0;  ///< Spread of the curve, in the scale of the block.
};

/// Returns an observer who compares with a Weber fraction of 0.3. Without a comparison the
/// threshold is unknown in advance, so the observer has it in the middle of the levels, with a
/// curve that rises over a factor of e.
Observer usual_observer(const Block& block) {
  constexpr double kSpreadOfComparisonLn = 0.3;
  constexpr double kSpreadOfDetectionLn = 1.0;
  const StaircaseRule rule = staircase_rule_of(block, 1);
  const double threshold =
      block.reference_intensity.value_or(midpoint(rule.scale, rule.lowest, rule.highest));
  const double spread_ln =
      block.reference_intensity ? kSpreadOfComparisonLn : kSpreadOfDetectionLn;
  return {threshold,
          rule.scale == LevelScale::kLogarithmic ? spread_ln : spread_ln * threshold};
}

int num_series(const Block& block) {
  return static_cast<int>(block.settings.numbers("start").size());
}

AdaptiveTrack staircase_track(const Staircase& staircase, int series,
                              const std::vector<LevelTrial>& trials) {
  AdaptiveTrack track = track_of(series, trials);
  const StaircaseState state = staircase.after(answers_of(trials));
  const StaircaseThreshold threshold = staircase.threshold(state);
  track.threshold = threshold.level;
  track.num_reversals = threshold.num_reversals;
  track.num_at_bound = threshold.num_at_bound;
  mark_after_end(track, state.num_after_end);
  const std::size_t first =
      state.reversals.size() - static_cast<std::size_t>(threshold.num_reversals);
  for (std::size_t i = 0; i < state.reversals.size(); ++i) {
    TrackPoint& point = track.points.at(state.reversals[i].trial);
    point.is_reversal = true;
    point.is_averaged = i >= first;
  }
  return track;
}

std::string rule_with_citation(const StaircaseRule& rule) {
  std::string words =
      std::to_string(rule.num_up) + " up, " + std::to_string(rule.num_down) + " down";
  if (rule.down_per_up_ratio != 1.0) {
    std::string ratio = std::to_string(rule.down_per_up_ratio);
    ratio.erase(ratio.find_last_not_of('0') + 1);
    if (ratio.ends_with('.')) ratio.pop_back();
    return words + ", steps down " + ratio + " times those up; Kaernbach 1991";
  }
  return words + "; Levitt 1971";
}

}  // namespace

std::string StaircaseProcedure::meaning() const {
  return "The level falls after \"yes\" and rises after \"no\", about the level at which both "
         "balance (Levitt 1971).";
}

std::vector<BlockKey> StaircaseProcedure::keys() const {
  std::vector<BlockKey> keys = {
      {.parameter = {.key = "start",
                     .kind = ValueKind::kNumbers,
                     .meaning = "Where staircases start: one for each value, interleaved.",
                     .max_items = 8},
       .of_quantity = true,
       .is_positive = true},
      amount_key("lowest", "No level is below this."),
      amount_key("highest", "No level is above this."),
      scale_key()};
  for (BlockKey& key : step_size_keys()) keys.push_back(std::move(key));
  keys.push_back(
      whole_number_key("num_up", "\"No\" in a row that raise the level.", {1, 10}, "1"));
  keys.push_back(
      whole_number_key("num_down", "\"Yes\" in a row that lower the level.", {1, 10}, "2"));
  keys.push_back({.parameter = {.key = "down_per_up_ratio",
                                .kind = ValueKind::kNumber,
                                .meaning = "Step downwards over step upwards, for weighted "
                                           "staircases (Kaernbach 1991).",
                                .required = false,
                                .default_json = "1.0",
                                .range = {0.0, 100.0, true}}});
  keys.push_back(whole_number_key("max_reversals", "A staircase ends after so many reversals.",
                                  {2, 100}, "10"));
  keys.push_back(whole_number_key(
      "max_trials", "Or after so many trials, whichever comes first.", {1, 1000}, "60"));
  keys.push_back(whole_number_key(
      "num_reversals_averaged",
      "The threshold is the mean of so many last reversals, an even number.", {2, 100}, "6"));
  for (BlockKey& key : adaptive_keys()) keys.push_back(std::move(key));
  return keys;
}

std::vector<std::string> StaircaseProcedure::examples() const {
  return {R"json({"kind": "block", "name": "up_and_down",
  "procedure": "staircase", "medium": "viscous", "reference_viscosity_pa_s": 8,
  "start_viscosity_pa_s": [16, 4], "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 30,
  "step_ratio": [1.5, 1.25, 1.1], "num_down": 2, "max_reversals": 10,
  "instruction": {"en": "First comes the reference, then the test."},
  "question": {"en": "Was the test thicker than the reference?"},
  "free_space_between_s": 2, "expected_trial_s": 15})json"};
}

TrialForm StaircaseProcedure::form(const Block& block) const { return form_of(task_of(block)); }

Measure StaircaseProcedure::measures(const Block& block) const {
  return measure_of(task_of(block));
}

std::optional<double> StaircaseProcedure::right_response(const Block& block,
                                                         const PlannedTrial& trial) const {
  return experiments::right_response(task_of(block), trial);
}

std::optional<double> StaircaseProcedure::feedback_response(const Block& block,
                                                            const PlannedTrial& trial) const {
  return experiments::feedback_response(task_of(block), trial);
}

StaircaseRule staircase_rule_of(const Block& block, int series) {
  const Settings& given = block.settings;
  const bool is_logarithmic = given.word("level_scale") == "logarithmic";
  std::vector<double> steps = given.numbers(is_logarithmic ? "step_ratio" : "step");
  if (is_logarithmic) {
    for (double& step : steps) step = std::log(step);
  }
  return {.num_up = given.integer("num_up"),
          .num_down = given.integer("num_down"),
          .scale = is_logarithmic ? LevelScale::kLogarithmic : LevelScale::kLinear,
          .step_sizes = std::move(steps),
          .down_per_up_ratio = given.number("down_per_up_ratio"),
          .start = given.numbers("start").at(static_cast<std::size_t>(series) - 1),
          .lowest = given.number("lowest"),
          .highest = given.number("highest"),
          .max_trials = given.integer("max_trials"),
          .max_reversals = given.integer("max_reversals"),
          .num_reversals_averaged = given.integer("num_reversals_averaged")};
}

std::vector<PlannedTrial> StaircaseProcedure::draw_next(
    const Block& block, const std::vector<AnsweredTrial>& answered,
    core::RandomStream& stream) const {
  constexpr int kMaxLeadTrials = 2;
  std::vector<StaircaseState> states;
  std::vector<InterleavedTrack> tracks;
  for (int series = 1; series <= num_series(block); ++series) {
    const std::vector<LevelAnswer> answers = level_answers(answered, series);
    states.push_back(Staircase(staircase_rule_of(block, series)).after(answers));
    tracks.push_back({.num_trials = static_cast<int>(answers.size()),
                      .is_finished = states.back().is_finished()});
  }
  const std::optional<std::size_t> next = next_track(tracks, kMaxLeadTrials, stream);
  if (!next) return {};
  return {adaptive_trial(block, answered, states[*next].next_level, static_cast<int>(*next) + 1,
                         stream)};
}

void StaircaseProcedure::check(const Block& block) const {
  const StaircaseRule rule = staircase_rule_of(block, 1);
  const int least = least_trials(rule.num_up, rule.num_down, rule.num_reversals_averaged);
  if (!block.practice && rule.max_trials < least) {
    throw core::Error("staircase.max_trials: expected at least the " + std::to_string(least) +
                      " trials that " + std::to_string(rule.num_reversals_averaged) +
                      " `num_reversals_averaged` take with " + up_down_words(rule) +
                      ", found " + std::to_string(rule.max_trials));
  }
  const double target = Staircase(rule).target_probability();
  if (task_of(block) == Task::kTwoInterval && std::abs(target - 0.5) < 1e-9) {
    throw core::Error(
        "staircase.num_down: expected a rule that aims above or below 50 %, as by chance the "
        "test is chosen in 50 % of two-interval trials, found " +
        up_down_words(rule) + "; 1 up and 2 down aim at 70.7 %");
  }
  if (const int num_choices = num_choices_to_guess(task_of(block)); num_choices > 0) {
    return check_identification(target, *block.reference_intensity, rule, num_choices);
  }
  if (block.reference_intensity) check_side(target, *block.reference_intensity, rule);
}

std::vector<double> StaircaseProcedure::possible_intensities(const Block& block) const {
  return {block.settings.number("lowest"), block.settings.number("highest")};
}

int StaircaseProcedure::expected_trials(const Block& block) const {
  const Observer observer = usual_observer(block);
  double num_trials = 0.0;
  for (int series = 1; series <= num_series(block); ++series) {
    num_trials += expected_staircase_trials(staircase_rule_of(block, series),
                                            observer.threshold, observer.spread);
  }
  return with_catch_trials(block, static_cast<int>(std::lround(num_trials)));
}

int StaircaseProcedure::most_trials(const Block& block) const noexcept {
  return with_catch_trials(block, num_series(block) * block.settings.integer("max_trials"));
}

void StaircaseProcedure::run(const Block& block, const std::vector<LevelTrial>& trials,
                             RuleOutcome& run) const {
  const auto count = static_cast<int>(block.settings.numbers("start").size());
  std::vector<double> thresholds;
  LevelScale scale = LevelScale::kLinear;
  for (int series = 1; series <= count; ++series) {
    const Staircase staircase(staircase_rule_of(block, series));
    scale = staircase.rule().scale;
    run.rule = rule_with_citation(staircase.rule());
    run.target_probability = staircase.target_probability();
    run.tracks.push_back(staircase_track(staircase, series, of_series(trials, series)));
    if (run.tracks.back().threshold) thresholds.push_back(*run.tracks.back().threshold);
  }
  run.is_logarithmic = scale == LevelScale::kLogarithmic;
  if (!thresholds.empty()) run.threshold = mean_level(scale, thresholds);
}

RuleWords StaircaseProcedure::rule_words() const {
  return {.section = core::for_people(": staircases"),
          .tracks = core::for_people("Staircases"),
          .caption = core::for_people(
              "A line is a staircase ({}), circles are its reversals; the horizontal line is "
              "the mean of the last reversals of all staircases, whose value stands in the "
              "title"),
          .heading = core::for_people("Staircases"),
          .method = core::for_people(
              "The level fell after “yes” and rose after “no” by the rule given with each "
              "estimate (transformed up-down, {}; weighted, {}). The threshold is the mean "
              "of the last reversals, an even number of them, in the scale of the steps; "
              "interleaved staircases are averaged. It estimates the level answered “yes” "
              "with the probability p at which steps up and down balance. Where there is a "
              "reference, w = (threshold / reference)^(1 / Φ⁻¹(p)) − 1, which takes the "
              "point of subjective equality to be at the reference: the same definition of w "
              "as that of the psychometric function."),
          .cited = {"Levitt 1971", "Kaernbach 1991"}};
}

}  // namespace jnd::experiments
