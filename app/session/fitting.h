#pragma once

#include <map>
#include <string>
#include <vector>

namespace jnd::app {

/// How the device was fitted to a person, from pairs such as "glove=M". Throws `core::Error`
/// for anything that is no pair, and for a key that is no name or was given twice. `place` says
/// where the pairs come from.
[[nodiscard]] std::map<std::string, std::string> fitting_of(
    const std::vector<std::string>& pairs, const std::string& place);

/// The same from one line as somebody writes it: "glove=M, thumb=thin pad"; empty for an empty
/// line.
[[nodiscard]] std::map<std::string, std::string> fitting_in(const std::string& line,
                                                            const std::string& place);

/// Whether the text is such a line.
[[nodiscard]] bool is_fitting(const std::string& line);

/// The fitting as such a line.
[[nodiscard]] std::string fitting_line(const std::map<std::string, std::string>& fitting);

}  // namespace jnd::app
