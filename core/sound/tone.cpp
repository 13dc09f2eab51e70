#include "core/sound/tone.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/require.h"
#include "core/sound/sound_level.h"

namespace jnd::core {

std::vector<float> samples_of(const Tone& tone, double rate_hz) {
  require_positive(rate_hz, "rate_hz");
  require(tone.frequency_hz > 0.0 && tone.frequency_hz < rate_hz / 2.0, "frequency_hz",
          "a frequency below half of the rate", tone.frequency_hz);
  require(tone.duration_s >= 2.0 * kToneRamp_s && tone.duration_s <= 2.0, "duration_s",
          "a time in [0.02, 2] s", tone.duration_s);
  require(tone.level_dbfs <= kLoudestCue_dbfs, "level_dbfs", "a level of at most -12 dBFS",
          tone.level_dbfs);
  const double amplitude = std::numbers::sqrt2 * rms_of_level(tone.level_dbfs);
  std::vector<float> samples(static_cast<std::size_t>(std::lround(tone.duration_s * rate_hz)));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double since_s = static_cast<double>(i) / rate_hz;
    const double left_s = static_cast<double>(samples.size() - i) / rate_hz;
    const double on = std::min({1.0, since_s / kToneRamp_s, left_s / kToneRamp_s});
    const double envelope = 0.5 - 0.5 * std::cos(std::numbers::pi * on);
    samples[i] = static_cast<float>(
        amplitude * envelope * std::sin(2.0 * std::numbers::pi * tone.frequency_hz * since_s));
  }
  return samples;
}

}  // namespace jnd::core
