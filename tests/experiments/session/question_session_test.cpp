#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session_in_memory.h"
#include "experiments/study/question_answer.h"

// Tests questions that follow the answer to every trial of a block.

namespace jnd::experiments {
namespace question_session_test {

constexpr char kStudy[] = R"json({
  "format": 1, "name": "asked", "languages": ["en"], "title": {"en": "Asked"},
  "authors": ["A. Author"],
  "stages": [{"kind": "block", "name": "block", "procedure": "rating", "medium": "viscous",
    "viscosity_pa_s": [1, 2, 4], "repetitions": 1, "num_steps": 7,
    "low_label": {"en": "thin"}, "high_label": {"en": "thick"},
    "questions": [
      {"name": "confidence", "kind": "scale", "num_steps": 5, "question": {"en": "Sure?"},
       "low_label": {"en": "no"}, "high_label": {"en": "yes"}},
      {"name": "remark", "kind": "text", "required": false, "question": {"en": "Else?"}}],
    "instruction": {"en": "Feel."}, "question": {"en": "How thick?"},
    "expected_trial_s": 5}]})json";

class QuestionSessionTest : public ::testing::Test {
 protected:
  Session session() {
    return Session({.session = 1, .seed = 42, .stages = {&study_.stages.front()}}, log_.events,
                   log_, clock_);
  }
  Session begun() {
    Session s = session();
    s.start();
    s.enter_stage();
    return s;
  }
  static void run_trial(Session& s, double step) {
    s.start_trial(s.state().last_tick + 1);
    present(s, "test");
    s.answer(step, {.response_time_s = 1.0}, s.state().last_tick);
  }
  static std::string waiting(const Session& s) {
    const std::optional<OpenQuestion> open = s.open_question();
    return open ? open->item->name + " of " + std::to_string(open->trial) : "";
  }

  Study study_ = read_study_text(kStudy, "study.json");
  MemoryLog log_;
  core::SimulatedClock clock_;
};

TEST_F(QuestionSessionTest, EachIsOnDiskBeforeTheNextAndAllBeforeTheNextTrial) {
  Session s = begun();
  EXPECT_EQ(waiting(s), "") << "nothing is answered yet";
  run_trial(s, 7.0);
  EXPECT_EQ(waiting(s), "confidence of 1");
  EXPECT_THROW(s.start_trial(1000), core::Error);
  EXPECT_THROW(s.answer_question("remark", "none"), core::Error) << "not its turn";
  EXPECT_THROW(s.answer_question("confidence", "6"), core::Error) << "there are five steps";
  const std::size_t num_events = log_.events.size();
  s.answer_question("confidence", "4");
  ASSERT_EQ(log_.events.size(), num_events + 1);
  const core::QuestionAnswerRow& row = log_.commits.back().question_answer.value();
  EXPECT_EQ(row.trial, 1);
  EXPECT_EQ(row.attempt, 1);
  EXPECT_EQ(row.block, "block");
  EXPECT_EQ(row.question, "confidence");
  EXPECT_EQ(row.answer, "4");
  EXPECT_EQ(waiting(s), "remark of 1");
  EXPECT_THROW(s.start_trial(1000), core::Error);
  s.answer_question("remark", kNoAnswer);
  EXPECT_EQ(waiting(s), "");
  EXPECT_NO_THROW(s.start_trial(1000));
}

TEST_F(QuestionSessionTest, OneThatWaitsAtAnInterruptionWaitsAfterIt) {
  {
    Session s = begun();
    run_trial(s, 3.0);
    s.answer_question("confidence", "2");
  }
  Session s = session();
  s.resume("repeat", 0, -1);
  EXPECT_EQ(s.state().trial(1).response, 3.0) << "what was answered stands";
  EXPECT_EQ(s.state().trial(1).question_answers.at("confidence"), "2");
  EXPECT_EQ(waiting(s), "remark of 1");
  EXPECT_EQ(s.state().current_trial(), 2);
  EXPECT_THROW(s.start_trial(1000), core::Error);
}

TEST_F(QuestionSessionTest, AnAnswerThatIsTakenBackTakesThemWithIt) {
  Session s = begun();
  run_trial(s, 3.0);
  s.answer_question("confidence", "2");
  s.undo("pressed the wrong key");
  EXPECT_EQ(waiting(s), "");
  EXPECT_EQ(s.state().current_trial(), 1);
  run_trial(s, 4.0);
  EXPECT_EQ(waiting(s), "confidence of 1") << "asked anew";
  s.answer_question("confidence", "5");
  EXPECT_EQ(log_.commits.back().question_answer->attempt, 2);
}

TEST_F(QuestionSessionTest, ACorrectionOfAnEarlierAnswerHidesNone) {
  Session s = begun();
  run_trial(s, 3.0);
  s.answer_question("confidence", "2");
  s.answer_question("remark", "warm");
  run_trial(s, 5.0);
  s.correct(1, 6.0, "misheard");
  EXPECT_EQ(waiting(s), "confidence of 2");
  EXPECT_EQ(s.state().trial(1).question_answers.size(), 2U) << "they stay with their trial";
}

TEST_F(QuestionSessionTest, TheBlockEndsWithTheLast) {
  Session s = begun();
  while (s.state().current_trial()) {
    run_trial(s, 1.0);
    if (!s.state().current_trial()) break;
    s.answer_question("confidence", "1");
    s.answer_question("remark", "cold");
  }
  EXPECT_THROW(s.finish_stage(), core::Error) << "two questions are open";
  s.answer_question("confidence", "1");
  s.answer_question("remark", "cold");
  EXPECT_NO_THROW(s.finish_stage());
  const Session again = session();
  EXPECT_EQ(again.state().trial(3).question_answers, s.state().trial(3).question_answers);
}

}  // namespace question_session_test
}  // namespace jnd::experiments
