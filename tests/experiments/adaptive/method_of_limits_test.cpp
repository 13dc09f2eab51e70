#include "experiments/adaptive/method_of_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "core/error.h"

namespace jnd::experiments {
namespace method_of_limits_test {

constexpr SeriesDirection kUp = SeriesDirection::kAscending;
constexpr SeriesDirection kDown = SeriesDirection::kDescending;

LimitsRule six_levels() {
  return {.levels = {1, 2, 3, 4, 5, 6}, .num_series = 2, .order = SeriesOrder::kAscendingFirst};
}

std::vector<PlannedSeries> plan_of(const Limits& limits, std::uint64_t seed = 1) {
  core::RandomStream stream(seed, "limits_test");
  return limits.drawn_series(stream);
}

/// Returns the answers to the levels that are asked for, one letter each, "y" or "n".
std::vector<LevelAnswer> answers_for(const Limits& limits,
                                     const std::vector<PlannedSeries>& plan,
                                     const std::string& letters) {
  std::vector<LevelAnswer> answers;
  for (const char letter : letters) {
    answers.push_back({limits.after(plan, answers).next_level.value(), letter == 'y'});
  }
  return answers;
}

LimitsState state_for(const LimitsRule& rule, const std::string& letters) {
  const Limits limits(rule);
  const auto plan = plan_of(limits);
  return limits.after(plan, answers_for(limits, plan, letters));
}

TEST(Limits, IsWorkedByHand) {
  const Limits limits(six_levels());
  const auto plan = plan_of(limits);
  // Up: 1 no, 2 no, 3 no, 4 yes. Down: 6 yes, 5 yes, 4 yes, 3 yes, 2 no.
  const auto answers = answers_for(limits, plan, "nnnyyyyyn");
  std::vector<double> levels;
  for (const LevelAnswer& answer : answers) levels.push_back(answer.level);
  EXPECT_EQ(levels, (std::vector<double>{1, 2, 3, 4, 6, 5, 4, 3, 2}));
  const auto state = limits.after(plan, answers);
  EXPECT_TRUE(state.is_finished());
  ASSERT_EQ(state.series.size(), 2u);
  EXPECT_EQ(state.series[0].transition, 3.5);
  EXPECT_EQ(state.series[1].transition, 2.5);
  const auto threshold = limits.threshold(state);
  EXPECT_EQ(threshold.level, 3.0);
  EXPECT_EQ(threshold.ascending, 3.5);
  EXPECT_EQ(threshold.descending, 2.5);
  EXPECT_EQ(threshold.constant_error, 1.0);
  EXPECT_EQ(threshold.num_ascending, 1);
  EXPECT_EQ(threshold.num_descending, 1);
}

TEST(Limits, TakesRatiosInALogarithmicScale) {
  LimitsRule rule = six_levels();
  rule.levels = {1, 2, 4, 8, 16, 32};
  rule.scale = LevelScale::kLogarithmic;
  // The changes are from 2 to 4, and from 8 to 4.
  const auto state = state_for(rule, "nnyyyyyn");
  EXPECT_NEAR(state.series.at(0).transition.value(), std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(state.series.at(1).transition.value(), std::sqrt(8.0), 1e-12);
  const auto other = Limits(rule).threshold(state_for(rule, "nnnyyyyyn"));
  EXPECT_NEAR(other.level.value(), 4.0, 1e-12);  // This is the mean of sqrt 32 and sqrt 8.
  EXPECT_NEAR(other.constant_error.value(), std::log(2.0), 1e-12);
}

TEST(Limits, HasNoMidpointWhereTheAnswerDidNotChangeWithinTheSeries) {
  const auto at_start = state_for(six_levels(), "y");
  EXPECT_EQ(at_start.series.at(0).end, SeriesEnd::kChangedAtStart);
  EXPECT_FALSE(at_start.series.at(0).transition.has_value());
  EXPECT_EQ(at_start.next_level, 6.0);
  const auto never = state_for(six_levels(), "nnnnnnyn");
  EXPECT_EQ(never.series.at(0).end, SeriesEnd::kNeverChanged);
  EXPECT_EQ(never.series.at(0).num_trials, 6);
  const auto threshold = Limits(six_levels()).threshold(never);
  EXPECT_EQ(threshold.level, 5.5);
  EXPECT_FALSE(threshold.constant_error.has_value());
  EXPECT_EQ(threshold.num_ascending, 0);
  EXPECT_FALSE(Limits(six_levels()).threshold(at_start).level.has_value());
}

TEST(Limits, WaitsForTwoChangedAnswersInARowIfAsked) {
  LimitsRule rule = six_levels();
  rule.num_changed_in_a_row = 2;
  // The "yes" at 2 was a slip. 4 and 5 end the series, and the change was at 4.
  const auto state = state_for(rule, "nynyy");
  EXPECT_EQ(state.series.at(0).transition, 3.5);
  EXPECT_EQ(state.series.at(0).num_trials, 5);
  EXPECT_EQ(state_for(rule, "nnnnny").series.at(0).end, SeriesEnd::kNeverChanged);
  EXPECT_EQ(state_for(rule, "yy").series.at(0).end, SeriesEnd::kChangedAtStart);
  // A slip at the start does not end the series.
  EXPECT_EQ(state_for(rule, "ynyy").series.at(0).transition, 2.5);
}

TEST(Limits, TakesNoForTheAnswerToHighLevelsIfAsked) {
  LimitsRule rule = six_levels();
  rule.yes_is_above = false;
  const auto state = state_for(rule, "yyynnny");
  EXPECT_EQ(state.series.at(0).transition, 3.5);
  EXPECT_EQ(state.series.at(1).transition, 4.5);
}

TEST(Limits, TakesTheLevelsThatWerePresented) {
  const Limits limits(six_levels());
  const auto state = limits.after(plan_of(limits), {{1.0, false}, {2.2, false}, {2.8, true}});
  EXPECT_EQ(state.series.at(0).transition, 2.5);
}

TEST(Limits, ForgetsAnAnswerThatIsTakenBack) {
  const Limits limits(six_levels());
  const auto plan = plan_of(limits);
  auto answers = answers_for(limits, plan, "nnny");
  EXPECT_EQ(limits.after(plan, answers).next_level, 6.0);
  answers.pop_back();
  EXPECT_EQ(limits.after(plan, answers).next_level, 4.0);
  EXPECT_EQ(limits.after(plan, answers).series.at(0).end, SeriesEnd::kRunning);
}

TEST(Limits, AlternatesOrShufflesItsDirections) {
  LimitsRule rule = six_levels();
  rule.num_series = 8;
  const auto directions = [&](std::uint64_t seed) {
    std::string letters;
    for (const PlannedSeries& series : plan_of(Limits(rule), seed)) {
      letters += series.direction == kUp ? 'a' : 'd';
    }
    return letters;
  };
  EXPECT_EQ(directions(1), "adadadad");
  rule.order = SeriesOrder::kDescendingFirst;
  EXPECT_EQ(directions(1), "dadadada");
  rule.order = SeriesOrder::kDrawnFirst;
  std::set<std::string> seen;
  for (int seed = 0; seed < 30; ++seed) seen.insert(directions(seed));
  EXPECT_EQ(seen, (std::set<std::string>{"adadadad", "dadadada"}));
  rule.order = SeriesOrder::kShuffled;
  seen.clear();
  for (int seed = 0; seed < 2000; ++seed) {
    seen.insert(directions(seed));
    const std::string letters = directions(seed);
    EXPECT_EQ(std::count(letters.begin(), letters.end(), 'a'), 4);
  }
  EXPECT_EQ(seen.size(), 70u);  // There are 8 over 4 orders.
}

TEST(Limits, DrawsWhereASeriesStarts) {
  LimitsRule rule = six_levels();
  rule.num_series = 400;
  rule.max_start_offset = 2;
  std::map<std::pair<SeriesDirection, std::size_t>, int> starts;
  const auto plan = plan_of(Limits(rule));
  for (const PlannedSeries& series : plan) ++starts[{series.direction, series.start}];
  ASSERT_EQ(starts.size(), 6u);
  for (const std::size_t offset : {0, 1, 2}) {
    EXPECT_NEAR((starts[{kUp, offset}]), 67, 30) << offset;
    EXPECT_NEAR((starts[{kDown, 5 - offset}]), 67, 30) << offset;
  }
  EXPECT_EQ(plan, plan_of(Limits(rule)));
  EXPECT_NE(plan, plan_of(Limits(rule), 2));
  // A series that starts further in has fewer levels.
  const auto state = Limits(rule).after({{kDown, 1}}, {{2.0, true}, {1.0, true}});
  EXPECT_EQ(state.series.at(0).end, SeriesEnd::kNeverChanged);
}

TEST(Limits, RecoversTheThresholdOfASimulatedObserverAndItsHabituation) {
  LimitsRule rule = six_levels();
  rule.levels.clear();
  for (int i = 0; i <= 40; ++i) rule.levels.push_back(0.5 * i);
  rule.num_series = 400;
  rule.max_start_offset = 5;
  const Limits limits(rule);
  const auto plan = plan_of(limits);
  core::RandomStream observer(3, "observer");
  std::vector<LevelAnswer> answers;
  for (auto state = limits.after(plan, {}); !state.is_finished();
       state = limits.after(plan, answers)) {
    // The observer's threshold is 10. The observer keeps an answer for 1 unit longer, in either
    // direction.
    const bool rising =
        plan[state.series.size() - (state.series.empty() ? 0 : 1)].direction == kUp;
    answers.push_back({*state.next_level, *state.next_level > 10.0 + (rising ? 1.0 : -1.0) +
                                                                  observer.normal(0.0, 0.2)});
  }
  const auto threshold = limits.threshold(limits.after(plan, answers));
  EXPECT_NEAR(threshold.level.value(), 10.0, 0.05);
  EXPECT_NEAR(threshold.constant_error.value(), 2.0, 0.2);
}

TEST(Limits, RefusesARuleThatCannotRun) {
  const auto refused = [](const std::function<void(LimitsRule&)>& spoil) {
    LimitsRule rule = six_levels();
    spoil(rule);
    EXPECT_THROW(Limits{rule}, core::Error);
  };
  refused([](auto& r) { r.levels = {1}; });
  refused([](auto& r) { r.levels = {1, 1}; });
  refused([](auto& r) { r.levels = {2, 1}; });
  refused([](auto& r) { r.levels = {1, std::numeric_limits<double>::quiet_NaN()}; });
  refused([](auto& r) { r.levels[0] = 0.0, r.scale = LevelScale::kLogarithmic; });
  refused([](auto& r) { r.num_series = 0; });
  refused([](auto& r) { r.max_start_offset = -1; });
  refused([](auto& r) { r.max_start_offset = 5; });
  refused([](auto& r) { r.num_changed_in_a_row = 0; });
  refused([](auto& r) { r.num_changed_in_a_row = 6; });
  refused([](auto& r) { r.num_changed_in_a_row = 2, r.max_start_offset = 4; });
  const Limits limits(six_levels());
  EXPECT_THROW((void)limits.after({{kUp, 6}}, {}), core::Error);
  EXPECT_THROW((void)limits.after({{kUp, 5}}, {{6, true}, {5, true}}), core::Error);
  EXPECT_THROW((void)limits.after({{kUp, 0}}, {{std::nan(""), true}}), core::Error);
}

}  // namespace method_of_limits_test
}  // namespace jnd::experiments
