#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace jnd::experiments {

struct Block;
struct Study;

/// How loud something is: as a sound pressure level at the ear, or as the level of the samples.
/// One of them.
struct SoundLevel {
  std::optional<double> level_db_spl;  ///< Re 20 uPa; an output has to be calibrated for it.
  std::optional<double> level_dbfs;    ///< Re a sine of full scale.

  friend bool operator==(const SoundLevel&, const SoundLevel&) = default;
};

/// Noise that goes on as long as a session does, or a block.
struct MaskingNoise {
  enum class Kind { kNone, kWhite, kPink, kBand };
  Kind kind = Kind::kNone;
  SoundLevel level;                    ///< Of its root mean square.
  double low_hz = 0.0, high_hz = 0.0;  ///< Of a band.
  double ramp_s = 0.5;                 ///< In which it comes and goes, > 0.
  bool required = false;               ///< No session begins without it.

  friend bool operator==(const MaskingNoise&, const MaskingNoise&) = default;
};

/// Of which moment of a trial a cue tells.
enum class CueMoment {
  kReady,  ///< The next trial can begin.
  kBegin,  ///< A stimulus begins.
  kEnd,    ///< It is over, and none follows at once.
};
inline constexpr CueMoment kCueMoments[] = {CueMoment::kReady, CueMoment::kBegin,
                                            CueMoment::kEnd};
/// "ready", "begin" or "end".
[[nodiscard]] std::string_view name(CueMoment moment) noexcept;

/// A tone, the same whatever the stimulus is.
struct Cue {
  CueMoment moment = CueMoment::kBegin;
  double frequency_hz = 1000.0;
  double duration_s = 0.1;
  SoundLevel level;
  bool required = false;  ///< No session begins without it.

  friend bool operator==(const Cue&, const Cue&) = default;
};

/// What can be heard in a study, or in one of its blocks.
struct Sound {
  MaskingNoise masking_noise;
  std::vector<Cue> cues;  ///< At most one of each moment.

  [[nodiscard]] bool is_silent() const noexcept {
    return masking_noise.kind == MaskingNoise::Kind::kNone && cues.empty();
  }
  [[nodiscard]] bool is_required() const noexcept;
  /// The cue of a moment; nullptr where there is none.
  [[nodiscard]] const Cue* cue_of(CueMoment moment) const noexcept;

  friend bool operator==(const Sound&, const Sound&) = default;
};

/// What is heard in a block: its own where it says so, else the study's. Outside of blocks,
/// `block` is nullptr.
[[nodiscard]] Sound sound_of(const Study& study, const Block* block);
/// The study's own and those of its blocks, each once; the study's first.
[[nodiscard]] std::vector<Sound> sounds_of(const Study& study);
/// Something is heard in this study, or has to be.
[[nodiscard]] bool has_sound(const Study& study);
[[nodiscard]] bool requires_sound(const Study& study);

}  // namespace jnd::experiments
