#include "experiments/study/sound.h"

#include <gtest/gtest.h>

#include <string>

#include "experiments/protocol/study_reader.h"
#include "experiments/study/study.h"

namespace jnd::experiments {
namespace sound_test {

Study study_with(const std::string& sound, const std::string& of_block = "") {
  return read_study_text(R"json({"format": 1, "name": "heard", "languages": ["en"],
    "title": {"en": "Heard"}, "authors": ["A. Author"], )json" +
                             sound + R"json("stages": [
    {"kind": "block", "name": "a", "procedure": "constant_stimuli", "medium": "viscous",
     "viscosity_pa_s": [1, 4], "reference_viscosity_pa_s": 2, "repetitions": 1, )json" +
                             of_block + R"json("instruction": {"en": "Feel."},
     "question": {"en": "Thicker?"}, "expected_trial_s": 5}]})json",
                         "heard.json");
}

const Block& block_of(const Study& study) { return std::get<Block>(study.stages[0].content); }

TEST(Sound, OfAStudyIsReadWithItsDefaults) {
  const Study study = study_with(
      R"("masking_noise": {"kind": "band", "low_hz": 100, "high_hz": 4000, "level_db_spl": 65,
         "ramp_s": 2, "required": true},
         "cues": [{"moment": "end", "frequency_hz": 800, "level_dbfs": -40}], )");
  const Sound sound = sound_of(study, nullptr);
  EXPECT_EQ(sound.masking_noise.kind, MaskingNoise::Kind::kBand);
  EXPECT_EQ(sound.masking_noise.low_hz, 100.0);
  EXPECT_EQ(sound.masking_noise.high_hz, 4000.0);
  EXPECT_EQ(sound.masking_noise.level.level_db_spl, 65.0);
  EXPECT_FALSE(sound.masking_noise.level.level_dbfs);
  EXPECT_EQ(sound.masking_noise.ramp_s, 2.0);
  ASSERT_NE(sound.cue_of(CueMoment::kEnd), nullptr);
  EXPECT_EQ(sound.cue_of(CueMoment::kBegin), nullptr);
  EXPECT_EQ(sound.cue_of(CueMoment::kEnd)->duration_s, 0.1);
  EXPECT_EQ(sound.cue_of(CueMoment::kEnd)->level.level_dbfs, -40.0);
  EXPECT_FALSE(sound.cue_of(CueMoment::kEnd)->required);
  EXPECT_TRUE(requires_sound(study)) << "the noise is required";
  EXPECT_EQ(sound_of(study, &block_of(study)), sound);
}

TEST(Sound, OfABlockTakesThePlaceOfTheStudysKeyByKey) {
  const Study study = study_with(
      R"("masking_noise": {"kind": "white", "level_dbfs": -40},
         "cues": [{"moment": "begin", "frequency_hz": 800, "level_dbfs": -40}], )",
      R"("masking_noise": {"kind": "none"}, )");
  const Sound sound = sound_of(study, &block_of(study));
  EXPECT_EQ(sound.masking_noise.kind, MaskingNoise::Kind::kNone);
  EXPECT_EQ(sound.cues, study.sound.cues);
  EXPECT_EQ(sounds_of(study).size(), 2U);
  EXPECT_TRUE(has_sound(study));
  EXPECT_FALSE(requires_sound(study));
}

TEST(Sound, AnEmptyListOfCuesIsNone) {
  const Study study =
      study_with(R"("cues": [{"moment": "begin", "frequency_hz": 800, "level_dbfs": -40}], )",
                 R"("cues": [], )");
  EXPECT_TRUE(sound_of(study, &block_of(study)).is_silent());
}

TEST(Sound, AStudyThatSaysNothingIsSilent) {
  const Study study = study_with("");
  EXPECT_FALSE(has_sound(study));
  EXPECT_FALSE(requires_sound(study));
  EXPECT_EQ(sounds_of(study).size(), 1U);
}

}  // namespace sound_test
}  // namespace jnd::experiments
