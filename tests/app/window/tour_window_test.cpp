#include <cmath>
#include <filesystem>

#include "app/window/window_fixture.h"
#include "core/storage/recording.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::app {
namespace tour_window_test {

constexpr int kTrials = 4 + 2 + 12;
const std::string kFolder = "person/data/jnd/short_tour.study";

/// Takes the tour as somebody does who has nothing but the window and a mouse.
class TourWindowTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    // The study is the shipped one, except that missed ticks of a busy machine do not repeat
    // trials.
    namespace fs = std::filesystem;
    const fs::path source = test_support::source_folder();
    window_->share = path("share");
    fs::create_directories(window_->share);
    fs::copy(source / "protocols", window_->share / "protocols", fs::copy_options::recursive);
    fs::create_directory_symlink(source / "data", window_->share / "data");
    const fs::path tour = window_->share / "protocols/short_tour.json";
    write_file(tour, replaced(test_support::read_file(tour), "\"ramp_s\": 0.05",
                              "\"ramp_s\": 0.05, \"max_missed_ratio\": 0.25"));
  }

  void take_tour() {
    window_->start();
    window_->use("start_tour");
    window_->use("begin");
    while (step_on()) {
    }
  }

  void see_the_results() {
    window_->wait_for_text("18 answers of P01 are on disk.");
    window_->wait_for_text("complete");
    window_->use("to_results");
    const Screen results = window_->wait_until("the Weber fraction", [](const Screen& now) {
      return now.view == "results" && now.text_after("w = ") != "";
    });
    EXPECT_TRUE(results.shows("A short tour"));
    const double weber_fraction = std::stod(results.text_after("w = "));
    EXPECT_GT(weber_fraction, 0.1) << "of who is of two minds near the reference";
    EXPECT_LT(weber_fraction, 1.0);
    window_->kill();
  }

  void expect_stored_as_answered() const {
    const core::StudyStore store = stored(kFolder);
    EXPECT_TRUE(store.completed(1));
    EXPECT_EQ(store.session(1).device, "mouse");
    EXPECT_FALSE(store.session(1).simulated) << "a person took it";
    const std::vector<double> given = responses(store);
    ASSERT_EQ(given.size(), answers_.size());
    for (std::size_t i = 0; i < given.size(); ++i) EXPECT_NEAR(given[i], answers_[i], 1e-9);
    EXPECT_EQ(given.size(), static_cast<std::size_t>(kTrials));
    // The mouse moved the hand in every trial.
    const core::RecordingReader recording(store.recording_file(1));
    for (const core::TrialRow& trial : store.trials(1)) {
      double left_m = 1.0;
      double right_m = -1.0;
      recording.read(trial.first_tick, trial.last_tick, [&](const core::Sample& sample) {
        left_m = std::min(left_m, static_cast<double>(sample.tip_position_m[0][0]));
        right_m = std::max(right_m, static_cast<double>(sample.tip_position_m[0][0]));
      });
      EXPECT_GT(right_m - left_m, 0.03) << "trial " << trial.trial;
    }
    expect_verified(kFolder);
  }

 private:
  /// Does whatever the window asks for. Returns false when it asks for nothing.
  bool step_on() {
    const Screen now = window_->wait_until("something to do", [](const Screen& at) {
      return at.shows("Session finished") || at.offers("feel_medium") ||
             at.offers("finish_medium") || at.offers("present") || at.offers("finish_stage");
    });
    if (now.shows("Session finished")) return false;
    if (now.offers("feel_medium")) {
      window_->use("feel_medium");
      window_->wait_for("finish_medium");
      window_->move_hand(2);
      window_->use("finish_medium");
      window_->wait_until("the next",
                          [](const Screen& at) { return !at.find("finish_medium"); });
    } else if (now.offers("finish_stage")) {
      window_->use("finish_stage");
      window_->wait_until("the next",
                          [](const Screen& at) { return !at.find("finish_stage"); });
    } else {
      run_trial();
    }
    return true;
  }

  void run_trial() {
    const std::string number = window_->screen().text_after("Trial ");
    feel_test();
    window_->move_hand(2);
    const Screen felt = window_->wait_until("a fluid", [](const Screen& now) {
      return now.offers("matches") || now.offers("answer_yes") || now.find("answer_percent");
    });
    const double felt_level = level();
    EXPECT_FALSE(felt.shows("Pa s") || felt.shows("scale ")) << "they are the participant";
    if (felt.offers("matches")) {
      window_->use("raise_coarse");
      wait_for_level(felt_level + 0.5);
      window_->use("lower_fine");
      wait_for_level(felt_level + 0.4);
      answers_.push_back(felt_level + 0.4);
      window_->use("matches");
    } else if (felt.offers("answer_yes")) {
      answers_.push_back(says_thicker(felt_level) ? 1.0 : 0.0);
      window_->use(answers_.back() == 1.0 ? "answer_yes" : "answer_no");
    } else {
      answers_.push_back(std::round(100.0 * felt_level));
      window_->type(std::to_string(std::lround(100.0 * felt_level)));
      window_->use("answer_percent");
    }
    window_->wait_until("the next", [&](const Screen& now) {
      return now.text_after("Trial ") != number || now.offers("finish_stage");
    });
  }

  /// Imitates a person who is sure far from the reference and undecided near it.
  bool says_thicker(double viscosity_pa_s) {
    const int time = ++num_felt_[viscosity_pa_s];
    if (viscosity_pa_s < 6.0) return false;
    if (viscosity_pa_s > 12.0) return true;
    return time == (viscosity_pa_s < 8.0 ? 2 : 1);
  }

  /// Looks up the level of the trial, because the tour hides the levels.
  [[nodiscard]] double level() const {
    const core::DesignRow drawn = tour().design(1).at(answers_.size());
    return drawn.intensity.value_or(drawn.starting_intensity.value_or(0.0));
  }
  void wait_for_level(double wanted) const {
    window_->wait_until("scale " + std::to_string(wanted), [&](const Screen&) {
      const auto steps = events_of(tour(), "intensity_adjusted");
      return !steps.empty() && std::abs(steps.back().intensity.value() - wanted) < 1e-9;
    });
  }
  [[nodiscard]] core::StudyStore tour() const { return stored(kFolder); }

  std::vector<double> answers_;
  std::map<double, int> num_felt_;
};

TEST_F(TourWindowTest, FromTheStartViewToItsResultsByKeyboard) {
  take_tour();
  see_the_results();
  expect_stored_as_answered();
}

TEST_F(TourWindowTest, FromTheStartViewToItsResultsByMouse) {
  window_->hand = WindowDriver::Hand::kMouse;
  take_tour();
  see_the_results();
  expect_stored_as_answered();
}

}  // namespace tour_window_test
}  // namespace jnd::app
