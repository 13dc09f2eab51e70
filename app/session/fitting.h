#pragma once

#include <map>
#include <string>
#include <vector>

namespace jnd::app {

/// How the device was fitted to a person, of pairs as "glove=M". Throws `core::Error` for what
/// is no pair, and a key that is no name or was given twice; `place` says where they are from.
[[nodiscard]] std::map<std::string, std::string> fitting_of(
    const std::vector<std::string>& pairs, const std::string& place);

/// The same as somebody writes it in one line: "glove=M, thumb=thin pad"; nothing for none.
[[nodiscard]] std::map<std::string, std::string> fitting_in(const std::string& line,
                                                            const std::string& place);

/// Whether it is such a line.
[[nodiscard]] bool is_fitting(const std::string& line);

/// That line.
[[nodiscard]] std::string fitting_line(const std::map<std::string, std::string>& fitting);

}  // namespace jnd::app
