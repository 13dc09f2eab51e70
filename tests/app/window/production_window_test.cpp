#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace production_window_test {

using std::chrono::milliseconds;

class ProductionWindowTest : public WindowTest {
 protected:
  /// Returns the level on the card, which reads for example "felt for 0.4 s · scale 1.5".
  static double level_on(const Screen& screen) {
    for (const std::string& text : screen.texts) {
      const std::size_t at = text.find("scale ");
      if (text.starts_with("felt for") && at != std::string::npos) {
        return std::stod(text.substr(at + 6));
      }
    }
    return -1.0;
  }
  double level() const { return level_on(window_->screen()); }
  /// Returns whether the card shows this level, to the three digits that it has.
  static bool shows_level(const Screen& screen, double wanted) {
    return std::abs(level_on(screen) - wanted) < 0.06;
  }
  void wait_for_level(double wanted) const {
    window_->wait_until("scale " + std::to_string(wanted),
                        [&](const Screen& now) { return shows_level(now, wanted); });
  }
  /// Keys are handled in their order. Once this key has had its effect, all keys before it
  /// have.
  void wait_for_all_steps() const {
    window_->press("ctrl+n");
    window_->wait_for_text("Write a note");
    window_->press("F2");
    window_->wait_for("matches");
  }
  /// Returns the levels to which the stored steps of the trial led.
  static std::vector<double> steps_of(const core::StudyStore& store, std::int64_t trial) {
    std::vector<double> levels;
    for (const core::EventRow& event : events_of(store, "intensity_adjusted")) {
      if (event.trial == trial) levels.push_back(event.intensity.value());
    }
    return levels;
  }
};

TEST_F(ProductionWindowTest, HeldKeysAndButtonsGoOnStepByStepAndSingleOnesAreNotLost) {
  begin(study_of(kProduction));
  feel_test();
  const double start = level();
  ASSERT_TRUE(start == 1.0 || start == 2.0) << start;

  window_->hold("Right", milliseconds(1200));
  wait_for_all_steps();
  const std::vector<double> steps = steps_of(stored(), 1);
  const auto num_raised = steps.size();
  ASSERT_GT(num_raised, 0u);
  const double raised = steps.back();
  wait_for_level(raised);
  EXPECT_EQ(raised, start + 0.5 * static_cast<double>(num_raised));
  EXPECT_GE(num_raised, 5u) << "a held key goes on";
  EXPECT_LE(num_raised, 27u) << "not faster than it repeats";

  window_->press_at_once({"Left", "Left", "Left", "Down"});
  wait_for_level(raised - 1.75);
  window_->use("matches");
  wait_for_trial(2);

  window_->hand = WindowDriver::Hand::kMouse;
  feel_test();
  const double second = level();
  EXPECT_EQ(second, 3.0 - start);
  window_->hold_button("raise_fine", milliseconds(1200));
  wait_for_all_steps();
  const double held = steps_of(stored(), 2).back();
  EXPECT_GE(held, second + 0.75) << "a held button goes on, too";
  window_->use("lower_coarse");
  const double set = held - 0.5;
  wait_for_level(set);
  window_->use("matches");
  window_->use("finish_stage");
  window_->wait_for_text("Session finished");
  window_->kill();

  const core::StudyStore store = stored();
  EXPECT_EQ(responses(store), (std::vector<double>{raised - 1.75, set}));
  const core::TrialRow trial = store.trials(1).front();
  EXPECT_EQ(trial.starting_intensity, start);
  EXPECT_EQ(trial.num_steps, static_cast<std::int64_t>(num_raised) + 4);
  EXPECT_EQ(trial.num_presentations, trial.num_steps + 1);
  expect_verified();
}

}  // namespace production_window_test
}  // namespace jnd::app
