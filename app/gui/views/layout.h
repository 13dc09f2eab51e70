#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/preflight.h"

namespace jnd::app::gui {

// What the views of a study share: sizes, tables, and how a dialog ends.

inline constexpr float kHeaderHeight = 56;
inline constexpr float kFooterHeight = 40;
inline constexpr float kGap = 16;
inline constexpr float kPadding = 18;  ///< Within a card.
/// At the right end of every footer: the application's own buttons.
inline constexpr float kCornerWidth = 460;

/// A card with its heading; returns what is left inside.
Rect draw_card(Ui& ui, const Rect& place, std::string_view heading, std::string_view unit = "");

/// A column of a table: how much of the width it takes, among all.
struct ColumnLook {
  std::string title;
  float share = 1.0f;
  Align align = Align::kLeft;
  std::string unit;
};

/// The cells of a line, a little apart.
[[nodiscard]] std::vector<Rect> cells_of(const Rect& line,
                                         const std::vector<ColumnLook>& columns,
                                         float between = 18);
/// The places of a grid with so many columns, row by row; a lone last one is as wide as a row.
[[nodiscard]] std::vector<Rect> grid_of(const Rect& place, int count, int columns,
                                        float row_height);

/// The titles with a line below. Takes 30 px off `place`.
void draw_table_head(Ui& ui, Rect& place, const std::vector<ColumnLook>& columns);

/// The dialog's last row: the verb (Enter) and "Cancel" (F2).
struct DialogChoice {
  bool done = false, cancelled = false;
};
/// `entered`: Enter ended a text field of the dialog.
[[nodiscard]] DialogChoice draw_dialog_buttons(Ui& ui, Rect row, std::string_view verb,
                                               bool enabled, bool entered);

/// One of several things in a list, `kind` in soft words at its end. True when it was chosen.
bool draw_choice(Ui& ui, const std::string& name, const Rect& place, const std::string& label,
                 const std::string& kind, Chord key, bool selected);
/// Ctrl and a digit, of the first nine.
[[nodiscard]] Chord key_of_choice(std::size_t place) noexcept;

[[nodiscard]] Colour colour_of(PreflightLine::Status status) noexcept;

/// Words in the middle of a place where there is nothing else.
void draw_notice(Ui& ui, const Rect& place, std::string_view words,
                 Colour colour = Colour::kSoft);

/// A number as `printf` has it, with words around it: "%.1f N"; 63 characters at most.
[[nodiscard]] std::string formatted(const char* format, double value);
/// "0.72", "13.6": a number of a table; "" for none.
[[nodiscard]] std::string table_number(double value);

}  // namespace jnd::app::gui
