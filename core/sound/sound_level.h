#pragma once

#include <cmath>
#include <numbers>

namespace jnd::core {

// Levels of sound in samples of -1 to 1. A sine of full scale, whose peaks are 1, has the level
// 0 dBFS (AES17-2020), and whatever has its root mean square, too. Real time.

/// Root mean square of a sound of this level.
[[nodiscard]] inline double rms_of_level(double level_dbfs) noexcept {
  return std::pow(10.0, level_dbfs / 20.0) / std::numbers::sqrt2;
}

/// Level of a sound with this root mean square, >= 0; minus infinity of silence.
[[nodiscard]] inline double level_of_rms(double rms) noexcept {
  return 20.0 * std::log10(rms * std::numbers::sqrt2);
}

/// No noise of this program is louder. Samples of a normal distribution come to the limiter's
/// ceiling with it beyond seven times their root mean square: once in some months.
inline constexpr double kLoudestNoise_dbfs = -15.0;
/// No cue is louder: over the loudest noise the limiter's ceiling is then still five times the
/// noise's root mean square away.
inline constexpr double kLoudestCue_dbfs = -12.0;
/// What no study may ask for, and no output is sent: 85 dB(A) over eight hours is the limit
/// that NIOSH recommends for workers (publication 98-126, 1998).
inline constexpr double kLoudest_db_spl = 85.0;

}  // namespace jnd::core
