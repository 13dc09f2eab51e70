#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app::gui {

/// Measures the width of a text, in the unit of the widths below.
using Measure = std::function<float(std::string_view)>;

/// Breaks a text into lines no wider than `width`, at spaces and line ends; a word that is
/// wider is broken anywhere. There is at least one line. If `balanced`, the lines are about
/// equally long, as centred text needs it, and still as few as possible. The lines are parts of
/// `text`.
[[nodiscard]] std::vector<std::string_view> break_lines(std::string_view text, float width,
                                                        const Measure& measure, bool balanced);

/// Returns `text` if it fits; otherwise as much of its beginning as fits, with an ellipsis.
[[nodiscard]] std::string shorten(std::string_view text, float width, const Measure& measure);

/// The text in capital letters, for headings. Only Latin letters change, so that a unit's Greek
/// letters stay. A unit behind a number, in brackets or alone stays as well: "5 mm", "[N/m]",
/// "Pa s".
[[nodiscard]] std::string in_capitals(std::string_view text);

/// Where the code point after the one at `position` begins.
[[nodiscard]] std::size_t next_character(std::string_view text, std::size_t position) noexcept;

}  // namespace jnd::app::gui
