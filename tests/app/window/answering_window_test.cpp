#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace answering_window_test {

class AnsweringWindowTest : public WindowTest {};

TEST_F(AnsweringWindowTest, CannotTellIsAKeyAndAMissedDeadlineIsStoredByItself) {
  std::string study = study_of(kComparison);
  const std::string procedure = R"("procedure": "constant_stimuli")";
  study.insert(study.find(procedure),
               R"("cannot_tell": true, "max_stimulus_s": 2, "answer_deadline_s": 6, )");
  begin(study);
  feel_test();
  window_->press("c");
  wait_for_trial(2);
  feel_test();
  window_->wait_for_text("The stimulus is over");
  window_->wait_for_text("The time to answer was over");
  window_->kill();

  const core::StudyStore store = stored();
  const std::vector<core::TrialRow> trials = store.trials(1);
  ASSERT_EQ(trials.size(), 1u);
  EXPECT_EQ(trials[0].response, std::nullopt);
  EXPECT_GT(trials[0].measures.response_time_s.value(), 0.0);
  const auto missed = events_of(store, "attempt_discarded");
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_EQ(value(missed[0], "reason"), "no answer within the deadline of 6 s");
}

}  // namespace answering_window_test
}  // namespace jnd::app
