#include <filesystem>
#include <map>
#include <string>

#include "app/environment.h"
#include "app/window/pictures_fixture.h"
#include "app/window/window_fixture.h"

namespace jnd::app {
namespace sound_window_test {

constexpr char kHeard[] = R"json({
  "format": 1, "name": "heard", "languages": ["en"], "title": {"en": "Heard"},
  "authors": ["A. Author"],
  "masking_noise": {"kind": "pink", "level_db_spl": 50, "required": true},
  "cues": [{"moment": "ready", "frequency_hz": 500, "level_db_spl": 55},
           {"moment": "begin", "frequency_hz": 1000, "level_db_spl": 55},
           {"moment": "end", "frequency_hz": 800, "level_db_spl": 55}],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05, "max_missed_ratio": 1},
  "stages": [
    {"kind": "block", "name": "comparison", "procedure": "constant_stimuli",
     "medium": "viscous", "viscosity_pa_s": [2, 16], "reference_viscosity_pa_s": 4,
     "repetitions": 1, "free_space_between_s": 0, "instruction": {"en": "Compare."},
     "question": {"en": "Thicker?"}, "expected_trial_s": 5}]
})json";

/// Imitates a machine whose only output of sound is a file, which is calibrated.
class FileAsOutput {
 public:
  explicit FileAsOutput(const std::filesystem::path& folder)
      : alsa_("ALSA_CONFIG_PATH",
              write_file(folder / "alsa.conf",
                         "pcm.headphones {\n  type file\n  slave.pcm { type null }\n  file \"" +
                             (folder / "played").string() +
                             "\"\n  format raw\n  hint { show on description "
                             "\"Headphones, USB\" }\n}\n")
                  .c_str()),
        settings_("JND_SOUND_FILE",
                  write_file(folder / "sound.json",
                             R"({"output": "headphones", "calibrations": [{"output":
                             "headphones", "full_scale_db_spl": 101.5,
                             "measured_on": "2026-11-26"}]})")
                      .c_str()) {}

 private:
  EnvironmentVariable alsa_, settings_;
};

class SoundWindowTest : public WindowTest {};

TEST_F(SoundWindowTest, ASessionPlaysTestsAndKeepsItsSound) {
  const FileAsOutput output(temporary_.path());
  write_file(path("study.json"), kHeard);
  window_->start({"run", path("study.json").string(), "--study", path("a.study").string(),
                  "--participant", "P01", "--device", "lumped", "--seed", "7"});
  window_->wait_for_text("Pink noise, 50.0 dB SPL, -51.5 dB re full scale.");
  window_->use("sound_off");
  window_->wait_for_text("Nothing of the study's sound will be heard.");
  window_->use("sound_headphones");
  window_->wait_for_text("Pink noise, 50.0 dB SPL");
  window_->use("sound_test");
  window_->wait_for_text("End the test");
  window_->use("sound_test");
  window_->wait_for_text("Test the sound");
  window_->use("real_session");
  window_->use("start_session");
  window_->wait_for("begin");
  window_->use("begin");
  for (int trial = 1; trial <= 2; ++trial) {
    wait_for_trial(trial);
    feel_test();
    window_->use("answer_yes");
  }
  window_->use("finish_stage");
  window_->wait_for("to_results");
  window_->kill();
  const core::StudyStore store = stored();
  ASSERT_EQ(events_of(store, "sound_started").size(), 1U);
  EXPECT_NE(value(events_of(store, "sound_started")[0], "output").find("headphones"),
            std::string::npos);
  std::map<std::string, int> count;
  for (const core::EventRow& event : events_of(store, "cues_played")) {
    const auto data = nlohmann::json::parse(event.data);
    for (const auto& cue : data["cues"]) {
      ++count[cue["moment"].get<std::string>()];
      const double lag_s =
          cue["heard_monotonic_s"].get<double>() - cue["asked_monotonic_s"].get<double>();
      EXPECT_GT(lag_s, 0.0);
    }
  }
  EXPECT_EQ(count, (std::map<std::string, int>{{"begin", 4}, {"end", 2}, {"ready", 2}}));
  ASSERT_FALSE(events_of(store, "sound_measured").empty());
  const auto measured = nlohmann::json::parse(events_of(store, "sound_measured").back().data);
  EXPECT_EQ(measured["num_underruns"], 0);
  EXPECT_EQ(measured["num_lost_cues"], 0);
  EXPECT_GT(std::filesystem::file_size(path("played")), 100'000U);
}

class SoundPicturesTest : public PicturesWindowTest {};

TEST_F(SoundPicturesTest, OfThePreparationAndOfAnOutputThatFails) {
  const FileAsOutput output(temporary_.path());
  write_file(path("study.json"), kHeard);
  window_->start({"run", path("study.json").string(), "--study", path("a.study").string(),
                  "--participant", "P01", "--device", "lumped", "--seed", "7"});
  window_->wait_for_text("Pink noise, 50.0 dB SPL");
  window_->wait_for("start_session");
  take("sound-prepare");
  window_->use("sound_off");
  window_->wait_for_text("Nothing of the study's sound will be heard.");
  take("sound-prepare-off");
  window_->kill();
}

}  // namespace sound_window_test
}  // namespace jnd::app
