#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/preflight.h"

namespace jnd::app::gui {

// What the views of a study share: sizes, tables, and the buttons of a dialog.

inline constexpr float kHeaderHeight = 56;
inline constexpr float kFooterHeight = 40;
inline constexpr float kGap = 16;
inline constexpr float kPadding = 18;  ///< Inside a card.

/// The application's own buttons at the right end of every footer. They do not show their keys
/// if longer words of another language need the room.
struct CornerLook {
  float width = 0;
  bool has_keys = true;
};
/// `language` is the label of the button that changes the language; "" for no such button.
[[nodiscard]] CornerLook corner_look(const Ui& ui, std::string_view language = "");
/// The buttons that every view except the session's shows, from the right.
struct CornerButton {
  const char *name, *label;
  Chord key;
};
[[nodiscard]] std::vector<CornerButton> corner_buttons(const Ui& ui);

/// Draws a card with its heading, and returns the rectangle that is left inside.
Rect draw_card(Ui& ui, const Rect& place, std::string_view heading, std::string_view unit = "");

/// A column of a table. `share` is its part of the width in relation to the other columns.
struct ColumnLook {
  std::string title;
  float share = 1.0f;
  Align align = Align::kLeft;
  std::string unit;
  /// What its words need; the columns share the rest of the width.
  float least_width = 0;
};

/// Makes the column's least width at least as wide as these words.
void need_room(const Ui& ui, ColumnLook& column, std::string_view words, Font font);
/// Makes the columns wide enough for their titles, each of which may stand on two lines.
void need_room_for_titles(const Ui& ui, std::vector<ColumnLook>& columns);

/// The cells of a line, `between` apart.
[[nodiscard]] std::vector<Rect> cells_of(const Rect& line,
                                         const std::vector<ColumnLook>& columns,
                                         float between = 18);
/// The places of a grid with so many columns, row by row. A single place in the last row is as
/// wide as the row.
[[nodiscard]] std::vector<Rect> grid_of(const Rect& place, int count, int columns,
                                        float row_height);

/// Draws the titles with a line below them, and takes 30 logical pixels off `place`.
void draw_table_head(Ui& ui, Rect& place, const std::vector<ColumnLook>& columns);

/// What was chosen in a dialog's last row: the verb (Enter) or "Cancel" (F2).
struct DialogChoice {
  bool done = false, cancelled = false;
};
/// `entered` tells that Enter ended a text field of the dialog.
[[nodiscard]] DialogChoice draw_dialog_buttons(Ui& ui, Rect row, std::string_view verb,
                                               bool enabled, bool entered);

/// How much higher a dialog of this width is with these words than with `num_lines` lines.
[[nodiscard]] float more_lines(const Ui& ui, float dialog_width, std::string_view words,
                               const TextStyle& style, int num_lines);

/// Draws one of several choices in a list, with `kind` in soft words at its end. Returns true
/// when it was chosen. `any_length` tells that the label is a name that somebody gave.
bool draw_choice(Ui& ui, const std::string& name, const Rect& place, const std::string& label,
                 const std::string& kind, Chord key, bool selected, bool any_length = false);
/// Ctrl and a digit, for the first nine places.
[[nodiscard]] Chord key_of_choice(std::size_t place) noexcept;

[[nodiscard]] Colour colour_of(PreflightLine::Status status) noexcept;

/// Draws a name at the left of a line and its value at the right. If there is too little room
/// for both, they share it.
void draw_name_and_value(Ui& ui, const Rect& line, std::string_view name,
                         const TextStyle& name_style, std::string_view value,
                         const TextStyle& value_style);

/// Places side by side, all of one height. When a row is full, the next place begins a new row.
class Flow {
 public:
  Flow(const Rect& area, float height, float gap)
      : area_(area), height_(height), gap_(gap), x_(area.x), y_(area.y) {}
  [[nodiscard]] Rect next(float width);
  /// The height of all rows so far.
  [[nodiscard]] float height() const noexcept { return y_ + height_ - area_.y; }

 private:
  Rect area_;
  float height_, gap_, x_, y_;
};

/// Draws words in the middle of a place that has nothing else.
void draw_notice(Ui& ui, const Rect& place, std::string_view words,
                 Colour colour = Colour::kSoft);

/// Formats a number with a format of `printf`, such as "%.1f N"; 63 characters at most.
[[nodiscard]] std::string formatted(const char* format, double value);
/// A number in a table, such as "0.72" or "136"; "" if it is not finite.
[[nodiscard]] std::string table_number(double value);

}  // namespace jnd::app::gui
