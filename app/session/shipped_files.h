#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// The folder of the shipped studies, laboratories and published values: the one named by the
/// environment variable JND_SHARE, the one beside the installed program, or the source tree.
[[nodiscard]] std::filesystem::path shipped_folder();

/// The folder of the window's languages, with LANGUAGE/LC_MESSAGES/jnd.mo: beside the program
/// in the tree where it was built, or else among the shipped files.
[[nodiscard]] std::filesystem::path languages_folder();

/// A file that the user named, or a shipped one: "short_tour" and "protocols/short_tour.json"
/// both find the shipped study. `folder` is "protocols" or "data/laboratories". If nothing is
/// found, returns the name unchanged, so that the reader complains about it. If the name is
/// similar to that of a shipped file, throws `Error` with that name, unless `keep_near` is set.
[[nodiscard]] std::filesystem::path user_or_shipped(const std::string& name,
                                                    const std::string& folder,
                                                    bool keep_near = false);

}  // namespace jnd::app
