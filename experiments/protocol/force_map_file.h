#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/media/force_map.h"

namespace jnd::experiments {

/// Reads a table whose first line is
/// `angle_of_attack_rad,speed_m_per_s,drag_coefficient,lift_coefficient`. Lines that begin with
/// `#` are comments. Throws `core::Error` naming file, line and problem. Not real time.
[[nodiscard]] core::ForceMap read_force_map(const std::filesystem::path& file);

/// Does the same for a text. `file_name` is for messages.
[[nodiscard]] core::ForceMap parse_force_map(std::string_view text,
                                             const std::string& file_name);

}  // namespace jnd::experiments
