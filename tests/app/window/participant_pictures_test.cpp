#include <string>
#include <utility>

#include "app/environment.h"
#include "app/window/pictures_fixture.h"

// Takes pictures of what the participant sees, on a small and on a usual monitor.

namespace jnd::app {
namespace participant_pictures_test {

namespace fs = std::filesystem;

constexpr const char* kTitle = "jnd: participant";

class ParticipantPicturesTest : public PicturesWindowTest {
 protected:
  void SetUp() override {
    PicturesWindowTest::SetUp();
    if (IsSkipped()) return;
    display_ = std::make_unique<VirtualDisplay>(1600 + 1920, 1080);
    window_ = std::make_unique<WindowDriver>(*display_, path("person"));
    window_->forgives_stalls = true;
    fs::create_directories(path("person/.config/jnd"));
    write_file(path("person/.config/jnd/controls.json"), R"json({"controls": [
      {"action": "yes", "device": "0c45:7403 FootSwitch", "control": "KEY_A"},
      {"action": "no", "device": "0c45:7403 FootSwitch", "control": "KEY_B"}]})json");
    plug_in("1920 1080");
  }
  void plug_in(const std::string& size) {
    write_file(path("monitors.new"), "DP-1 0 0 1600 1080\nHDMI-1 1600 0 " + size + "\n");
    fs::rename(path("monitors.new"), path("monitors"));
  }
  void take_theirs(const std::string& name) {
    for (const std::string size : {"1024 600", "1920 1080"}) {
      plug_in(size);
      window_->wait_until("the monitor's size", [&](const Screen&) {
        const std::string told =
            run_tool({"xdotool", "search", "--name", "^jnd: participant$", "getwindowgeometry"},
                     display_->name())
                .out;
        return told.find(std::string(size).replace(size.find(' '), 1, "x")) !=
               std::string::npos;
      });
      // The window makes letters of another size only after it has stopped growing.
      const std::uint64_t seen = window_->screen().frame;
      window_->wait_until("frames of both windows",
                          [&](const Screen& now) { return now.frame > seen + 30; });
      const fs::path file =
          fs::path(JND_PICTURES) / ("participant-" + name + "-" + size.substr(0, 4) + ".png");
      window_->picture(file, kTitle);
      EXPECT_GT(fs::file_size(file), 3000U) << file << " shows next to nothing";
    }
  }
  /// Returns a study with the consent of a shipped study and one block for each way to answer.
  static std::string study() {
    nlohmann::json study = nlohmann::json::parse(R"json({
      "format": 1, "name": "shown", "languages": ["en"], "title": {"en": "Shown"},
      "authors": ["A. Author"],
      "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05,
                 "max_missed_ratio": 1.0},
      "stages": [
        {"kind": "block", "name": "rated", "procedure": "rating", "medium": "viscous",
         "viscosity_pa_s": [4], "repetitions": 1, "num_steps": 7,
         "low_label": {"en": "very thin"}, "high_label": {"en": "very thick"},
         "instruction": {"en": "Say how thick each fluid feels."}, "free_space_between_s": 0,
         "question": {"en": "How thick does this fluid feel?"}, "expected_trial_s": 8},
        {"kind": "block", "name": "compared", "procedure": "constant_stimuli",
         "medium": "viscous", "answered_by": "participant", "viscosity_pa_s": [4, 16],
         "reference_viscosity_pa_s": 8, "repetitions": 1, "free_space_between_s": 0,
         "yes_label": {"en": "Thicker"}, "no_label": {"en": "Not thicker"},
         "instruction": {"en": "First comes the reference, then the test."},
         "question": {"en": "Does this feel thicker than the reference?"},
         "expected_trial_s": 8},
        {"kind": "block", "name": "estimated", "procedure": "magnitude_estimation",
         "medium": "water", "scale": [1], "repetitions": 1, "free_space_between_s": 0,
         "instruction": {"en": "Water is 100 %."},
         "question": {"en": "How strong is this, if water is 100 %?"},
         "expected_trial_s": 8},
        {"kind": "break", "name": "rest", "duration_s": 600,
         "instruction": {"en": "Take your hand out, and rest it."}}]})json");
    const auto stages = shipped("viscosity_discrimination").at("stages");
    for (const nlohmann::json& stage : stages) {
      if (stage.at("kind") != "consent") continue;
      study["stages"].insert(study["stages"].begin(), in_english(stage));
    }
    return study.dump();
  }
  static nlohmann::json in_english(nlohmann::json part) {
    if (part.is_object()) part.erase("de");
    if (!part.is_structured()) return part;
    for (auto& inner : part) inner = in_english(inner);
    return part;
  }

  EnvironmentVariable monitors_{"JND_MONITORS", path("monitors").c_str()};
};

TEST_F(ParticipantPicturesTest, OfEveryWayToAskAndOfTheChoiceOfTheMonitor) {
  begin(study());
  window_->press("F9");
  window_->wait_for("screen_1");
  window_->picture(fs::path(JND_PICTURES) / "participant-choice.png");
  window_->use("screen_1");
  window_->use("screen_close");
  window_->wait_for("consent_given");
  window_->wait_until("the participant's window",
                      [&](const Screen&) { return window_->has_window(kTitle); });
  take_theirs("consent");
  window_->use("consent_given");
  window_->wait_for("present");
  take_theirs("instruction");
  window_->use("present");
  window_->wait_for("step_5");
  take_theirs("rating");
  window_->use("step_5");
  window_->use("finish_stage");
  feel_test();
  take_theirs("pedals");
  window_->use("answer_yes");
  wait_for_trial(2);
  feel_test();
  window_->use("answer_yes");
  window_->use("finish_stage");
  feel_test();
  window_->type("120");
  window_->wait_for_text("120");
  take_theirs("number");
  window_->use("answer_percent");
  window_->use("finish_stage");
  window_->wait_for_text("Rest.");
  take_theirs("break");
  window_->kill();
}

}  // namespace participant_pictures_test
}  // namespace jnd::app
