#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace jnd::experiments {

/// Returns a text from a file as a message shows it: on one line, in UTF-8 whatever the bytes
/// are, and cut after about `most_characters` with "...". Quotes, backslashes and control
/// characters are written as in JSON, and a byte that is not UTF-8 as \xFF.
[[nodiscard]] std::string shown_text(std::string_view text, std::size_t most_characters = 40);

/// Returns the same for a JSON pointer. Each key is shortened and none is escaped again, so a
/// short pointer does not change.
[[nodiscard]] std::string shortened_pointer(std::string_view pointer);

}  // namespace jnd::experiments
