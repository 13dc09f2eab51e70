#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/device_profile/device_profile.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Reads a device profile. Throws `ProtocolError` with every problem of the file, in the order
/// in which they stand in it. One such problem is a measured number that was edited. It does
/// not check whether the profile is valid today or for a particular device. Not real time.
[[nodiscard]] DeviceProfile read_device_profile(const std::filesystem::path& file);

/// Reads a profile from its text. `file_name` is for messages.
[[nodiscard]] DeviceProfile read_device_profile_text(const std::string& text,
                                                     const std::string& file_name);

/// Return every problem without throwing; none for a valid profile.
[[nodiscard]] std::vector<StudyProblem> device_profile_problems(
    const std::filesystem::path& file);
[[nodiscard]] std::vector<StudyProblem> device_profile_text_problems(
    const std::string& text, const std::string& file_name);

}  // namespace jnd::experiments
