#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// Units of the fixed-point numbers a recording is made of.
inline constexpr double kPositionUnitM = 1e-7;      ///< 0.1 um
inline constexpr double kVelocityUnitMPerS = 1e-4;  ///< 0.1 mm/s
inline constexpr double kForceUnitN = 1e-3;         ///< 1 mN
inline constexpr double kJointPositionUnitRad = 1e-6;
inline constexpr double kJointTorqueUnitNM = 1e-4;
inline constexpr double kOrientationUnit = 1e-6;

/// Samples of consecutive ticks as bytes: fixed point, tips relative to the first tip, second
/// differences, byte planes, zstd; the joints' channels only if one of them is not 0. Where any
/// sample has a monotonic time, the two times of all follow as a frame of zstd of their own, in
/// whole microseconds. Where the device measures more (`DeviceChannels`), those channels follow
/// as a third frame, and the times are there in any case. A value that is not finite comes back
/// as NaN; one beyond the range of 32 bits comes back as the largest. Which ticks were missed
/// is not among the bytes. Not real time.
[[nodiscard]] std::string encode_samples(const std::vector<Sample>& samples);

/// The inverse, to half a unit. Throws `Error` naming `place` if the bytes are damaged.
[[nodiscard]] std::vector<Sample> decode_samples(std::string_view bytes,
                                                 std::int64_t first_tick,
                                                 std::int64_t num_samples,
                                                 const std::string& place);

}  // namespace jnd::core
