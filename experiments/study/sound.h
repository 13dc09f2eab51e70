#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace jnd::experiments {

struct Block;
struct Study;

/// The level of a sound, either as a sound pressure level at the ear or as the level of the
/// samples.
struct SoundLevel {
  std::optional<double> level_db_spl;  ///< Re 20 uPa; it requires a calibrated output.
  std::optional<double> level_dbfs;    ///< Re a sine of full scale.

  friend bool operator==(const SoundLevel&, const SoundLevel&) = default;
};

/// Noise that plays during a whole session, or during a block.
struct MaskingNoise {
  enum class Kind { kNone, kWhite, kPink, kBand };
  Kind kind = Kind::kNone;
  SoundLevel level;                    ///< Level of its root mean square.
  double low_hz = 0.0, high_hz = 0.0;  ///< For a band.
  double ramp_s = 0.5;                 ///< Duration of its rise and fall, > 0.
  bool required = false;               ///< No session begins without it.

  friend bool operator==(const MaskingNoise&, const MaskingNoise&) = default;
};

/// The moment of a trial that a cue marks.
enum class CueMoment {
  kReady,  ///< The next trial can begin.
  kBegin,  ///< A stimulus begins.
  kEnd,    ///< A stimulus ends, and none follows at once.
};
inline constexpr CueMoment kCueMoments[] = {CueMoment::kReady, CueMoment::kBegin,
                                            CueMoment::kEnd};
/// Returns "ready", "begin" or "end".
[[nodiscard]] std::string_view name(CueMoment moment) noexcept;

/// A tone that is the same for all stimuli.
struct Cue {
  CueMoment moment = CueMoment::kBegin;
  double frequency_hz = 1000.0;
  double duration_s = 0.1;
  SoundLevel level;
  bool required = false;  ///< No session begins without it.

  friend bool operator==(const Cue&, const Cue&) = default;
};

/// What is heard in a study, or in one of its blocks.
struct Sound {
  MaskingNoise masking_noise;
  std::vector<Cue> cues;  ///< At most one for each moment.

  [[nodiscard]] bool is_silent() const noexcept {
    return masking_noise.kind == MaskingNoise::Kind::kNone && cues.empty();
  }
  [[nodiscard]] bool is_required() const noexcept;
  /// Returns the cue for a moment, or nullptr.
  [[nodiscard]] const Cue* cue_of(CueMoment moment) const noexcept;

  friend bool operator==(const Sound&, const Sound&) = default;
};

/// Returns what is heard in a block: its own sound if it has one, and otherwise the study's.
/// Outside of blocks, `block` is nullptr.
[[nodiscard]] Sound sound_of(const Study& study, const Block* block);
/// Returns the study's sound, then those of its blocks, each once.
[[nodiscard]] std::vector<Sound> sounds_of(const Study& study);
/// Whether something is heard in this study (`has_sound`), or must be (`requires_sound`).
[[nodiscard]] bool has_sound(const Study& study);
[[nodiscard]] bool requires_sound(const Study& study);

}  // namespace jnd::experiments
