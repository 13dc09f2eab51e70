#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/profile/known_profile.h"
#include "experiments/study/study_problem.h"

namespace jnd::app {

/// What speaks against running a valid study on a device, each at its place in the file: every
/// stimulus that the device cannot render to a hand of this speed, or not stably, and contact
/// points that it lacks. If there is a profile, it decides. Throws `core::Error` for a device
/// that does not exist. Not real time.
[[nodiscard]] std::vector<experiments::StudyProblem> device_problems(
    const std::filesystem::path& study_file, const std::string& device,
    const std::optional<KnownProfile>& profile, double expected_speed_m_per_s);

/// Stimuli that hardly any device can render, in a study without problems. Throws `core::Error`
/// if the study cannot be read.
[[nodiscard]] std::vector<experiments::StudyProblem> force_doubts(
    const std::filesystem::path& study_file, double expected_speed_m_per_s);

}  // namespace jnd::app
