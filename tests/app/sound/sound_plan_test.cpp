#include "app/sound/sound_plan.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "app/environment.h"
#include "app/sound/sound_outputs.h"
#include "app/sound/sound_settings.h"
#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace sound_plan_test {

using experiments::MaskingNoise;
using experiments::Sound;
using experiments::Study;

const SoundCalibration kMeasured{
    .output = "default", .full_scale_db_spl = 101.5, .measured_on = "2026-11-26"};

std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(SoundPlan, ASoundPressureLevelNeedsWhatWasMeasured) {
  EXPECT_DOUBLE_EQ(level_dbfs_of({.level_db_spl = 65.0}, kMeasured, -15.0), -36.5);
  EXPECT_DOUBLE_EQ(level_dbfs_of({.level_dbfs = -40.0}, {}, -15.0), -40.0);
  EXPECT_TRUE(refusal_of([] {
                (void)level_dbfs_of({.level_db_spl = 65.0}, {}, -15.0);
              }).starts_with("expected an output that is calibrated, for 65 dB SPL"));
}

TEST(SoundPlan, NothingIsLouderThanSamplesAndEarsStand) {
  const SoundCalibration weak{.full_scale_db_spl = 70.0};
  EXPECT_TRUE(refusal_of([&] { (void)level_dbfs_of({.level_db_spl = 65.0}, weak, -15.0); })
                  .starts_with("expected at most -15 dB re full scale, so that nothing clips, "
                               "found -5.0"));
  EXPECT_TRUE(refusal_of([] {
                (void)level_dbfs_of({.level_dbfs = -15.0}, kMeasured, -15.0);
              }).starts_with("expected at most 85 dB SPL"));
  EXPECT_DOUBLE_EQ(level_dbfs_of({.level_db_spl = 85.0}, kMeasured, -15.0), -16.5);
}

Study study_with_sound() {
  Study study;
  study.sound.masking_noise = {.kind = MaskingNoise::Kind::kPink, .level = {.level_dbfs = -40}};
  study.sound.cues = {{.moment = experiments::CueMoment::kBegin,
                       .frequency_hz = 1000.0,
                       .level = {.level_dbfs = -30}}};
  experiments::Block quiet, same, louder;
  quiet.masking_noise = MaskingNoise{};
  louder.masking_noise =
      MaskingNoise{.kind = MaskingNoise::Kind::kWhite, .level = {.level_dbfs = -35}};
  louder.cues = std::vector<experiments::Cue>{};
  for (experiments::Block* block : {&quiet, &same, &louder}) {
    study.stages.push_back({.name = "a", .content = *block});
  }
  return study;
}

TEST(SoundPlan, HasEveryNoiseAndToneOfAStudyOnce) {
  const Study study = study_with_sound();
  const SoundPlan plan = sound_plan(study, {});
  ASSERT_EQ(plan.parts.size(), 3U);
  EXPECT_EQ(plan.noises.size(), 2U);
  EXPECT_EQ(plan.cues.size(), 1U);
  EXPECT_EQ(plan.part_of(study.sound).noise, 0);
  const auto& quiet = std::get<experiments::Block>(study.stages[0].content);
  EXPECT_EQ(plan.part_of(sound_of(study, &quiet)).noise, core::SoundMixer::kNoNoise);
  EXPECT_EQ(plan.part_of(sound_of(study, &quiet)).cues[1], 0U) << "its cues are the study's";
  const auto& louder = std::get<experiments::Block>(study.stages[2].content);
  EXPECT_EQ(plan.part_of(sound_of(study, &louder)).noise, 1);
  EXPECT_FALSE(plan.part_of(sound_of(study, &louder)).cues[1]);
  EXPECT_EQ(sound_level_words(study, kMeasured),
            (std::vector<std::string>{
                "Pink noise, 61.5 dB SPL, -40.0 dB re full scale.",
                "Cue for a stimulus that begins, 1000 Hz, 71.5 dB SPL, -30.0 dB re full scale.",
                "White noise, 66.5 dB SPL, -35.0 dB re full scale."}));
}

class SoundSettingsTest : public ::testing::Test {
 protected:
  test_support::TemporaryFolder temporary_;
  SoundSettings settings_{temporary_.path() / "folder" / "sound.json"};
};

TEST_F(SoundSettingsTest, BeginWithTheUsualOutputAndNothingMeasured) {
  EXPECT_EQ(settings_.output(), "default");
  EXPECT_FALSE(settings_.calibration_of("default"));
}

TEST_F(SoundSettingsTest, KeepWhatWasChosenAndTheLastMeasurementOfEachOutput) {
  settings_.add({.output = "a", .full_scale_db_spl = 90.0, .measured_on = "2026-11-25"});
  settings_.choose("a");
  settings_.add({.output = "b", .full_scale_db_spl = 80.0, .measured_on = "2026-11-25"});
  settings_.add({.output = "a", .full_scale_db_spl = 95.5, .measured_on = "2026-11-26"});
  EXPECT_EQ(settings_.output(), "a");
  EXPECT_EQ(settings_.calibration_of("a")->full_scale_db_spl, 95.5);
  EXPECT_EQ(settings_.calibration_of("a")->measured_on, "2026-11-26");
  EXPECT_EQ(settings_.calibration_of("b")->full_scale_db_spl, 80.0);
  const std::string text = test_support::read_file(settings_.file());
  EXPECT_NE(text.find("90.0"), std::string::npos) << "nothing that was measured is lost";
}

TEST_F(SoundSettingsTest, AFileThatIsNoneIsSaidAndLeftAlone) {
  std::filesystem::create_directories(settings_.file().parent_path());
  test_support::write_file(settings_.file(), "{\"output\": 3}");
  EXPECT_NE(refusal_of([&] { (void)settings_.output(); }).find("sound.json: expected this "),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { settings_.choose("a"); }), "");
  EXPECT_EQ(test_support::read_file(settings_.file()), "{\"output\": 3}");
}

TEST_F(SoundSettingsTest, AreWhereTheEnvironmentSays) {
  const EnvironmentVariable file("JND_SOUND_FILE", "/somewhere/sound.json");
  EXPECT_EQ(SoundSettings::default_file(), "/somewhere/sound.json");
  const EnvironmentVariable none("JND_SOUND_FILE", nullptr);
  const EnvironmentVariable config("XDG_CONFIG_HOME", "/config");
  EXPECT_EQ(SoundSettings::default_file(), "/config/jnd/sound.json");
}

TEST_F(SoundSettingsTest, AnOutputThatWasChosenIsListedWhetherItIsThereOrNot) {
  settings_.choose("headphones");
  settings_.add({.output = "headphones", .full_scale_db_spl = 90.0, .measured_on = "today"});
  bool is_listed = false;
  for (const KnownOutput& one : known_outputs(settings_)) {
    is_listed |= one.name == "headphones" && one.is_chosen && one.calibration;
  }
  EXPECT_TRUE(is_listed);
}

}  // namespace sound_plan_test
}  // namespace jnd::app
