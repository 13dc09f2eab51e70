#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session_in_memory.h"
#include "experiments/session/trial_course.h"

// Tests "cannot tell", deadlines, and going back to stimuli, as a session stores them.

namespace jnd::experiments {
namespace answering_session_test {

const std::string kConstant = R"json("procedure": "constant_stimuli",
    "viscosity_pa_s": [4, 12, 16], "reference_viscosity_pa_s": 8, "repetitions": 3)json";
const std::string kStaircase = R"json("procedure": "staircase",
    "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16],
    "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.5, 1.2],
    "max_reversals": 6)json";
const std::string kOpen = kConstant + R"(, "cannot_tell": true)";
const std::string kTimed = kConstant + R"(, "answer_deadline_s": 3)";

class AnsweringSessionTest : public ::testing::Test {
 protected:
  Session session() {
    return Session({.session = 1, .seed = 42, .stages = {&study_.stages.front()}}, log_.events,
                   log_, clock_);
  }
  Session begun(const std::string& keys) {
    study_ = read_study_text(R"json({
      "format": 1, "name": "answers", "languages": ["en"], "title": {"en": "Answers"},
      "authors": ["A. Author"],
      "stages": [{"kind": "block", "name": "block", "medium": "viscous",
        "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
        "expected_trial_s": 5, )json" +
                                 keys + "}]}",
                             "study.json");
    Session s = session();
    s.start();
    s.enter_stage();
    return s;
  }
  static std::int64_t now(const Session& s) { return *s.state().current_trial(); }
  static void feel(Session& s) {
    s.start_trial(s.state().last_tick + 1);
    const TrialForm form = s.current_form();
    if (form.order_is_drawn) {
      present(s, "first");
      present(s, "second");
      if (form.num_intervals > 2) present(s, "third");
    } else {
      present(s, "reference");
      present(s, "test");
    }
  }
  static void answer(Session& s, const std::optional<double>& value) {
    s.answer(value, {.response_time_s = 1.5}, s.state().last_tick);
  }
  /// Runs a trial whose answer depends on the trial and its attempt alone. Every second trial
  /// is answered with "cannot tell", and every third misses the deadline once.
  static void run_trial(Session& s) {
    const std::int64_t trial = now(s);
    feel(s);
    const bool has_deadline = s.current_block().answer_deadline_s.has_value();
    if (has_deadline && trial % 3 == 0 && s.state().trial(trial).attempt == 1) {
      return s.miss_deadline();
    }
    answer(s, trial % 2 == 0 ? std::nullopt : std::optional(1.0));
  }

  Study study_;
  MemoryLog log_;
  core::SimulatedClock clock_;
};

TEST_F(AnsweringSessionTest, CannotTellIsAnAnswerWithItsTimeAndWithoutAResponse) {
  Session s = begun(kOpen);
  const std::int64_t trial = now(s);
  feel(s);
  answer(s, std::nullopt);
  EXPECT_NE(now(s), trial) << "it is answered";
  EXPECT_TRUE(s.state().trial(trial).is_answered);
  EXPECT_EQ(s.state().trial(trial).response, std::nullopt);
  ASSERT_EQ(log_.trials.size(), 1U);
  EXPECT_EQ(log_.trials[0].response, std::nullopt);
  EXPECT_EQ(log_.trials[0].measures.response_time_s, 1.5);
  EXPECT_EQ(log_.events.back().data, R"({"response":null,"response_time_s":1.5})");
  const std::vector<AnsweredTrial> answered = s.state().answered_in(0);
  ASSERT_EQ(answered.size(), 1U);
  EXPECT_EQ(answered[0].response, std::nullopt);
}

TEST_F(AnsweringSessionTest, CannotTellIsRefusedWhereTheBlockAsksForAChoice) {
  Session s = begun(kConstant);
  feel(s);
  const std::size_t before = log_.events.size();
  EXPECT_THROW(s.require_answer(std::nullopt), core::Error);
  EXPECT_THROW(answer(s, std::nullopt), core::Error);
  answer(s, 1.0);
  EXPECT_THROW(s.correct(1, std::nullopt, "misheard"), core::Error);
  EXPECT_EQ(log_.events.size(), before + 1) << "the answer alone";
}

TEST_F(AnsweringSessionTest, CannotTellIsTakenBackAndCorrectedLikeAnyAnswer) {
  Session s = begun(kOpen);
  const std::int64_t trial = now(s);
  feel(s);
  answer(s, std::nullopt);
  s.correct(trial, 1.0, "said yes");
  EXPECT_EQ(s.state().trial(trial).response, 1.0);
  s.correct(trial, std::nullopt, "did not");
  EXPECT_EQ(log_.trials.back().response, std::nullopt);
  EXPECT_TRUE(s.state().trial(trial).is_answered);
  s.undo("wrong key");
  EXPECT_FALSE(s.state().trial(trial).is_answered);
  EXPECT_EQ(now(s), trial);
}

TEST_F(AnsweringSessionTest, WhoCannotTellHasChosenNoneOfThreeIntervals) {
  Session s = begun(kOpen + R"(, "task": "oddity")");
  const std::int64_t trial = now(s);
  feel(s);
  answer(s, std::nullopt);
  EXPECT_EQ(log_.trials.back().measures.chosen_interval, std::nullopt);
  s.correct(trial, 2.0, "the second");
  EXPECT_EQ(s.state().trial(trial).measures.chosen_interval, 2);
  s.correct(trial, std::nullopt, "neither");
  EXPECT_EQ(s.state().trial(trial).measures.chosen_interval, std::nullopt);
  EXPECT_EQ(log_.trials.back().measures.chosen_interval, std::nullopt);
  EXPECT_EQ(session().state().trial(trial).measures.chosen_interval, std::nullopt)
      << "as the log has it";
}

TEST_F(AnsweringSessionTest, NothingIsCalledRightOrWrongWhereNobodyCouldTell) {
  Session s = begun(kOpen + R"(, "feedback": true)");
  feel(s);
  answer(s, std::nullopt);
  EXPECT_EQ(s.state().feedback_right, std::nullopt);
}

TEST_F(AnsweringSessionTest, AMissedDeadlineIsStoredAndItsTrialComesAgainLater) {
  Session s = begun(kTimed);
  const std::int64_t trial = now(s);
  feel(s);
  s.miss_deadline("; the answer was 1");
  EXPECT_EQ(log_.events.back().kind, "attempt_discarded");
  EXPECT_NE(log_.events.back().data.find(R"("missed_deadline":true)"), std::string::npos);
  EXPECT_NE(
      log_.events.back().data.find("no answer within the deadline of 3 s; the answer was 1"),
      std::string::npos);
  EXPECT_TRUE(log_.trials.empty()) << "it is no answer";
  EXPECT_NE(now(s), trial) << "not right after it was felt";
  EXPECT_TRUE(s.state().missed_deadline);
  EXPECT_TRUE(session().state().missed_deadline) << "as the log has it";
  bool came_again = false;
  while (s.state().current_trial()) {
    came_again |= now(s) == trial;
    feel(s);
    EXPECT_FALSE(s.state().missed_deadline) << "told until the next trial begins";
    answer(s, 1.0);
  }
  EXPECT_TRUE(came_again);
  EXPECT_EQ(s.state().trial(trial).attempt, 2);
  EXPECT_EQ(s.state().answered_in(0).size(), 9U);
}

TEST_F(AnsweringSessionTest, OfAProcedureThatAdaptsTheSameLevelIsAskedAgainAtOnce) {
  Session s = begun(kStaircase + R"(, "answer_deadline_s": 3)");
  const std::int64_t trial = now(s);
  const double level = *s.state().trial(trial).planned.intensity;
  feel(s);
  s.miss_deadline();
  EXPECT_EQ(now(s), trial);
  EXPECT_EQ(s.state().trial(trial).planned.intensity, level);
  EXPECT_EQ(s.state().trials.size(), 1U) << "nothing was drawn for it";
  feel(s);
  EXPECT_EQ(s.state().trial(trial).attempt, 2);
}

TEST_F(AnsweringSessionTest, WithoutADeadlineNoneIsMissed) {
  Session s = begun(kConstant);
  feel(s);
  EXPECT_THROW(s.miss_deadline(), core::Error);
  EXPECT_TRUE(s.state().trial(now(s)).under_way);
}

TEST_F(AnsweringSessionTest, CutAnywhereItGoesOnAsIfNothingHadHappened) {
  const std::string keys = kTimed + R"(, "cannot_tell": true)";
  Session whole = begun(keys);
  while (whole.state().current_trial()) run_trial(whole);
  const std::vector<core::EventRow> complete = log_.events;
  for (std::size_t cut = 2; cut < complete.size(); ++cut) {
    log_.events.assign(complete.begin(), complete.begin() + static_cast<std::ptrdiff_t>(cut));
    Session s = session();
    s.resume("repeat", 0, -1);
    while (s.state().current_trial()) run_trial(s);
    ASSERT_EQ(s.state().trials.size(), whole.state().trials.size()) << cut;
    for (std::int64_t trial = 1; trial <= std::ssize(s.state().trials); ++trial) {
      EXPECT_TRUE(s.state().trial(trial).is_answered) << cut;
      EXPECT_EQ(s.state().trial(trial).response, whole.state().trial(trial).response) << cut;
    }
  }
}

TEST_F(AnsweringSessionTest, NobodyGoesBackMoreOftenThanTheBlockAllows) {
  Session s = begun(kConstant + R"(, "max_returns": 1)");
  feel(s);
  present(s, "free_space");
  EXPECT_EQ(num_returns(s.state().trial(now(s))), 0) << "free space is no stimulus";
  s.require_interval("reference");
  present(s, "reference");
  EXPECT_EQ(num_returns(s.state().trial(now(s))), 1);
  const std::size_t before = log_.events.size();
  EXPECT_THROW(s.require_interval("test"), core::Error);
  EXPECT_THROW(s.begin_presentation("test", s.state().last_tick + 1), core::Error);
  EXPECT_EQ(log_.events.size(), before);
  present(s, "free_space");
  answer(s, 1.0);
  feel(s);  // Nothing of the next trial was felt.
  EXPECT_EQ(num_returns(s.state().trial(now(s))), 0);
}

TEST_F(AnsweringSessionTest, AnAttemptAnewAllowsAllReturnsAgain) {
  Session s = begun(kTimed + R"(, "max_returns": 0)");
  const std::int64_t trial = now(s);
  feel(s);
  EXPECT_THROW(s.require_interval("reference"), core::Error);
  s.miss_deadline();
  while (now(s) != trial) {
    feel(s);
    answer(s, 1.0);
  }
  s.require_interval("reference");
  feel(s);
  EXPECT_EQ(s.state().trial(trial).attempt, 2);
}

TEST_F(AnsweringSessionTest, OfThreeIntervalsAReturnIsToTheSamePlaceWhateverItHolds) {
  Session s = begun(kConstant + R"(, "task": "oddity", "max_returns": 0)");
  feel(s);  // Two of the three intervals are the reference.
  EXPECT_EQ(num_returns(s.state().trial(now(s))), 0);
  EXPECT_THROW(s.require_interval("second"), core::Error);
}

TEST_F(AnsweringSessionTest, TheQuestionIsAskedFromTheStartOfTheStimulusThatWasMissing) {
  Session s = begun(kConstant);
  s.start_trial(0);
  const auto asked = [&] { return asked_tick(s.current_form(), s.state().trial(now(s))); };
  EXPECT_EQ(asked(), std::nullopt);
  present(s, "reference");   // This takes the ticks 0 to 99.
  present(s, "free_space");  // This takes the ticks 100 to 199.
  present(s, "reference");
  EXPECT_EQ(asked(), std::nullopt) << "the test was not felt";
  s.begin_presentation("test", 300);
  EXPECT_EQ(asked(), 300) << "while it is being felt";
  s.end_presentation(399, {});
  present(s, "reference");
  present(s, "test");
  EXPECT_EQ(asked(), 300) << "whoever goes back gets no more time";
}

}  // namespace answering_session_test
}  // namespace jnd::experiments
