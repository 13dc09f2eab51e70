#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace jnd::experiments {

/// Text out of a file as a message shows it: on one line, in UTF-8 whatever the bytes are, and
/// no longer than about `most_characters`, then "...". Quotes, backslashes and control
/// characters are written as in JSON, a byte that is not UTF-8 as \xFF.
[[nodiscard]] std::string shown_text(std::string_view text, std::size_t most_characters = 40);

/// The same for a JSON pointer, of which each key is shortened and none escaped again: short
/// pointers stay pointers.
[[nodiscard]] std::string shortened_pointer(std::string_view pointer);

}  // namespace jnd::experiments
