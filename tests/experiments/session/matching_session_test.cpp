#include <gtest/gtest.h>

#include "experiments/session/session_in_memory.h"

namespace jnd::experiments {
namespace matching_session_test {

class MatchingSession : public ::testing::Test {
 protected:
  Session session(const std::vector<core::EventRow>& history = {}) {
    return Session({.session = 1, .seed = 42, .stages = {&stage_}}, history, log_, clock_);
  }

  /// Presents the standard and the comparison, makes one step up, presents the standard and the
  /// comparison again, and says that they match.
  static void match(Session& session) {
    session.start_trial(session.state().last_tick + 1);
    present(session, "reference");
    present(session, "test");
    EXPECT_TRUE(session.adjust(Direction::kRaise, StepSize::kCoarse));
    present(session, "reference");
    present(session, "test");
    session.answer(0.0, {.response_time_s = 1.5}, session.state().last_tick);
  }

  const core::TrialRow& last_trial_row() const {
    for (auto commit = log_.commits.rbegin(); commit != log_.commits.rend(); ++commit) {
      if (commit->trial) return *commit->trial;
    }
    throw std::logic_error("no trial was answered");
  }

  Stage stage_{.name = "match",
               .content = Block{.procedure = "matching",
                                .medium = "viscous",
                                .quantity = "viscosity_pa_s",
                                .intensities = {1.0, 5.0},
                                .standard_medium = "water",
                                .standards = {2.0, 4.0},
                                .coarse_step = 0.5,
                                .fine_step = 0.1,
                                .max_intensity = 6.0}};
  MemoryLog log_;
  core::SimulatedClock clock_;
};

TEST_F(MatchingSession, StoresStandardStartAndMatch) {
  Session s = session();
  s.start();
  s.enter_stage();
  const PlannedTrial planned = s.state().trial(1).planned;
  match(s);
  const core::TrialRow& row = last_trial_row();
  EXPECT_EQ(row.procedure, "matching");
  EXPECT_EQ(row.medium, "viscous");
  EXPECT_EQ(row.quantity, "viscosity_pa_s");
  EXPECT_EQ(row.reference_intensity, planned.reference_intensity);
  EXPECT_EQ(row.starting_intensity, planned.starting_intensity);
  EXPECT_EQ(row.response, *planned.starting_intensity + 0.5);
  EXPECT_EQ(row.intensity, row.response);
  EXPECT_EQ(row.num_steps, 1);
  EXPECT_EQ(row.num_presentations, 4);
}

TEST_F(MatchingSession, GoesBackAndForthBetweenStandardAndWhatWasSet) {
  Session s = session();
  s.start();
  s.enter_stage();
  const PlannedTrial planned = s.state().trial(1).planned;
  match(s);
  std::vector<std::pair<std::string, double>> felt;
  for (const core::Commit& commit : log_.commits) {
    if (commit.presentation) {
      felt.emplace_back(commit.presentation->interval, commit.presentation->intensity);
    }
  }
  const double standard = *planned.reference_intensity, start = *planned.starting_intensity;
  EXPECT_EQ(felt, (std::vector<std::pair<std::string, double>>{{"reference", standard},
                                                               {"test", start},
                                                               {"reference", standard},
                                                               {"test", start + 0.5}}));
}

TEST_F(MatchingSession, UndoneATrialBeginsAgainAtItsStartingValue) {
  Session s = session();
  s.start();
  s.enter_stage();
  const double start = *s.state().trial(1).planned.starting_intensity;
  match(s);
  s.undo("pressed by mistake");
  EXPECT_EQ(s.state().current_trial(), 1);
  match(s);
  EXPECT_EQ(last_trial_row().attempt, 2);
  EXPECT_EQ(last_trial_row().response, start + 0.5);
}

TEST_F(MatchingSession, RestartedABlockKeepsItsOrder) {
  Session s = session();
  s.start();
  s.enter_stage();
  const auto planned = s.state().trials;
  match(s);
  match(s);
  s.restart_block("the hand was put back");
  EXPECT_EQ(s.state().current_trial(), 1);
  ASSERT_EQ(s.state().trials.size(), planned.size());
  for (std::size_t i = 0; i < planned.size(); ++i) {
    EXPECT_EQ(s.state().trials[i].planned.reference_intensity,
              planned[i].planned.reference_intensity);
    EXPECT_FALSE(s.state().trials[i].response);
  }
}

TEST_F(MatchingSession, ResumedAfterAnyEventItEndsWithTheSameTrials) {
  const auto finish = [&](Session& s) {
    while (s.state().current_trial()) match(s);
  };
  Session whole = session();
  whole.start();
  whole.enter_stage();
  finish(whole);
  const std::vector<core::EventRow> complete = log_.events;
  for (std::size_t num_events = 3; num_events < complete.size(); num_events += 4) {
    const std::vector<core::EventRow> begun(
        complete.begin(), complete.begin() + static_cast<std::ptrdiff_t>(num_events));
    Session again = session(begun);
    again.resume("repeat", 0, 0);
    finish(again);
    ASSERT_EQ(again.state().trials.size(), whole.state().trials.size());
    for (std::size_t i = 0; i < whole.state().trials.size(); ++i) {
      EXPECT_EQ(again.state().trials[i].response, whole.state().trials[i].response)
          << "resumed after event " << num_events;
    }
  }
}

TEST_F(MatchingSession, StepsEndAtTheBlocksEnd) {
  Session s = session();
  s.start();
  s.enter_stage();
  s.start_trial(0);
  present(s, "reference");
  present(s, "test");
  int num_steps = 0;
  while (s.adjust(Direction::kRaise, StepSize::kCoarse)) ++num_steps;
  EXPECT_EQ(s.state().trial(1).set_intensity, 6.0);
  EXPECT_GT(num_steps, 0);
}

}  // namespace matching_session_test
}  // namespace jnd::experiments
