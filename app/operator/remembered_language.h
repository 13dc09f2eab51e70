#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// Stores the language that somebody chose in the window, such as "de", for the next start of
/// the program. It is one word in a file of this folder, where `RecentStudies::default_file`
/// is, too. If the folder is "" or cannot be written, nothing is stored. Not real time.
void remember_language(const std::filesystem::path& folder, const std::string& code);
/// "" if nobody chose a language, or if the file contains anything but a language's code.
[[nodiscard]] std::string remembered_language(const std::filesystem::path& folder);

}  // namespace jnd::app
