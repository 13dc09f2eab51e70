#pragma once

#include <string>

namespace jnd::app {

/// A text in single quotes, as bash, zsh and sh read it; an end of line is a blank.
[[nodiscard]] std::string shell_quoted(const std::string& text);

/// The same, but without quotes where the text needs none.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace jnd::app
