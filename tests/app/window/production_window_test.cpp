#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace {

using std::chrono::milliseconds;

class ProductionWindowTest : public WindowTest {
 protected:
  /// As it stands on the card: "felt for 0.4 s · scale 1.5".
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
  void wait_for_level(double wanted) const {
    window_->wait_until("scale " + std::to_string(wanted),
                        [&](const Screen& now) { return level_on(now) == wanted; });
  }
  /// Steps of the trial that were stored, with what they led to.
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
  // The last step may still be on its way.
  window_->press("Right");
  double raised = 0.0;
  window_->wait_until("what the screen shows to be what is stored", [&](const Screen& now) {
    const std::vector<double> steps = steps_of(stored(), 1);
    raised = level_on(now);
    return !steps.empty() && steps.back() == raised;
  });
  const auto num_raised = steps_of(stored(), 1).size();
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
  window_->wait_until("three steps", [&](const Screen& now) {
    return level_on(now) >= second + 0.75;
  });
  window_->use("lower_coarse");
  window_->wait_until("the step down", [&](const Screen&) {
    const std::vector<double> steps = steps_of(stored(), 2);
    return steps.size() >= 2 && steps[steps.size() - 1] == steps[steps.size() - 2] - 0.5;
  });
  const double set = steps_of(stored(), 2).back();
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

}  // namespace
}  // namespace jnd::app
