#pragma once

#include <cmath>
#include <numbers>

namespace jnd::core {

// Levels of sound in samples of -1 to 1. A sine of full scale, whose peaks are 1, has the level
// 0 dBFS (AES17-2020), and so has any sound with the same root mean square. Real time.

/// Returns the root mean square of a sound of this level.
[[nodiscard]] inline double rms_of_level(double level_dbfs) noexcept {
  return std::pow(10.0, level_dbfs / 20.0) / std::numbers::sqrt2;
}

/// Returns the level of a sound with this root mean square, >= 0. Silence gives minus infinity.
[[nodiscard]] inline double level_of_rms(double rms) noexcept {
  return 20.0 * std::log10(rms * std::numbers::sqrt2);
}

/// The loudest noise of this program. Normally distributed noise of this level reaches the
/// limiter's ceiling beyond seven times its root mean square, which happens once in some
/// months.
inline constexpr double kLoudestNoise_dbfs = -15.0;
/// The loudest cue. Over the loudest noise, the limiter's ceiling is then still five times the
/// noise's root mean square away.
inline constexpr double kLoudestCue_dbfs = -12.0;
/// The loudest sound that a study may ask for and that is sent to an output. NIOSH recommends
/// 85 dB(A) over eight hours as the limit for workers (publication 98-126, 1998).
inline constexpr double kLoudest_db_spl = 85.0;

}  // namespace jnd::core
