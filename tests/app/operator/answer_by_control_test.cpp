#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "app/operator/operated_session_fixture.h"
#include "app/operator/realtime_session_fixture.h"
#include "app/task_study.h"

namespace jnd::app {
namespace answer_by_control_test {

const std::string kPedal = "0c45:7403 FootSwitch/KEY_B";

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

operate::UseControl pressed(const std::string& action, std::int64_t at_ns = 0) {
  return {.action = action, .control = kPedal, .pressed_ns = at_ns};
}

/// Returns the study with blocks that the participant answers.
std::string answered_by_participant(std::string study) {
  const std::string procedure = "\"procedure\":";
  for (std::size_t at = study.find(procedure); at != std::string::npos;
       at = study.find(procedure, at + 60)) {
    study.insert(at, "\"answered_by\": \"participant\", ");
  }
  return study;
}

class AnswerByControlTest : public OperatedSessionTest {
 protected:
  [[nodiscard]] core::TrialRow last_row() const {
    const std::vector<core::TrialRow> rows = store_->trials(session_number_);
    return rows.empty() ? core::TrialRow{} : rows.back();
  }
  [[nodiscard]] std::size_t num_rows() const { return store_->trials(session_number_).size(); }
};

TEST_F(AnswerByControlTest, AWholeTrialIsRunByPedals) {
  open(answered_by_participant(kTinyStudy));
  SessionView now = run_to_block("comparison");
  EXPECT_TRUE(now.participant_answers);
  const std::size_t before = num_rows();
  now = act(pressed("present"));
  EXPECT_EQ(now.trial->interval, "reference");
  pass(0.5);
  act(pressed("yes"));
  EXPECT_EQ(num_rows(), before) << "the test was not felt yet";
  now = act(pressed("present"));
  pass(0.1);
  EXPECT_EQ(view().trial->interval, "test");
  EXPECT_EQ(view().sentence, "The participant answers:");
  pass(0.5);
  act(pressed("present"));
  EXPECT_EQ(view().trial->interval, "test") << "nothing is left to be presented";
  act(pressed("third"));
  EXPECT_EQ(num_rows(), before) << "no answer of this block";
  act(pressed("second"));
  ASSERT_EQ(num_rows(), before + 1);
  EXPECT_EQ(last_row().response, 0.0) << "of two pedals the second is no";
  EXPECT_EQ(last_row().measures.answered_by, "participant");
  EXPECT_EQ(last_row().measures.control, kPedal);
}

TEST_F(AnswerByControlTest, WhoEntersAnAnswerInTheWindowIsStored) {
  open(answered_by_participant(kTinyStudy));
  answer_trial(run_to_block("comparison"), 1.0);
  EXPECT_EQ(last_row().measures.answered_by, "experimenter");
  EXPECT_EQ(last_row().measures.control, "");
  EXPECT_FALSE(last_row().measures.control_monotonic_s);
}

TEST_F(AnswerByControlTest, APedalOfTheExperimentersIsTheExperimenters) {
  open();
  const SessionView now = run_to_block("comparison");
  EXPECT_FALSE(now.participant_answers);
  act(pressed("present"));
  pass(0.5);
  act(pressed("present"));
  pass(0.5);
  act(pressed("first"));
  EXPECT_EQ(last_row().response, 1.0);
  EXPECT_EQ(last_row().measures.answered_by, "experimenter");
  EXPECT_EQ(last_row().measures.control, kPedal);
}

TEST_F(AnswerByControlTest, IntervalsAreChosenAndAdjustmentsMade) {
  open(answered_by_participant(kTaskStudy));
  run_to_block("which");
  const std::size_t before = num_rows();
  for (int i = 0; i < 2; ++i) {
    act(pressed("present"));
    pass(0.6);
  }
  act(pressed("second"));
  ASSERT_EQ(num_rows(), before + 1);
  const core::TrialRow row = last_row();
  EXPECT_EQ(row.response, row.test_interval == 2 ? 1.0 : 0.0);

  session_.reset();
  store_.reset();
  folder_ = temporary_.path() / "b.study";
  open(answered_by_participant(kTinyStudy));
  run_to_block("production");
  act(pressed("present"));
  pass(0.5);
  act(pressed("raise"));
  pass(0.5);
  act(pressed("lower_fine"));
  pass(0.5);
  act(pressed("matches"));
  EXPECT_EQ(last_row().procedure, "magnitude_production");
  EXPECT_EQ(last_row().num_steps, 2);
  EXPECT_EQ(last_row().measures.answered_by, "participant");
}

// A resting foot may press while nothing is asked. Nothing happens then, and no message
// appears.
TEST_F(AnswerByControlTest, APressThatNothingWaitsForIsNoRequest) {
  open(answered_by_participant(kTinyStudy));
  for (const char* action : {"yes", "present", "matches", "step_3", "raise", "cannot_tell"}) {
    EXPECT_EQ(act(pressed(action)).num_refusals, 0U) << action;
  }
  run_to_block("comparison");
  const std::size_t num_events = store_->events(session_number_).size();
  for (const char* action : {"yes", "no", "first", "matches", "step_10", "lower"}) {
    EXPECT_EQ(act(pressed(action)).num_refusals, 0U) << action;
  }
  act(operate::Pause{"why"});
  act(pressed("present"));
  EXPECT_EQ(store_->events(session_number_).size(), num_events + 1) << "the pause";
}

TEST_F(AnswerByControlTest, APressWithinTheRampWaitsForItsEnd) {
  open(answered_by_participant(kTinyStudy));
  run_to_block("comparison");
  act(pressed("present"));
  pass(0.5);
  session_->request(pressed("present"));
  session_->advance(0.002);
  session_->request(pressed("yes"));
  session_->advance(0.002);
  const std::size_t before = num_rows();
  pass(0.2);
  EXPECT_EQ(num_rows(), before + 1);
}

/// Runs the same in real time, where a press has a time of its own.
class PressTimeTest : public RealtimeSessionTest {
 protected:
  SessionView to_ready() {
    return until([&](const SessionView& now) {
      if (now.step == Step::kItem) {
        session_->request(operate::AnswerItem{now.stage, now.item->name, "1.8"});
      } else if (now.step == Step::kMedium) {
        session_->request(operate::FeelMedium{});
      } else if (now.step == Step::kFeeling) {
        session_->request(operate::FinishMedium{});
      } else if (now.step == Step::kStageDone) {
        session_->request(operate::FinishStage{now.stage, ""});
      }
      return now.step == Step::kReady;
    });
  }
};

const std::string kYesNoStudy = R"json({
  "format": 1, "name": "there", "languages": ["en"], "title": {"en": "There"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.02},
  "stages": [
    {"kind": "block", "name": "there", "procedure": "constant_stimuli", "task": "yes_no",
     "answered_by": "participant",
     "medium": "viscous", "viscosity_pa_s": [0.5, 2], "repetitions": 30,
     "instruction": {"en": "Feel."}, "question": {"en": "Anything?"}, "expected_trial_s": 5}]
})json";

// The session may look at the pedal late, but stores when the pedal was pressed. The difference
// of response times comes from two clocks, which are one here, and from a tick of the loop.
TEST_F(PressTimeTest, TheTimeOfAnAnswerIsThatOfItsPress) {
  open_window();
  open(kYesNoStudy);
  session_->request(operate::Begin{});
  constexpr int kNumAnswers = 30;
  std::vector<double> stored_ms, response_ms;
  for (int i = 0; i < kNumAnswers; ++i) {
    const std::int64_t trial = to_ready().trial->trial;
    session_->request(operate::Present{trial, "test"});
    until([](const SessionView& now) { return now.trial && now.trial->felt_s > 0.05; });
    const std::int64_t press_ns = now_ns();
    const double felt_s = view().trial->felt_s;
    // Meanwhile the session is busy for up to 30 ms.
    std::this_thread::sleep_for(std::chrono::milliseconds(i));
    session_->request(pressed(i % 2 == 0 ? "yes" : "no", press_ns));
    until([&](const SessionView& now) {
      return now.answers.size() == static_cast<std::size_t>(i) + 1;
    });
    const core::TrialRow row = store_->trials(session_number_).back();
    ASSERT_TRUE(row.measures.control_monotonic_s && row.measures.response_time_s);
    stored_ms.push_back(std::abs(1e3 * *row.measures.control_monotonic_s -
                                 1e-6 * static_cast<double>(press_ns)));
    response_ms.push_back(std::abs(1e3 * (*row.measures.response_time_s - felt_s)));
  }
  std::ranges::sort(stored_ms);
  std::ranges::sort(response_ms);
  EXPECT_LT(stored_ms.back(), 0.001) << "the kernel's time, to the digits of a double";
  // `felt_s` counts whole ticks, and on a busy machine the loop may be late.
  EXPECT_LT(response_ms[kNumAnswers / 2], 2.0);
  RecordProperty("response_time_off_ms_p50", std::to_string(response_ms[kNumAnswers / 2]));
  RecordProperty("response_time_off_ms_max", std::to_string(response_ms.back()));
}

TEST_F(PressTimeTest, APressBeforeTheStimulusIsNoAnswerToIt) {
  open_window();
  open(kYesNoStudy);
  session_->request(operate::Begin{});
  const std::int64_t trial = to_ready().trial->trial;
  // The press comes well before the stimulus, because on a busy machine the loop and its time
  // are some ticks late.
  const std::int64_t before_ns = now_ns() - 200'000'000;
  session_->request(operate::Present{trial, "test"});
  until([](const SessionView& now) { return now.trial && now.trial->felt_s > 0.1; });
  session_->request(pressed("yes", before_ns));
  until([](const SessionView& now) { return now.trial && now.trial->felt_s > 0.2; });
  EXPECT_TRUE(store_->trials(session_number_).empty());
  session_->request(pressed("yes", now_ns()));
  until([](const SessionView& now) { return now.answers.size() == 1; });
}

TEST_F(PressTimeTest, AnEarlyPressIsRefusedThoughItIsLookedAtLate) {
  open_window();
  open(replaced(kYesNoStudy, "\"repetitions\"", "\"min_stimulus_s\": 0.3, \"repetitions\""));
  session_->request(operate::Begin{});
  const std::int64_t trial = to_ready().trial->trial;
  session_->request(operate::Present{trial, "test"});
  until([](const SessionView& now) { return now.trial && now.trial->felt_s > 0.1; });
  const std::int64_t early_ns = now_ns();
  until([](const SessionView& now) { return now.trial && now.trial->felt_s > 0.35; });
  session_->request(pressed("yes", early_ns));
  const SessionView refused =
      until([](const SessionView& now) { return now.num_refusals == 1; });
  EXPECT_NE(refused.refusal.find("it has to be felt for"), std::string::npos);
  EXPECT_TRUE(store_->trials(session_number_).empty());
}

}  // namespace answer_by_control_test
}  // namespace jnd::app
