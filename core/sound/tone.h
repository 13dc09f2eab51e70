#pragma once

#include <vector>

namespace jnd::core {

/// A short tone, as a cue is one.
struct Tone {
  double frequency_hz = 1000.0;  ///< (0, rate / 2).
  double duration_s = 0.1;       ///< [0.02, 2].
  double level_dbfs = -40.0;     ///< Of its steady part, at most `kLoudestCue_dbfs`.

  friend bool operator==(const Tone&, const Tone&) = default;
};

/// How long a tone takes to come up, and to go: the half of a cosine, so that it does not
/// click.
inline constexpr double kToneRamp_s = 0.010;

/// The samples of a sine with both ramps inside of its duration. Throws `Error` for what is out
/// of range. Not real time.
[[nodiscard]] std::vector<float> samples_of(const Tone& tone, double rate_hz);

}  // namespace jnd::core
