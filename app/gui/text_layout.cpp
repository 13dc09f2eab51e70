#include "app/gui/text_layout.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// As many whole characters from the beginning as fit, but at least one.
std::size_t characters_that_fit(std::string_view text, float width, const Measure& measure) {
  std::size_t end = next_character(text, 0);
  while (end < text.size()) {
    const std::size_t next = next_character(text, end);
    if (measure(text.substr(0, next)) > width) break;
    end = next;
  }
  return end;
}

/// The end of the first line of `text`, which contains no line end.
std::size_t first_break(std::string_view text, float width, const Measure& measure) {
  std::size_t fits = 0;
  while (fits < text.size()) {
    std::size_t end = text.find(' ', fits + 1);
    if (end == std::string_view::npos) end = text.size();
    if (measure(text.substr(0, end)) > width) break;
    fits = end;
  }
  return fits > 0 ? fits : characters_that_fit(text, width, measure);
}

std::vector<std::string_view> break_greedily(std::string_view text, float width,
                                             const Measure& measure) {
  std::vector<std::string_view> lines;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string_view paragraph = text.substr(start, end - start);
    do {
      const std::size_t cut = first_break(paragraph, width, measure);
      lines.push_back(paragraph.substr(0, cut));
      paragraph.remove_prefix(cut);
      while (paragraph.starts_with(' ')) paragraph.remove_prefix(1);
    } while (!paragraph.empty());
    start = end + 1;
  }
  return lines;
}

/// The capital of a Latin letter whose UTF-8 code has two bytes. In Latin Extended-A, a capital
/// and its small letter have neighbouring codes.
std::uint32_t capital_of(std::uint32_t code_point) {
  if (code_point >= 0xe0 && code_point <= 0xfe && code_point != 0xf7) return code_point - 0x20;
  if (code_point == 0xff) return 0x178;
  const bool odd_is_small = (code_point >= 0x100 && code_point <= 0x137) ||
                            (code_point >= 0x14a && code_point <= 0x177);
  const bool even_is_small = (code_point >= 0x139 && code_point <= 0x148) ||
                             (code_point >= 0x179 && code_point <= 0x17e);
  if (odd_is_small && code_point % 2 == 1) return code_point - 1;
  if (even_is_small && code_point % 2 == 0) return code_point - 1;
  return code_point;
}

}  // namespace

std::size_t next_character(std::string_view text, std::size_t position) noexcept {
  if (position >= text.size()) return text.size();
  ++position;
  while (position < text.size() && continues_character(text[position])) ++position;
  return position;
}

std::vector<std::string_view> break_lines(std::string_view text, float width,
                                          const Measure& measure, bool balanced) {
  std::vector<std::string_view> lines = break_greedily(text, width, measure);
  if (!balanced || lines.size() < 2) return lines;
  float too_narrow = 0;
  float wide_enough = width;
  for (int step = 0; step < 8; ++step) {
    const float between = (too_narrow + wide_enough) / 2;
    std::vector<std::string_view> tried = break_greedily(text, between, measure);
    const bool fits =
        tried.size() == lines.size() && std::ranges::all_of(tried, [&](std::string_view line) {
          return measure(line) <= between;
        });
    (fits ? wide_enough : too_narrow) = between;
    if (fits) lines = std::move(tried);
  }
  return lines;
}

std::string shorten(std::string_view text, float width, const Measure& measure) {
  if (measure(text) <= width) return std::string(text);
  static constexpr std::string_view kEllipsis = "…";
  const float room = width - measure(kEllipsis);
  std::size_t fits = 0;
  for (std::size_t end = 0; end < text.size();) {
    end = next_character(text, end);
    if (measure(text.substr(0, end)) > room) break;
    fits = end;
  }
  while (fits > 0 && text[fits - 1] == ' ') --fits;
  return std::string(text.substr(0, fits)) + std::string(kEllipsis);
}

/// The whole unit that begins at this place; "" if there is none.
static std::string_view unit_at(std::string_view text, std::size_t at) {
  // A longer unit stands before the units that it begins with.
  constexpr std::string_view kUnits[] = {
      as_is("Pa s"), "N s/m",     "N/mm", "N/m", as_is("N mm"), "N m", "cm/s", "mm/s",
      "m/s",         "m/s²",      "mm",   "cm",  "µm",          "ms",  "µs",   "min",
      "kg",          as_is("Hz"), "rad",  "m",   "s",           "g",   "h"};
  // Nothing else than a unit is written like this, so it counts as one anywhere.
  constexpr std::string_view kAnywhere = as_is("Pa s");
  const auto is_letter = [&](std::size_t place) {
    if (place >= text.size()) return false;
    const auto byte = static_cast<unsigned char>(text[place]);
    return byte >= 0x80 || std::isalnum(byte) != 0;
  };
  if (at > 0 && is_letter(at - 1)) return "";
  const bool is_behind_number = at > 1 && text[at - 1] == ' ' &&
                                std::isdigit(static_cast<unsigned char>(text[at - 2])) != 0;
  const bool is_in_brackets = at > 0 && (text[at - 1] == '[' || text[at - 1] == '/');
  for (const std::string_view unit : kUnits) {
    if (!text.substr(at).starts_with(unit) || is_letter(at + unit.size())) continue;
    if (is_behind_number || is_in_brackets || unit == kAnywhere || text == unit) return unit;
  }
  return "";
}

std::string in_capitals(std::string_view text) {
  std::string capitals;
  for (std::size_t i = 0; i < text.size();) {
    if (const std::string_view unit = unit_at(text, i); !unit.empty()) {
      capitals += unit;
      i += unit.size();
      continue;
    }
    const std::size_t next = next_character(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    if (next - i == 1) {
      const bool is_small = first >= 'a' && first <= 'z';
      capitals += static_cast<char>(is_small ? first - 'a' + 'A' : first);
    } else if (text.substr(i, next - i) == "ß") {
      capitals += "SS";
    } else if (next - i == 2) {
      const std::uint32_t code_point =
          capital_of((first & 0x1fu) << 6 | (static_cast<unsigned char>(text[i + 1]) & 0x3fu));
      capitals += static_cast<char>(0xc0u | code_point >> 6);
      capitals += static_cast<char>(0x80u | (code_point & 0x3fu));
    } else {
      capitals += text.substr(i, next - i);
    }
    i = next;
  }
  return capitals;
}

}  // namespace jnd::app::gui
