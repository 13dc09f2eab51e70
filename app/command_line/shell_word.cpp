#include "app/command_line/shell_word.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace jnd::app {

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    if (letter == '\'') {
      quoted += "'\\''";
    } else {
      quoted += letter == '\n' ? ' ' : letter;
    }
  }
  return quoted + "'";
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlainSigns = "/._-+=:@,";
  const bool is_plain = !text.empty() && std::ranges::all_of(text, [&](unsigned char letter) {
    return (letter < 0x80 && std::isalnum(letter) != 0) ||
           kPlainSigns.find(static_cast<char>(letter)) != std::string_view::npos;
  });
  return is_plain ? text : shell_quoted(text);
}

}  // namespace jnd::app
