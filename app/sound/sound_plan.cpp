#include "app/sound/sound_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/language/words.h"
#include "core/error.h"
#include "core/sound/sound_level.h"

namespace jnd::app {

using experiments::MaskingNoise;
using experiments::Sound;
using experiments::SoundLevel;

double level_dbfs_of(const SoundLevel& level,
                     const std::optional<SoundCalibration>& calibration, double loudest_dbfs) {
  if (level.level_db_spl && !calibration) {
    throw core::Error(fmt::format(
        "expected an output that is calibrated, for {:g} dB SPL are asked for, found one that "
        "is not; measure it with `jnd sound --calibrate`",
        *level.level_db_spl));
  }
  const double dbfs = level.level_db_spl ? *level.level_db_spl - calibration->full_scale_db_spl
                                         : level.level_dbfs.value_or(-120.0);
  if (!(dbfs <= loudest_dbfs)) {
    throw core::Error(fmt::format(
        "expected at most {:g} dB re full scale, so that nothing clips, found {:.1f}; ask for "
        "less, or turn the amplifier up and calibrate anew",
        loudest_dbfs, dbfs));
  }
  if (calibration && !(dbfs + calibration->full_scale_db_spl <= core::kLoudest_db_spl + 1e-9)) {
    throw core::Error(
        fmt::format("expected at most {:g} dB SPL, which ears stand for a working day, found "
                    "{:.1f}; ask for less",
                    core::kLoudest_db_spl, dbfs + calibration->full_scale_db_spl));
  }
  return dbfs;
}

double noise_level_dbfs(const MaskingNoise& noise,
                        const std::optional<SoundCalibration>& calibration) {
  return level_dbfs_of(noise.level, calibration, core::kLoudestNoise_dbfs);
}

core::NoiseShape shape_of(const MaskingNoise& noise) {
  using Kind = core::NoiseShape::Kind;
  return {.kind = noise.kind == MaskingNoise::Kind::kPink   ? Kind::kPink
                  : noise.kind == MaskingNoise::Kind::kBand ? Kind::kBand
                                                            : Kind::kWhite,
          .low_hz = noise.low_hz,
          .high_hz = noise.high_hz};
}

const SoundPlan::Part& SoundPlan::part_of(const Sound& sound) const {
  const auto found = std::ranges::find(parts, sound, &Part::sound);
  if (found == parts.end()) throw core::Error("sound: expected one of the study's");
  return *found;
}

SoundPlan sound_plan(const experiments::Study& study,
                     const std::optional<SoundCalibration>& calibration) {
  const auto named = [](const std::string& what, const auto& level) {
    try {
      return level();
    } catch (const core::Error& error) {
      throw core::Error(what + ": " + error.what());
    }
  };
  SoundPlan plan;
  for (const Sound& sound : experiments::sounds_of(study)) {
    SoundPlan::Part part{.sound = sound};
    if (sound.masking_noise.kind != MaskingNoise::Kind::kNone) {
      const auto known = std::ranges::find_if(plan.parts, [&](const SoundPlan::Part& one) {
        return one.sound.masking_noise == sound.masking_noise;
      });
      const double level_dbfs = named(
          "masking noise", [&] { return noise_level_dbfs(sound.masking_noise, calibration); });
      part.noise =
          known == plan.parts.end() ? static_cast<int>(plan.noises.size()) : known->noise;
      if (known == plan.parts.end()) {
        plan.noises.push_back(
            {.shape = shape_of(sound.masking_noise), .level_dbfs = level_dbfs});
      }
    }
    for (const experiments::Cue& cue : sound.cues) {
      const core::Tone tone{
          .frequency_hz = cue.frequency_hz,
          .duration_s = cue.duration_s,
          .level_dbfs = named("cue `" + std::string(experiments::name(cue.moment)) + "`", [&] {
            return level_dbfs_of(cue.level, calibration, core::kLoudestCue_dbfs);
          })};
      const auto known = std::ranges::find(plan.cues, tone);
      part.cues[static_cast<std::size_t>(cue.moment)] =
          static_cast<std::size_t>(known - plan.cues.begin());
      if (known == plan.cues.end()) plan.cues.push_back(tone);
    }
    plan.parts.push_back(std::move(part));
  }
  return plan;
}

namespace {

std::string level_in_words(double level_dbfs,
                           const std::optional<SoundCalibration>& calibration) {
  if (!calibration) return tr("{:.1f} dB re full scale", level_dbfs);
  return tr("{:.1f} dB SPL, {:.1f} dB re full scale",
            level_dbfs + calibration->full_scale_db_spl, level_dbfs);
}

std::string noise_in_words(const MaskingNoise& noise, const std::string& level) {
  switch (noise.kind) {
    case MaskingNoise::Kind::kWhite:
      return tr("White noise, {}.", level);
    case MaskingNoise::Kind::kPink:
      return tr("Pink noise, {}.", level);
    case MaskingNoise::Kind::kBand:
      return tr("Noise from {:g} to {:g} Hz, {}.", noise.low_hz, noise.high_hz, level);
    case MaskingNoise::Kind::kNone:
      break;
  }
  return "";
}

}  // namespace

std::vector<std::string> sound_level_words(const experiments::Study& study,
                                           const std::optional<SoundCalibration>& calibration) {
  const SoundPlan plan = sound_plan(study, calibration);
  std::vector<std::string> found;
  const auto add = [&found](std::string words) {
    if (std::ranges::find(found, words) == found.end()) found.push_back(std::move(words));
  };
  for (const SoundPlan::Part& part : plan.parts) {
    if (part.noise != core::SoundMixer::kNoNoise) {
      const double dbfs = plan.noises[static_cast<std::size_t>(part.noise)].level_dbfs;
      add(noise_in_words(part.sound.masking_noise, level_in_words(dbfs, calibration)));
    }
    for (const experiments::Cue& cue : part.sound.cues) {
      const double dbfs =
          plan.cues[*part.cues[static_cast<std::size_t>(cue.moment)]].level_dbfs;
      const std::string level = level_in_words(dbfs, calibration);
      add(cue.moment == experiments::CueMoment::kReady
              ? tr("Cue for a trial that can begin, {:g} Hz, {}.", cue.frequency_hz, level)
          : cue.moment == experiments::CueMoment::kBegin
              ? tr("Cue for a stimulus that begins, {:g} Hz, {}.", cue.frequency_hz, level)
              : tr("Cue for a stimulus that ends, {:g} Hz, {}.", cue.frequency_hz, level));
    }
  }
  return found;
}

}  // namespace jnd::app
