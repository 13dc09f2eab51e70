#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app::gui {

/// The width of a run of text, in whatever unit the widths below are given in.
using Measure = std::function<float(std::string_view)>;

/// Lines no wider than `width`, broken at spaces and line ends; a word that is wider is broken
/// anywhere. At least one line. `balanced`: as many lines as needed, but of about equal length,
/// as centred text wants to be. The lines are parts of `text`.
[[nodiscard]] std::vector<std::string_view> break_lines(std::string_view text, float width,
                                                        const Measure& measure, bool balanced);

/// `text`, or as much of its beginning as fits with an ellipsis.
[[nodiscard]] std::string shorten(std::string_view text, float width, const Measure& measure);

/// Capital letters, for headings; Latin alone, so that a unit's Greek stays what it is. A unit
/// behind a number, in brackets or by itself is no word and stays as well: "5 mm", "[N/m]", "Pa
/// s".
[[nodiscard]] std::string in_capitals(std::string_view text);

/// Where the code point after the one at `position` begins.
[[nodiscard]] std::size_t next_character(std::string_view text, std::size_t position) noexcept;

}  // namespace jnd::app::gui
