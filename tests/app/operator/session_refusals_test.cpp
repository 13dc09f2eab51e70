#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/operator/operated_session_fixture.h"

namespace jnd::app {
namespace session_refusals_test {

using experiments::Direction;

/// Tests that a refused request leaves the session as it was.
class SessionRefusalsTest : public OperatedSessionTest {
 protected:
  /// Tries each request, and compares the step, the events and the active medium before and
  /// after it.
  void refuse_all(const std::vector<std::pair<std::string, OperatorRequest>>& requests) {
    for (const auto& [name, request] : requests) {
      const SessionView before = view();
      const std::vector<std::string> events_before = kinds();
      const SessionView after = act(request);
      EXPECT_EQ(after.num_refusals, before.num_refusals + 1) << name;
      EXPECT_EQ(after.step, before.step) << name << ": " << after.refusal;
      EXPECT_EQ(kinds(), events_before) << name << ": " << after.refusal;
      EXPECT_EQ(after.telemetry.command_sequence, before.telemetry.command_sequence)
          << name << ": the medium";
      if (!before.trial) continue;
      EXPECT_EQ(after.trial->interval, before.trial->interval) << name;
      EXPECT_NEAR(after.trial->felt_s, before.trial->felt_s + 0.01, 1e-9) << name;
    }
  }

  [[nodiscard]] double strongest_force_n(double duration_s) {
    double strongest_n = 0.0;
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += 0.02) {
      pass(0.02);
      const core::PlainVector& force = view().telemetry.total_force_n;
      strongest_n = std::max(strongest_n, std::hypot(force[0], force[1], force[2]));
    }
    return strongest_n;
  }
};

TEST_F(SessionRefusalsTest, NoneEndsThePresentationUnderWay) {
  open();
  const SessionView ready = run_to_block("comparison");
  const std::int64_t trial = ready.trial->trial;
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  act(operate::Present{trial, "reference"});
  pass(0.5);
  refuse_all({{"answer before the test", operate::Answer{trial, 1.0}},
              {"undo without an answer", operate::Undo{"wrong key"}}});
  act(operate::Present{trial, "test"});
  pass(0.5);
  refuse_all({{"begin", operate::Begin{}},
              {"item", operate::AnswerItem{ready.stage, "consent", "given"}},
              {"item of another stage", operate::AnswerItem{0, "item_1", "done"}},
              {"feel a medium", operate::FeelMedium{}},
              {"finish a medium", operate::FinishMedium{}},
              {"finish the stage", operate::FinishStage{ready.stage, ""}},
              {"present for another trial", operate::Present{trial + 1, "reference"}},
              {"present something else", operate::Present{trial, "honey"}},
              {"neither yes nor no", operate::Answer{trial, 0.5}},
              {"no number", operate::Answer{trial, kNotANumber}},
              {"answer for another trial", operate::Answer{trial + 1, 1.0}},
              {"adjust", operate::Adjust{.trial = trial}},
              {"undo without an answer", operate::Undo{"wrong key"}},
              {"undo without a reason", operate::Undo{""}},
              {"correct nothing", operate::Correct{999, 1.0, "misheard"}},
              {"correct to no number", operate::Correct{1, kNotANumber, "misheard"}},
              {"correct without a reason", operate::Correct{1, 100.0, ""}},
              {"note without words", operate::AddNote{" "}},
              {"go on", operate::GoOn{}},
              {"go on without", operate::GoOnWithout{1, "sore"}},
              {"arm", operate::Rearm{}},
              {"end without a reason", operate::EndEarly{""}}});
  EXPECT_GT(strongest_force_n(1.0), 0.5) << "it is still being felt";
  const double felt_s = view().trial->felt_s;
  act(operate::Answer{trial, 1.0});
  const core::TrialRow row = store_->trials(session_number_).back();
  EXPECT_EQ(row.trial, trial);
  EXPECT_EQ(row.attempt, 1);
  EXPECT_NEAR(row.measures.response_time_s.value(), felt_s, 0.02);
}

TEST_F(SessionRefusalsTest, NoneTakesTheMediumOutsideOfTrialsAway) {
  open(replaced(kTinyStudy, R"({"medium": "free_space", "duration_s": 0.5})",
                R"({"medium": "viscous", "viscosity_pa_s": 8, "duration_s": 5})"));
  act(operate::Begin{});
  while (view().step != Step::kMedium) step_on(view());
  act(operate::FeelMedium{});
  pass(0.5);
  refuse_all({{"undo", operate::Undo{"wrong key"}},
              {"answer", operate::Answer{1, 1.0}},
              {"present", operate::Present{1, "test"}},
              {"feel it again", operate::FeelMedium{}},
              {"finish the stage", operate::FinishStage{view().stage, ""}},
              {"go on", operate::GoOn{}}});
  EXPECT_GT(strongest_force_n(1.0), 0.5) << "it is still being felt";
  act(operate::FinishMedium{});
  EXPECT_EQ(std::ranges::count(kinds(), "medium_explored"), 1);
}

TEST_F(SessionRefusalsTest, NoneLeavesAProductionWithoutItsFluid) {
  open();
  const std::int64_t trial = run_to_block("production").trial->trial;
  act(operate::Present{trial, "test"});
  for (int i = 0; i < 30 && view().refusal.empty(); ++i) {
    pass(0.1);
    act(operate::Adjust{.trial = trial, .direction = Direction::kLower});
  }
  ASSERT_EQ(view().refusal, "it cannot go lower");
  refuse_all({{"lower still", operate::Adjust{.trial = trial, .direction = Direction::kLower}},
              {"a reference", operate::Present{trial, "reference"}}});
  EXPECT_EQ(view().step, Step::kPresenting);
}

TEST_F(SessionRefusalsTest, AfterAPauseTheReferenceOfTheAttemptBeforeDoesNotCount) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  act(operate::Pause{"a cough"});
  act(operate::GoOn{});
  EXPECT_EQ(act(operate::Present{trial, "test"}).refusal, "the reference comes first");
}

TEST_F(SessionRefusalsTest, NothingGoesOnBeforeTheSessionHasBegun) {
  open();
  run_to_block("comparison");
  act(operate::Leave{});
  reopen();
  const std::size_t num_events = kinds().size();
  EXPECT_EQ(act(operate::GoOn{}).refusal, "the session has not begun yet");
  EXPECT_EQ(kinds().size(), num_events);
}

}  // namespace session_refusals_test
}  // namespace jnd::app
