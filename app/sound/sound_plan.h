#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/sound/sound_settings.h"
#include "core/sound/sound_mixer.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// A level in dB re full scale. Throws `Error` if a sound pressure level is asked of an output
/// that is not calibrated, or if the level would be more than `loudest_dbfs` or more than
/// `core::kLoudest_db_spl` at the ear.
[[nodiscard]] double level_dbfs_of(const experiments::SoundLevel& level,
                                   const std::optional<SoundCalibration>& calibration,
                                   double loudest_dbfs);
/// The level of a noise, limited by the most that noise may have.
[[nodiscard]] double noise_level_dbfs(const experiments::MaskingNoise& noise,
                                      const std::optional<SoundCalibration>& calibration);
[[nodiscard]] core::NoiseShape shape_of(const experiments::MaskingNoise& noise);

/// What a study lets people hear, as a mixer takes it; every noise and tone occurs once.
struct SoundPlan {
  /// The sound of a block, or the one outside of blocks.
  struct Part {
    experiments::Sound sound;
    int noise = core::SoundMixer::kNoNoise;
    /// The index in the plan's `cues` for each `CueMoment`; empty if that moment has no cue.
    std::array<std::optional<std::size_t>, 3> cues{};
  };
  std::vector<core::LevelledNoise> noises;
  std::vector<core::Tone> cues;
  std::vector<Part> parts;

  /// The part with this sound; every sound of the study has one.
  [[nodiscard]] const Part& part_of(const experiments::Sound& sound) const;
};

/// Throws as `level_dbfs_of` does, and names what cannot be heard.
[[nodiscard]] SoundPlan sound_plan(const experiments::Study& study,
                                   const std::optional<SoundCalibration>& calibration);

/// How loud everything is: one sentence for the study's noise, one for its cues, and more for
/// blocks with other sounds. Throws as `sound_plan` does.
[[nodiscard]] std::vector<std::string> sound_level_words(
    const experiments::Study& study, const std::optional<SoundCalibration>& calibration);

}  // namespace jnd::app
