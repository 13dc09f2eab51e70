#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace answering_pictures_test {

/// A study with a stimulus that has to be felt for a while and ends by itself, a deadline for
/// the answer, no way back, and the answer "cannot tell".
const std::string kInTime = R"json({
  "format": 1, "name": "in_time", "languages": ["en"], "title": {"en": "In good time"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1.0},
  "stages": [
    {"kind": "block", "name": "pairs", "title": {"en": "Which is thicker"},
     "procedure": "constant_stimuli", "medium": "viscous", "task": "two_interval",
     "viscosity_pa_s": [6, 12], "reference_viscosity_pa_s": 8, "repetitions": 1,
     "cannot_tell": true, "max_returns": 0,
     "min_stimulus_s": 20, "max_stimulus_s": 30, "answer_deadline_s": 60,
     "instruction": {"en": "Two fluids follow each other."},
     "question": {"en": "Which of the two was thicker?"},
     "free_space_between_s": 0, "expected_trial_s": 60}
  ]})json";

class AnsweringPicturesTest : public PicturesWindowTest {};

TEST_F(AnsweringPicturesTest, OfATrialInGoodTime) {
  write_file(path("study.json"), kInTime);
  window_->start({"run", path("study.json").string(), "--study", path("in_time.study").string(),
                  "--participant", "P07", "--device", "lumped", "--seed", "7"});
  window_->wait_for("start_session");
  window_->use("real_session");
  window_->use("start_session");
  window_->use("begin");
  window_->wait_for_text("Present the first");
  window_->use("present");
  window_->wait_for_text("s to go");
  take("answering-1-not-yet", 1);
  window_->wait_until("the least time is over",
                      [](const Screen& at) { return at.offers("present"); });
  window_->use("present");
  window_->wait_for_text("s left to answer");
  take("answering-2-question", 1);
  window_->wait_for_text("The stimulus is over");
  take("answering-3-over", 2);
  window_->wait_for_text("The time to answer was over");
  take("answering-4-missed", 2);
  window_->kill();
}

}  // namespace answering_pictures_test
}  // namespace jnd::app
