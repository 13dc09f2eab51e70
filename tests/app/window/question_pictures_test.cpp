#include "app/asked_study.h"
#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace question_pictures_test {

class QuestionPicturesTest : public PicturesWindowTest {
 protected:
  /// Waits for one of these cards, takes a picture of it and uses it.
  std::string use_first(const std::vector<std::string>& cards) {
    std::string card;
    window_->wait_until("a card", [&](const Screen& at) {
      card.clear();
      for (const std::string& one : cards) {
        if (card.empty() && at.offers(one)) card = one;
      }
      return !card.empty();
    });
    return card;
  }
};

TEST_F(QuestionPicturesTest, OfARatingAndTheQuestionsAfterIt) {
  std::string study = kAskedStudy;
  study.insert(study.find("\"rate_hz\""), "\"max_missed_ratio\": 1.0, ");
  write_file(path("study.json"), study);
  window_->start({"run", path("study.json").string(), "--study", path("asked.study").string(),
                  "--participant", "P07", "--device", "lumped", "--seed", "7"});
  window_->wait_for("start_session");
  window_->use("real_session");
  window_->use("start_session");
  for (int number = 1;; ++number) {
    ASSERT_LT(number, 60);
    const std::string card = use_first({"begin", "step_5", "answer_yes", "item_skip", "scale_4",
                                        "present", "finish_stage", "to_results"});
    take(
        "question-" + std::string(number < 10 ? "0" : "") + std::to_string(number) + '-' + card,
        number < 6 ? 2 : 1);
    if (card == "to_results") break;
    const Screen now = window_->screen();
    window_->use(card);
    window_->wait_until("the next card",
                        [&](const Screen& at) { return words_of(at) != words_of(now); });
  }
  window_->wait_for_text("complete");
  window_->use("to_results");
  take("question-results", 1);
  window_->kill();
}

}  // namespace question_pictures_test
}  // namespace jnd::app
