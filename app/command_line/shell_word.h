#pragma once

#include <string>

namespace jnd::app {

/// A text in single quotes, as bash, zsh and sh read it; a line end becomes a blank.
[[nodiscard]] std::string shell_quoted(const std::string& text);

/// The same, but without quotes if the text needs none.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace jnd::app
