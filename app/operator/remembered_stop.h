#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// An emergency stop that nobody has released yet, of each device: it holds for the next
/// session and the next start of the program as well. Kept as a file in a folder of the user's,
/// on disk when `remember_stop` returns. Where the folder is "", or cannot be written, nothing
/// is kept: the stop itself holds either way until the program ends. Not real time.
void remember_stop(const std::filesystem::path& folder, const std::string& device);
void forget_stop(const std::filesystem::path& folder, const std::string& device);
[[nodiscard]] bool is_stop_remembered(const std::filesystem::path& folder,
                                      const std::string& device);

/// Of a real device that a command is about to arm without a window: throws `core::Error` while
/// a stop of it is remembered. Where somebody `releases` it, it is forgotten.
void require_stop_released(const std::filesystem::path& folder, const std::string& device,
                           bool releases);

/// The user's folder for it: in XDG_STATE_HOME, else ~/.local/state; "" if there is no home.
[[nodiscard]] std::filesystem::path stops_folder();

}  // namespace jnd::app
