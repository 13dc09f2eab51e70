#pragma once

#include <string_view>

#include "device/exoskeleton/exoskeleton_device.h"

namespace jnd::device {

/// What may follow "exoskeleton:" on the command line, for the help text.
inline constexpr std::string_view kExoskeletonOptions = "OPTION,...";

/// Returns the defaults, changed by a list with commas: "feed-forward=K" (gain of the measured
/// force), "compensated" (the rendered force times 1 + K), "arm-locked" (the arm's joints do
/// not move). "" changes nothing. Throws `core::Error` for anything else. Not real time.
[[nodiscard]] ExoskeletonDevice::Parameters exoskeleton_parameters(std::string_view options);

}  // namespace jnd::device
