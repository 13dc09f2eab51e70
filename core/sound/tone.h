#pragma once

#include <vector>

namespace jnd::core {

/// A short tone that serves as a cue.
struct Tone {
  double frequency_hz = 1000.0;  ///< (0, rate / 2).
  double duration_s = 0.1;       ///< [0.02, 2].
  double level_dbfs = -40.0;     ///< Level of the steady part, at most `kLoudestCue_dbfs`.

  friend bool operator==(const Tone&, const Tone&) = default;
};

/// Duration of a tone's rise and of its fall. Each is half a cosine, so that the tone does not
/// click.
inline constexpr double kToneRamp_s = 0.010;

/// Returns the samples of a sine with both ramps within its duration. Throws `Error` for what
/// is out of range. Not real time.
[[nodiscard]] std::vector<float> samples_of(const Tone& tone, double rate_hz);

}  // namespace jnd::core
