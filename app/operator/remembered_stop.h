#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// Remembers an emergency stop of a device that nobody has released yet, so that it holds for
/// the next session and the next start of the program as well. It is a file in one of the
/// user's folders, and on disk when `remember_stop` returns. If the folder is "" or cannot be
/// written, nothing is stored; the stop itself holds in any case until the program ends. A
/// device is the same however its name is spelt (`device::canonical_name`). Not real time.
void remember_stop(const std::filesystem::path& folder, const std::string& device);
void forget_stop(const std::filesystem::path& folder, const std::string& device);
[[nodiscard]] bool is_stop_remembered(const std::filesystem::path& folder,
                                      const std::string& device);

/// Of a real device that a command is about to arm without a window: throws `core::Error` while
/// a stop of it is remembered, unless somebody `releases` it. It is `forget_stop` that forgets
/// it then, as the last act before arming: a command that fails at something else leaves it.
void require_stop_released(const std::filesystem::path& folder, const std::string& device,
                           bool releases);

/// The user's folder for it: in XDG_STATE_HOME, else ~/.local/state; "" if there is no home.
[[nodiscard]] std::filesystem::path stops_folder();

}  // namespace jnd::app
