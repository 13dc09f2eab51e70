#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// Units of the fixed-point numbers in a recording.
inline constexpr double kPositionUnitM = 1e-7;      ///< 0.1 um
inline constexpr double kVelocityUnitMPerS = 1e-4;  ///< 0.1 mm/s
inline constexpr double kForceUnitN = 1e-3;         ///< 1 mN
inline constexpr double kJointPositionUnitRad = 1e-6;
inline constexpr double kJointTorqueUnitNM = 1e-4;
inline constexpr double kOrientationUnit = 1e-6;

/// Encodes samples of consecutive ticks as bytes: fixed-point numbers, tips relative to the
/// first tip, second differences, byte planes, zstd. The joints' channels are left out if all
/// joints are 0. If any sample has a monotonic time, the two times of all samples follow as a
/// zstd frame of their own, in whole microseconds. If the device measures more
/// (`DeviceChannels`), those channels follow as a third frame, and the times are always there.
/// A value that is not finite comes back as NaN, and one beyond the range of 32 bits as the
/// largest number. Missed ticks are not encoded. Not real time.
[[nodiscard]] std::string encode_samples(const std::vector<Sample>& samples);

/// Decodes the samples, to half a unit. Throws `Error` naming `place` if the bytes are damaged.
[[nodiscard]] std::vector<Sample> decode_samples(std::string_view bytes,
                                                 std::int64_t first_tick,
                                                 std::int64_t num_samples,
                                                 const std::string& place);

}  // namespace jnd::core
