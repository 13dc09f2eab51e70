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

/// A level in samples. Throws `Error` where a sound pressure level is asked of an output that
/// is not calibrated, and where it would come to more than `loudest_dbfs`, or to more than
/// `core::kLoudest_db_spl` at the ear.
[[nodiscard]] double level_dbfs_of(const experiments::SoundLevel& level,
                                   const std::optional<SoundCalibration>& calibration,
                                   double loudest_dbfs);
/// The same of a noise, by what noise can be at most.
[[nodiscard]] double noise_level_dbfs(const experiments::MaskingNoise& noise,
                                      const std::optional<SoundCalibration>& calibration);
[[nodiscard]] core::NoiseShape shape_of(const experiments::MaskingNoise& noise);

/// What a study lets hear, as a mixer takes it: every noise and tone once.
struct SoundPlan {
  /// In a block, or outside of all.
  struct Part {
    experiments::Sound sound;
    int noise = core::SoundMixer::kNoNoise;
    std::array<std::optional<std::size_t>, 3> cues{};  ///< By moment.
  };
  std::vector<core::LevelledNoise> noises;
  std::vector<core::Tone> cues;
  std::vector<Part> parts;

  /// That sounds so; never fails for a sound of the study.
  [[nodiscard]] const Part& part_of(const experiments::Sound& sound) const;
};

/// Throws as `level_dbfs_of`, naming what cannot be heard.
[[nodiscard]] SoundPlan sound_plan(const experiments::Study& study,
                                   const std::optional<SoundCalibration>& calibration);

/// How loud it all is, a sentence for the study's noise and one for its cues, and the same for
/// blocks that sound otherwise. Throws as `sound_plan`.
[[nodiscard]] std::vector<std::string> sound_level_words(
    const experiments::Study& study, const std::optional<SoundCalibration>& calibration);

}  // namespace jnd::app
