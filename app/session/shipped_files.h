#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// Where the shipped studies, laboratories and published values are: the folder named by the
/// environment variable JND_SHARE, beside the installed program, or in the source tree.
[[nodiscard]] std::filesystem::path shipped_folder();

/// Where the window's languages are, LANGUAGE/LC_MESSAGES/jnd.mo: beside the program in a tree
/// that it was built in, else among the shipped files.
[[nodiscard]] std::filesystem::path languages_folder();

/// A file that the user named, or a shipped one: "short_tour" and "protocols/short_tour.json"
/// both find the shipped study. `folder` is "protocols" or "data/laboratories". Returns the
/// name as it is if nothing is found, for the reader to complain about; where the name is
/// nearly that of a shipped file, it throws `Error` with that name, unless `keep_near` is set.
[[nodiscard]] std::filesystem::path user_or_shipped(const std::string& name,
                                                    const std::string& folder,
                                                    bool keep_near = false);

}  // namespace jnd::app
