#include "experiments/study/shown_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace jnd::experiments {
namespace {

/// A character in UTF-8 (RFC 3629).
struct Character {
  std::size_t num_bytes = 0;  ///< 0 for a byte that begins no character.
  std::uint32_t code_point = 0;
};

Character first_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {1, lead};
  const std::size_t num_bytes = lead >> 5 == 0x06 ? 2 : lead >> 4 == 0x0E ? 3 : 4;
  if ((num_bytes == 4 && lead >> 3 != 0x1E) || num_bytes > text.size()) return {};
  std::uint32_t code_point = lead & (0xFFU >> (num_bytes + 1));
  for (std::size_t i = 1; i < num_bytes; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0) != 0x80) return {};
    code_point = code_point << 6 | (byte & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code_point >= 0xD800 && code_point <= 0xDFFF;
  if (code_point < kSmallest[num_bytes] || is_surrogate || code_point > 0x10FFFF) return {};
  return {num_bytes, code_point};
}

/// Whether a terminal would obey the character, or reverse the line, instead of showing it.
bool is_control(std::uint32_t code_point) {
  return code_point < 0x20 || (code_point >= 0x7F && code_point < 0xA0) ||
         (code_point >= 0x2028 && code_point <= 0x202E) ||
         (code_point >= 0x2066 && code_point <= 0x2069);
}

std::string hexadecimal(std::uint32_t value, int num_digits) {
  std::string digits;
  for (int place = num_digits - 1; place >= 0; --place) {
    digits += "0123456789ABCDEF"[(value >> (4 * place)) & 0xFU];
  }
  return digits;
}

std::string shown(std::string_view bytes, const Character& character) {
  if (character.num_bytes == 0) {
    return "\\x" + hexadecimal(static_cast<unsigned char>(bytes.front()), 2);
  }
  switch (character.code_point) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    default:
      return is_control(character.code_point)
                 ? "\\u" + hexadecimal(character.code_point, 4)
                 : std::string(bytes.substr(0, character.num_bytes));
  }
}

}  // namespace

std::string shown_text(std::string_view text, std::size_t most_characters) {
  std::string result;
  for (std::size_t num_shown = 0; !text.empty();) {
    const Character character = first_character(text);
    const std::string next = shown(text, character);
    num_shown += character.num_bytes > 1 ? 1 : next.size();
    if (num_shown > most_characters) return result + "...";
    result += next;
    text.remove_prefix(std::max<std::size_t>(1, character.num_bytes));
  }
  return result;
}

std::string shortened_pointer(std::string_view pointer) {
  constexpr std::size_t kLongest = 60;
  std::string result;
  while (!pointer.empty()) {
    const std::string_view token = pointer.substr(0, pointer.find('/', 1));
    std::size_t end = std::min(token.size(), kLongest);
    if (end < token.size()) {  // The text must not be cut in the middle of a UTF-8 character.
      while ((static_cast<unsigned char>(token[end]) & 0xC0) == 0x80) --end;
    }
    result += token.substr(0, end);
    if (end < token.size()) result += "...";
    pointer.remove_prefix(token.size());
  }
  return result;
}

}  // namespace jnd::experiments
