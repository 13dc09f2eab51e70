#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// Remembers an emergency stop of a device that nobody has released yet, so that it holds for
/// the next session and the next start of the program as well. It is a file in one of the
/// user's folders, and on disk when `remember_stop` returns. If the folder is "" or cannot be
/// written, nothing is stored; the stop itself holds in any case until the program ends. Not
/// real time.
void remember_stop(const std::filesystem::path& folder, const std::string& device);
void forget_stop(const std::filesystem::path& folder, const std::string& device);
[[nodiscard]] bool is_stop_remembered(const std::filesystem::path& folder,
                                      const std::string& device);

/// The user's folder for this: in XDG_STATE_HOME, otherwise in ~/.local/state; "" if there is
/// no home folder.
[[nodiscard]] std::filesystem::path stops_folder();

}  // namespace jnd::app
