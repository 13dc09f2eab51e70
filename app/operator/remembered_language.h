#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// The language that somebody chose in the window ("de"), for the next start of the program.
/// Kept as one word in a file of this folder (`RecentStudies::default_file` is beside it).
/// Where the folder is "", or cannot be written, nothing is kept. Not real time.
void remember_language(const std::filesystem::path& folder, const std::string& code);
/// "" where nobody chose one, or where the file holds anything but the code of a language.
[[nodiscard]] std::string remembered_language(const std::filesystem::path& folder);

}  // namespace jnd::app
