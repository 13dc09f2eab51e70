#include <gtest/gtest.h>

#include "app/interleaved_study.h"
#include "app/operator/operated_session_fixture.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_outline.h"

// Tests what the operator reads, sees and can do while trials of several blocks are mixed.

namespace jnd::app {
namespace interleaved_view_test {

class InterleavedViewTest : public OperatedSessionTest {
 protected:
  SessionView begin() {
    open(kInterleavedStudy);
    return act(operate::Begin{});
  }
  /// Answers the waiting trial and the questions after it.
  SessionView answer_now(double value) {
    answer_trial(view(), value);
    if (view().step == Step::kItem) {
      const SessionView now = view();
      act(operate::AnswerItem{now.stage, now.item->name, "yes", now.item->trial});
    }
    return view();
  }
};

TEST_F(InterleavedViewTest, TheGroupIsCountedAndNamedAsOne) {
  SessionView now = begin();
  ASSERT_EQ(now.stages.size(), 3U) << "a line for each group, and one for the block";
  EXPECT_EQ(now.stages[0].title, "Two kinds");
  EXPECT_EQ(now.stages[1].title, "Alone");
  EXPECT_EQ(now.stages[2].title, "Two more");
  ASSERT_TRUE(now.trial.has_value());
  EXPECT_EQ(now.trial->num_in_block, 5);
  EXPECT_TRUE(now.trial->num_is_expected);
  EXPECT_EQ(now.trial->num_repetitions, 1);
  EXPECT_EQ(now.say, "Compare.\nCompare, and say how sure you are.")
      << "of both, before the first";
  double done = now.done_ratio;
  for (int answered = 1; answered <= 5; ++answered) {
    now = answer_now(1.0);
    EXPECT_EQ(now.answers.front().in_block, answered) << "the last one stands on top";
    EXPECT_EQ(now.answers.front().block, "Two kinds");
    EXPECT_TRUE(now.answers.front().can_undo);
    EXPECT_GT(now.done_ratio, done);
    done = now.done_ratio;
    EXPECT_EQ(now.stages[0].status, StageLine::Status::kNow);
    EXPECT_EQ(now.stages[1].status, StageLine::Status::kLater);
    if (answered == 5) break;
    EXPECT_EQ(now.trial->in_block, answered + 1);
    EXPECT_EQ(now.say, "") << "instructions are told once";
  }
  EXPECT_EQ(now.step, Step::kStageDone);
  now = act(operate::FinishStage{now.stage, ""});
  EXPECT_EQ(now.stages[0].status, StageLine::Status::kDone);
  EXPECT_EQ(now.stages[1].status, StageLine::Status::kNow);
  EXPECT_EQ(now.trial->num_in_block, 2);
  EXPECT_EQ(now.say, "Compare.");
}

TEST_F(InterleavedViewTest, TheQuestionIsThatOfTheTrialsBlockAndUndoCrossesBlocks) {
  SessionView now = begin();
  std::vector<std::pair<std::string, std::int64_t>> run;
  int num_asked = 0;
  for (int i = 0; i < 4; ++i) {
    run.emplace_back(study_stage_name(now.stage), now.trial->trial);
    answer_trial(now, 1.0);
    now = view();
    const bool is_asked = now.step == Step::kItem;
    EXPECT_EQ(is_asked, run.back().first == "adaptive");
    if (is_asked) {
      ++num_asked;
      EXPECT_EQ(study_stage_name(now.stage), "adaptive");
      now = act(operate::AnswerItem{now.stage, now.item->name, "yes", now.item->trial});
      EXPECT_EQ(now.refusal, "");
    }
  }
  EXPECT_GT(num_asked, 0);
  for (int i = 3; i >= 0; --i) {
    now = act(operate::Undo{"misheard"});
    EXPECT_EQ(now.refusal, "");
    EXPECT_EQ(study_stage_name(now.stage), run[static_cast<std::size_t>(i)].first);
    EXPECT_EQ(now.trial->trial, run[static_cast<std::size_t>(i)].second);
    EXPECT_EQ(now.trial->in_block, i + 1);
  }
}

TEST_F(InterleavedViewTest, ALaterVisitGoesOnInTheGroup) {
  SessionView now = begin();
  answer_now(1.0);
  now = answer_now(1.0);
  const std::int64_t trial = now.trial->trial;
  reopen();
  now = act(operate::Begin{"repeat"});
  EXPECT_EQ(now.trial->trial, trial);
  EXPECT_EQ(now.trial->in_block, 3);
  EXPECT_EQ(now.trial->num_in_block, 5);
}

TEST_F(InterleavedViewTest, WhoIsBlindReadsNoBlock) {
  open(replaced(kInterleavedStudy, R"("name": "mixed",)",
                R"("name": "mixed", "blinding": "double",)"));
  const SessionView now = act(operate::Begin{});
  ASSERT_EQ(now.stages.size(), 3U);
  EXPECT_EQ(now.stages[0].title, "Block 1");
  EXPECT_EQ(now.stages[2].title, "Block 3");
}

TEST(InterleavedOutline, HasTheBlocksBelowTheirGroup) {
  const experiments::Study study = experiments::read_study_text(kInterleavedStudy, "x.json");
  const StudyOutline outline = outline_of(study);
  ASSERT_EQ(outline.stages.size(), 7U);
  EXPECT_EQ(outline.stages[0].title, "Two kinds");
  EXPECT_EQ(outline.stages[0].kind, "Interleaved");
  EXPECT_EQ(outline.stages[0].what, "trials of the blocks below, mixed at random");
  EXPECT_EQ(outline.stages[0].depth, 0);
  EXPECT_EQ(outline.stages[1].title, "Constant");
  EXPECT_EQ(outline.stages[1].depth, 1);
  EXPECT_EQ(outline.stages[0].duration_s,
            outline.stages[1].duration_s + outline.stages[2].duration_s);
  EXPECT_EQ(outline.stages[3].title, "Alone");
  EXPECT_EQ(outline.stages[3].depth, 0);
  EXPECT_EQ(outline.stages[4].what,
            "trials of the blocks below, mixed in rounds of one trial each");
  const PlannedOrder order = planned_orders(study, {.num_participants = 1, .seed = 3}).front();
  ASSERT_EQ(order.blocks.size(), 7U);
  EXPECT_EQ(order.blocks[5], "Two kinds: 1 Constant, 2 Adaptive, mixed at random")
      << "answers decide how long";
  const std::string known = "Two more: 1 Thin, 2 Thick, mixed in rounds: ";
  EXPECT_EQ(order.blocks[6].substr(0, known.size()), known);
  EXPECT_EQ(order.blocks[6].size(), known.size() + 7) << order.blocks[6];
}

}  // namespace interleaved_view_test
}  // namespace jnd::app
