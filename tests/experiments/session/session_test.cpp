#include "experiments/session/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "experiments/session/event.h"
#include "experiments/session/session_in_memory.h"

namespace jnd::experiments {
namespace session_test {

Stage production_stage() {
  return {.name = "production",
          .content = Block{.procedure = "magnitude_production",
                           .medium = "water",
                           .quantity = "scale",
                           .intensities = {0.0, 0.25, 4.0},
                           .target_percent = {100.0},
                           .coarse_step = 0.5,
                           .fine_step = 0.1}};
}

Stage comparison_stage() {
  return {.name = "group_d",
          .content = Block{.procedure = "constant_stimuli",
                           .medium = "viscous",
                           .quantity = "viscosity_pa_s",
                           .intensities = {1.0, 2.0, 3.0, 4.0},
                           .reference_intensity = 2.5,
                           .repetitions = 2}};
}

class SessionTest : public ::testing::Test {
 protected:
  Session session(const std::vector<core::EventRow>& history = {}) {
    return Session({.session = 1, .seed = 42, .stages = stages_}, history, log_, clock_);
  }

  static void run_trial(Session& session, double response) {
    session.start_trial(session.state().last_tick + 1);
    if (session.current_form().has_reference) present(session, "reference");
    present(session, "test");
    session.answer(response, {.response_time_s = 1.5}, session.state().last_tick);
  }

  Stage checklist_{.name = "before", .content = Checklist{.items = {{}, {}}}};
  Stage comparison_ = comparison_stage();
  Stage production_ = production_stage();
  std::vector<const Stage*> stages_{&checklist_, &comparison_, &production_};
  MemoryLog log_;
  core::SimulatedClock clock_;
};

TEST_F(SessionTest, RunsEveryStageAndShowsEachStimulusOncePerRepetition) {
  Session s = session();
  s.start();
  s.enter_stage();
  s.answer_item("item_1", "done");
  s.finish_stage();
  s.enter_stage();
  std::map<double, int> shown;
  while (const auto trial = s.state().current_trial()) {
    ++shown[*s.state().trial(*trial).planned.intensity];
    run_trial(s, 1.0);
  }
  EXPECT_EQ(shown, (std::map<double, int>{{1.0, 2}, {2.0, 2}, {3.0, 2}, {4.0, 2}}));
  s.finish_stage();
  EXPECT_EQ(s.current_stage(), &production_);
}

TEST_F(SessionTest, APauseIsExplainedByAnEventOfItsOwnWhichMayNeverCome) {
  Session s = session();
  s.start();
  EXPECT_THROW(s.explain_pause("why"), core::Error) << "there is none";
  s.pause("");
  const std::int64_t pause = s.state().last_sequence;
  EXPECT_EQ(s.state().unexplained_pause, pause);
  s.explain_pause("a cough");
  EXPECT_EQ(s.state().unexplained_pause, 0);
  EXPECT_TRUE(s.state().paused) << "explained, it goes on";
  EXPECT_THROW(s.explain_pause("again"), core::Error);
  EXPECT_EQ(log_.events.back().data,
            R"({"pause_sequence":)" + std::to_string(pause) + R"(,"reason":"a cough"})");
  EXPECT_EQ(session(log_.events).state().unexplained_pause, 0);
  s.go_on();
  s.pause("lunch");
  EXPECT_THROW(s.explain_pause("tea"), core::Error) << "it has its reason";
  s.pause("");
  Session again = session(log_.events);
  again.resume("repeat", 0, -1);
  EXPECT_THROW(again.explain_pause("why"), core::Error) << "whoever knew it is gone";
}

TEST_F(SessionTest, AnExplanationOfAnotherPauseIsADamagedLog) {
  Session s = session();
  s.start();
  s.pause("");
  SessionState state = s.state();
  const Event wrong{.sequence = state.last_sequence + 1,
                    .data = PauseExplained{state.last_sequence - 1, "why"}};
  EXPECT_THROW(apply(state, wrong), core::Error);
}

TEST_F(SessionTest, WhatWouldBeRefusedCanBeAskedBeforeAndChangesNothing) {
  Session s = session();
  s.start();
  s.enter_stage();
  EXPECT_THROW(s.require_interval("test"), core::Error) << "no trial";
  s.finish_stage();
  s.enter_stage();
  EXPECT_THROW(s.require_undo(), core::Error) << "no answer";
  EXPECT_NO_THROW(s.require_interval("reference")) << "it waits";
  s.start_trial(0);
  s.begin_presentation("test", 0);
  const std::size_t num_events = log_.events.size();
  EXPECT_NO_THROW(s.require_answer(1.0)) << "the presentation can be ended for it";
  EXPECT_THROW(s.require_answer(0.5), core::Error);
  EXPECT_THROW(s.require_answer(std::nan("")), core::Error);
  EXPECT_THROW(s.require_interval("honey"), core::Error);
  EXPECT_EQ(log_.events.size(), num_events);
  s.end_presentation(99, {});
  s.answer(1.0, {.response_time_s = 1.0}, 99);
  EXPECT_NO_THROW(s.require_undo());
}

TEST_F(SessionTest, ReplayingTheLogGivesTheSameState) {
  Session s = session();
  s.start();
  s.enter_stage();
  s.finish_stage();
  s.enter_stage();
  run_trial(s, 1.0);
  s.note("magnet loose");
  run_trial(s, 0.0);
  s.undo("pressed the wrong key");
  s.start_trial(1000);
  const Session again = session(log_.events);
  EXPECT_EQ(again.state().last_sequence, s.state().last_sequence);
  EXPECT_EQ(again.state().current_trial(), 2);
  EXPECT_EQ(again.state().trial(2).attempt, 2);
  EXPECT_TRUE(again.state().trial(2).under_way);
  EXPECT_EQ(again.state().trial(1).response, 1.0);
  EXPECT_EQ(again.state().notes, std::vector<std::string>{"magnet loose"});
}

TEST_F(SessionTest, ResumedAtAnyEventItHasTheOrderOfAnUninterruptedOne) {
  Session whole = session();
  whole.start();
  whole.enter_stage();
  whole.finish_stage();
  whole.enter_stage();
  while (whole.state().current_trial()) run_trial(whole, 1.0);
  const std::vector<core::EventRow> complete = log_.events;
  const auto order = [](const Session& s) {
    std::vector<double> intensities;
    for (const TrialState& t : s.state().trials) intensities.push_back(*t.planned.intensity);
    return intensities;
  };
  for (std::size_t cut = 1; cut < complete.size(); ++cut) {
    log_.events.assign(complete.begin(), complete.begin() + static_cast<std::ptrdiff_t>(cut));
    Session s = session(log_.events);
    s.resume("repeat", 0, -1);
    while (s.state().stage < 2) {
      if (!s.state().stage_open) s.enter_stage();
      while (s.state().current_trial()) run_trial(s, 1.0);
      s.finish_stage();
    }
    EXPECT_EQ(order(s), order(whole)) << "interrupted after event " << cut;
    EXPECT_EQ(s.state().answered_in(1).size(), 8U);
  }
}

TEST_F(SessionTest, AnUndoneAnswerIsSupersededAndItsTrialRunAgain) {
  Session s = session();
  s.start();
  s.enter_stage();
  s.finish_stage();
  s.enter_stage();
  run_trial(s, 1.0);
  const std::int64_t answer = s.state().trial(1).answer_sequence;
  s.undo("misheard");
  EXPECT_EQ(log_.events.back().kind, "answer_undone");
  EXPECT_EQ(log_.events.back().supersedes, answer);
  EXPECT_EQ(s.state().current_trial(), 1);
  run_trial(s, 0.0);
  EXPECT_EQ(s.state().trial(1).attempt, 2);
  EXPECT_EQ(s.state().trial(1).response, 0.0);
}

TEST_F(SessionTest, UndoReachesBackThroughTheTrialUnderWayButNotIntoAnotherBlock) {
  Session s = session();
  s.start();
  s.enter_stage();
  s.finish_stage();
  s.enter_stage();
  run_trial(s, 1.0);
  s.start_trial(1000);
  s.undo("too fast");
  EXPECT_EQ(s.state().current_trial(), 1);
  while (s.state().current_trial()) run_trial(s, 1.0);
  s.finish_stage();
  s.enter_stage();
  EXPECT_THROW(s.undo("too late"), core::Error);
  s.correct(3, 0.0, "noted on paper");
  EXPECT_EQ(s.state().trial(3).response, 0.0);
  ASSERT_TRUE(log_.commits.back().trial.has_value());
  EXPECT_EQ(log_.commits.back().trial->block, "group_d");
}

/// Postpones the first trial of the block and answers the others. Returns the numbers of the
/// trials in the order in which they were run.
std::vector<std::int64_t> order_with_first_put_off(Session& s) {
  std::vector<std::int64_t> order;
  s.start_trial(s.state().last_tick + 1);
  s.put_off_attempt("came off: index");
  while (s.state().current_trial()) {
    order.push_back(*s.state().current_trial());
    s.start_trial(s.state().last_tick + 1);
    const std::int64_t tick = s.state().last_tick + 1;
    for (const char* interval : {"reference", "test"}) {
      s.begin_presentation(interval, tick);
      s.end_presentation(tick + 99, {});
    }
    s.answer(1.0, {.response_time_s = 1.5}, s.state().last_tick);
  }
  return order;
}

TEST_F(SessionTest, APutOffTrialComesAgainAtAnyLaterPlaceAlike) {
  stages_ = {&comparison_};
  // There are eight trials, so the postponed one has seven later places.
  std::vector<int> counts(7, 0);
  constexpr int kNumSessions = 700;
  for (std::uint64_t seed = 1; seed <= kNumSessions; ++seed) {
    log_ = {};
    Session s({.session = 1, .seed = seed, .stages = stages_}, {}, log_, clock_);
    s.start();
    s.enter_stage();
    std::vector<std::int64_t> order = order_with_first_put_off(s);
    const auto again = std::ranges::find(order, 1);
    ASSERT_NE(again, order.end());
    ASSERT_GT(again, order.begin()) << "not at once";
    ++counts[static_cast<std::size_t>(again - order.begin() - 1)];
    order.erase(again);
    ASSERT_EQ(order, (std::vector<std::int64_t>{2, 3, 4, 5, 6, 7, 8})) << "the others stay";
  }
  double chi_squared = 0.0;
  for (const int count : counts) chi_squared += (count - 100.0) * (count - 100.0) / 100.0;
  EXPECT_LT(chi_squared, 22.5) << "of 6 degrees of freedom, p = 0.001";
}

TEST_F(SessionTest, ResumedAtAnyEventAPutOffTrialKeepsItsPlace) {
  stages_ = {&comparison_};
  Session s = session();
  s.start();
  s.enter_stage();
  const std::vector<std::int64_t> order = order_with_first_put_off(s);
  const std::vector<core::EventRow> all = log_.events;
  const auto discarded = std::ranges::find(all, "attempt_discarded", &core::EventRow::kind);
  for (auto end = discarded + 1; end != all.end(); ++end) {
    Session again = session({all.begin(), end});
    const std::size_t num_answered = again.state().answered_in(0).size();
    ASSERT_EQ(again.state().current_trial(), order[num_answered]);
  }
}

TEST_F(SessionTest, ATrialIsPutOffAgainAndItsAnswerTakenBackLikeAnyOther) {
  stages_ = {&comparison_};
  Session s = session();
  s.start();
  s.enter_stage();
  for (int attempt = 0; attempt < 3; ++attempt) {
    while (*s.state().current_trial() != 1) run_trial(s, 1.0);
    s.start_trial(s.state().last_tick + 1);
    const std::vector<std::int64_t> later = s.state().trials_after_current();
    s.put_off_attempt("fault: stale_sample");
    // The last trial has no later place.
    EXPECT_EQ(*s.state().current_trial(), later.empty() ? 1 : later.front());
  }
  while (*s.state().current_trial() != 1) run_trial(s, 1.0);
  run_trial(s, 0.0);
  s.undo("misheard");
  EXPECT_EQ(s.state().current_trial(), 1);
  run_trial(s, 1.0);
  while (s.state().current_trial()) run_trial(s, 1.0);
  EXPECT_EQ(s.state().answered_in(0).size(), 8);
}

TEST_F(SessionTest, StepsLeaveTheStartingRangeUpwardsAndStopAtZero) {
  stages_ = {&production_};
  Session s = session();
  s.start();
  s.enter_stage();
  s.start_trial(0);
  const double start = *s.state().trial(1).planned.starting_intensity;
  for (int step = 0; step < 10; ++step) {
    EXPECT_TRUE(s.adjust(Direction::kRaise, StepSize::kCoarse));
  }
  EXPECT_DOUBLE_EQ(s.state().trial(1).set_intensity, start + 5.0);
  for (int step = 0; step < 200; ++step) (void)s.adjust(Direction::kLower, StepSize::kFine);
  EXPECT_GE(s.state().trial(1).set_intensity, 0.0);
  EXPECT_LT(s.state().trial(1).set_intensity, 0.1);
  const std::size_t before = log_.events.size();
  if (s.state().trial(1).set_intensity == 0.0) {
    EXPECT_FALSE(s.adjust(Direction::kLower, StepSize::kFine));
    EXPECT_EQ(log_.events.size(), before);
  }
  present(s, "test");
  s.answer(0.0, {.response_time_s = 1.0}, 100);
  EXPECT_DOUBLE_EQ(*log_.commits.back().trial->intensity, s.state().trial(1).set_intensity);
}

TEST_F(SessionTest, ARefusedCommitLeavesTheStateAsItWas) {
  Session s = session();
  s.start();
  s.enter_stage();
  log_.refuses = true;
  const std::int64_t before = s.state().last_sequence;
  EXPECT_THROW(s.answer_item("item_1", "done"), core::Error);
  EXPECT_EQ(s.state().last_sequence, before);
  EXPECT_TRUE(s.state().answers.empty());
  log_.refuses = false;
  s.answer_item("item_1", "done");
  EXPECT_EQ(s.state().answers.size(), 1U);
}

TEST_F(SessionTest, RefusesActsOutOfOrderAndStoresNothing) {
  Session s = session();
  s.start();
  const std::size_t before = log_.events.size();
  EXPECT_THROW(s.finish_stage(), core::Error);
  EXPECT_THROW(s.start_trial(0), core::Error);
  EXPECT_THROW(s.answer(1.0, {.response_time_s = 1.0}, 0), core::Error);
  EXPECT_THROW(s.begin_presentation("test", 0), core::Error);
  EXPECT_THROW(s.undo(""), core::Error);
  EXPECT_THROW(s.start(), core::Error);
  EXPECT_EQ(log_.events.size(), before);
}

TEST_F(SessionTest, TakesOnlyAnswersThatFitTheQuestion) {
  stages_ = {&comparison_};
  Session s = session();
  s.start();
  s.enter_stage();
  s.start_trial(0);
  EXPECT_THROW(s.answer(1.0, {.response_time_s = 1.0}, 0), core::Error)
      << "nothing was presented";
  present(s, "reference");
  present(s, "test");
  for (const double wrong : {0.5, -1.0, double{NAN}, double{INFINITY}}) {
    EXPECT_THROW(s.answer(wrong, {.response_time_s = 1.0}, 0), core::Error) << wrong;
  }
  s.answer(1.0, {.response_time_s = 1.0}, s.state().last_tick);
  EXPECT_EQ(s.state().trial(1).response, 1.0);
}

TEST_F(SessionTest, RestartingABlockKeepsItsOrderAndTakesEveryAnswerBack) {
  stages_ = {&comparison_};
  Session s = session();
  s.start();
  s.enter_stage();
  for (int trial = 0; trial < 5; ++trial) run_trial(s, 1.0);
  const std::vector<TrialState> before = s.state().trials;
  s.restart_block("the finger came loose");
  EXPECT_EQ(s.state().current_trial(), 1);
  EXPECT_TRUE(s.state().answered_in(0).empty());
  ASSERT_EQ(s.state().trials.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(s.state().trials[i].planned.intensity, before[i].planned.intensity);
  }
}

TEST_F(SessionTest, ExclusionIsReversibleAndNeedsATrial) {
  stages_ = {&comparison_};
  Session s = session();
  s.start();
  s.enter_stage();
  run_trial(s, 1.0);
  s.exclude(1, "talked to me");
  EXPECT_TRUE(s.state().trial(1).excluded);
  s.include(1, "it was before the trial");
  EXPECT_FALSE(s.state().trial(1).excluded);
  EXPECT_THROW(s.include(1, "again"), core::Error);
  EXPECT_THROW(s.exclude(99, "no such trial"), core::Error);
}

TEST_F(SessionTest, ReportsALogWithAHole) {
  Session s = session();
  s.start();
  s.enter_stage();
  s.answer_item("item_1", "done");
  std::vector<core::EventRow> damaged = log_.events;
  damaged.erase(damaged.begin() + 1);
  EXPECT_THROW(session(damaged), core::Error);
}

TEST_F(SessionTest, AHandThatWasExposedToAllThatIsAllowedBeginsNoTrial) {
  stages_ = {&comparison_};
  const auto begun = [this](const std::vector<core::EventRow>& history) {
    return Session(
        {.session = 1, .seed = 42, .stages = stages_, .limits = {.max_under_force_s = 10.0}},
        history, log_, clock_);
  };
  Session s = begun({});
  s.start();
  s.enter_stage();
  for (int i = 0; i < 2; ++i) {
    s.start_trial(s.state().last_tick + 1);
    present(s, "reference");
    const std::int64_t tick = s.state().last_tick + 1;
    s.begin_presentation("test", tick);
    s.end_presentation(
        tick + 99, {.exposure = core::Exposure{.force_time_n_s = 15.0, .under_force_s = 5.0}});
    s.answer(1.0, {.response_time_s = 1.5}, s.state().last_tick);
  }
  EXPECT_EQ(s.state().exposure.force_time_n_s, 30.0);
  EXPECT_THROW(s.start_trial(s.state().last_tick + 1), core::Error);
  Session again = begun(log_.events);
  EXPECT_EQ(again.state().exposure.under_force_s, 10.0) << "a new program does not forget";
  EXPECT_THROW(again.start_trial(again.state().last_tick + 1), core::Error);
}

}  // namespace session_test
}  // namespace jnd::experiments
