#include "experiments/procedures/limits_procedure.h"

#include <algorithm>

#include "core/error.h"
#include "experiments/procedures/adaptive_trial.h"

namespace jnd::experiments {
namespace {

SeriesDirection other(SeriesDirection direction) {
  return direction == SeriesDirection::kAscending ? SeriesDirection::kDescending
                                                  : SeriesDirection::kAscending;
}

/// Returns the first direction as the block says, or draws it.
SeriesDirection first_direction(const Block& block, core::RandomStream& stream) {
  const std::string& first = block.settings.word("first_series");
  const bool ascending = first == "drawn" ? stream.with_probability(0.5) : first == "ascending";
  return ascending ? SeriesDirection::kAscending : SeriesDirection::kDescending;
}

/// Returns the index at which a series begins, counted from its own end of the levels.
std::size_t start_of(const LimitsRule& rule, SeriesDirection direction, std::size_t offset) {
  return direction == SeriesDirection::kAscending ? offset : rule.levels.size() - 1 - offset;
}

std::size_t index_of(const LimitsRule& rule, double level) {
  return static_cast<std::size_t>(std::ranges::lower_bound(rule.levels, level) -
                                  rule.levels.begin());
}

/// Returns the series that have begun, as told by their first levels, and the next one, which
/// is drawn. A series begins in its own half of the levels, so its first trial tells its
/// direction.
std::vector<PlannedSeries> planned_series(const Block& block, const LimitsRule& rule,
                                          const std::vector<AnsweredTrial>& answered,
                                          core::RandomStream& stream) {
  std::vector<PlannedSeries> series;
  SeriesDirection direction = first_direction(block, stream);
  for (int number = 1; number <= rule.num_series; ++number) {
    const std::vector<LevelAnswer> own = level_answers(answered, number);
    const auto offset = static_cast<std::size_t>(
        stream.below(static_cast<std::uint64_t>(rule.max_start_offset) + 1));
    if (!own.empty()) {
      const std::size_t start = index_of(rule, own.front().level);
      if (number == 1) {
        direction = start < rule.levels.size() / 2 ? SeriesDirection::kAscending
                                                   : SeriesDirection::kDescending;
      }
      series.push_back({direction, start});
    } else {
      series.push_back({direction, start_of(rule, direction, offset)});
    }
    direction = other(direction);
  }
  return series;
}

/// A series as its first level tells it: each begins in its own half of the levels.
PlannedSeries series_from(const LimitsRule& rule, double first_level) {
  const auto start = static_cast<std::size_t>(
      std::ranges::lower_bound(rule.levels, first_level) - rule.levels.begin());
  const bool rises = start < rule.levels.size() / 2;
  return {rises ? SeriesDirection::kAscending : SeriesDirection::kDescending, start};
}

}  // namespace

std::string LimitsProcedure::meaning() const {
  return "The level rises, or falls, step by step until the answer changes (Fechner 1860).";
}

std::vector<BlockKey> LimitsProcedure::keys() const {
  std::vector<BlockKey> keys = {
      stimuli_key(),
      whole_number_key("num_series", "How many series, rising and falling in turn.", {1, 200},
                       "8"),
      {.parameter = {.key = "first_series",
                     .kind = ValueKind::kString,
                     .meaning = "Which direction comes first.",
                     .required = false,
                     .default_json = R"("drawn")",
                     .allowed = {"drawn", "ascending", "descending"}}},
      whole_number_key(
          "max_start_offset",
          "A series starts at its end of the levels or up to so many further in, drawn, so "
          "that answers cannot be counted out; less than half of the levels.",
          {0, 99}, "2"),
      whole_number_key("num_changed_in_a_row", "Changed answers that end a series.", {1, 10},
                       "1"),
      scale_key()};
  for (BlockKey& key : adaptive_keys()) keys.push_back(std::move(key));
  return keys;
}

std::vector<std::string> LimitsProcedure::examples() const {
  return {R"json({"kind": "block", "name": "least_viscosity",
  "procedure": "limits", "medium": "viscous", "task": "yes_no",
  "viscosity_pa_s": [0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2, 3], "num_series": 8, "catch_probability": 0.1,
  "instruction": {"en": "Tell whenever you feel anything in the way of your hand."},
  "question": {"en": "Is there anything?"},
  "free_space_between_s": 2, "expected_trial_s": 8})json"};
}

TrialForm LimitsProcedure::form(const Block& block) const { return form_of(task_of(block)); }

Measure LimitsProcedure::measures(const Block& block) const {
  return measure_of(task_of(block));
}

std::optional<double> LimitsProcedure::right_response(const Block& block,
                                                      const PlannedTrial& trial) const {
  return experiments::right_response(task_of(block), trial);
}

std::optional<double> LimitsProcedure::feedback_response(const Block& block,
                                                         const PlannedTrial& trial) const {
  return experiments::feedback_response(task_of(block), trial);
}

LimitsRule limits_rule_of(const Block& block) {
  const Settings& given = block.settings;
  std::vector<double> levels = block.intensities;
  std::ranges::sort(levels);
  const int most = std::max(0, static_cast<int>(levels.size()) / 2 - 1);
  return {.levels = std::move(levels),
          .scale = given.word("level_scale") == "linear" ? LevelScale::kLinear
                                                         : LevelScale::kLogarithmic,
          .num_series = given.integer("num_series"),
          .max_start_offset = std::min(given.integer("max_start_offset"), most),
          .num_changed_in_a_row = given.integer("num_changed_in_a_row")};
}

std::vector<PlannedTrial> LimitsProcedure::draw_next(const Block& block,
                                                     const std::vector<AnsweredTrial>& answered,
                                                     core::RandomStream& stream) const {
  const Limits limits(limits_rule_of(block));
  const std::vector<PlannedSeries> series =
      planned_series(block, limits.rule(), answered, stream);
  std::vector<std::vector<LevelAnswer>> answers;
  for (int number = 1; number <= limits.rule().num_series; ++number) {
    answers.push_back(level_answers(answered, number));
  }
  const LimitsState state = limits.after_series(series, answers);
  if (!state.next_level) return {};
  const bool goes_on = !state.series.empty() && state.series.back().end == SeriesEnd::kRunning;
  const auto number = static_cast<int>(state.series.size()) + (goes_on ? 0 : 1);
  return {adaptive_trial(block, answered, *state.next_level, number, stream)};
}

void LimitsProcedure::check(const Block& block) const {
  const LimitsRule rule = limits_rule_of(block);
  if (rule.levels.size() < 2) {
    throw core::Error("limits." + block.quantity + ": expected two levels or more, found one");
  }
  if (rule.scale == LevelScale::kLogarithmic && rule.levels.front() == 0.0) {
    throw core::Error("limits." + block.quantity +
                      ": expected levels > 0, as `level_scale` is `logarithmic`, found 0");
  }
  const int fewest = static_cast<int>(rule.levels.size()) - rule.max_start_offset;
  if (rule.num_changed_in_a_row >= fewest) {
    throw core::Error(
        "limits.num_changed_in_a_row: expected fewer than the levels of the shortest series (" +
        std::to_string(fewest) + "), found " + std::to_string(rule.num_changed_in_a_row));
  }
}

int LimitsProcedure::most_trials(const Block& block) const noexcept {
  return with_catch_trials(
      block, block.settings.integer("num_series") * static_cast<int>(block.intensities.size()));
}

int LimitsProcedure::expected_trials(const Block& block) const {
  // The answer is expected to change about half way.
  return with_catch_trials(
      block, block.settings.integer("num_series") *
                 std::max<int>(1, static_cast<int>(block.intensities.size()) / 2));
}

void LimitsProcedure::run(const Block& block, const std::vector<LevelTrial>& trials,
                          RuleOutcome& run) const {
  const Limits limits(limits_rule_of(block));
  std::vector<PlannedSeries> plan;
  std::vector<std::vector<LevelAnswer>> answers;
  for (int series = 1; series <= limits.rule().num_series; ++series) {
    const std::vector<LevelTrial> own = of_series(trials, series);
    if (own.empty()) break;
    plan.push_back(series_from(limits.rule(), own.front().answer.level));
    run.tracks.push_back(track_of(series, own));
    run.tracks.back().direction =
        plan.back().direction == SeriesDirection::kAscending ? "ascending" : "descending";
    answers.push_back(answers_of(own));
  }
  const LimitsState state = limits.after_series(plan, answers);
  for (std::size_t i = 0; i < state.series.size(); ++i) {
    run.tracks[i].threshold = state.series[i].transition;
    mark_after_end(run.tracks[i],
                   static_cast<int>(answers[i].size()) - state.series[i].num_trials);
  }
  const LimitsThreshold found = limits.threshold(state);
  run.is_logarithmic = limits.rule().scale == LevelScale::kLogarithmic;
  run.threshold = found.level;
  run.limits = {found.ascending, found.descending, found.constant_error, found.num_ascending,
                found.num_descending};
}

RuleWords LimitsProcedure::rule_words() const {
  return {.section = core::for_people(": method of limits"),
          .tracks = core::for_people("Series of the method of limits"),
          .caption = core::for_people(
              "A line is a series; the horizontal line is the mean of all transitions, whose "
              "value stands in the title"),
          .heading = core::for_people("Method of limits"),
          .method = core::for_people(
              "Levels rose or fell until the answer changed; a transition lies half way, in "
              "the scale of the levels, between the last level before and the first one "
              "after ({}). Thresholds are means of transitions. Rising less falling series: "
              "above 0 people stay with their answer (habituation), below 0 they change it "
              "early (expectation)."),
          .cited = {"Gescheider 1997"}};
}

}  // namespace jnd::experiments
