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

/// At the right end of every footer stand the application's own buttons, whose keys give way
/// where another language has longer words.
struct CornerLook {
  float width = 0;
  bool has_keys = true;
};
/// `language`: what the button of the next language says; "" for none.
[[nodiscard]] CornerLook corner_look(const Ui& ui, std::string_view language = "");
/// The labels of those that stand on every view but that of a session, from the right.
struct CornerButton {
  const char *name, *label;
  Chord key;
};
[[nodiscard]] std::vector<CornerButton> corner_buttons(const Ui& ui);

/// A card with its heading; returns what is left inside.
Rect draw_card(Ui& ui, const Rect& place, std::string_view heading, std::string_view unit = "");

/// A column of a table: how much of the width it takes, among all.
struct ColumnLook {
  std::string title;
  float share = 1.0f;
  Align align = Align::kLeft;
  std::string unit;
  float least_width = 0;  ///< What its words need, before the others share what is left.
};

/// What these words of a column need.
void need_room(const Ui& ui, ColumnLook& column, std::string_view words, Font font);
/// What the titles of all need, where each may stand on two lines.
void need_room_for_titles(const Ui& ui, std::vector<ColumnLook>& columns);

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

/// How much higher a dialog of this width is than one with so many lines of these words.
[[nodiscard]] float more_lines(const Ui& ui, float dialog_width, std::string_view words,
                               const TextStyle& style, int num_lines);

/// One of several things in a list, `kind` in soft words at its end. True when it was chosen.
/// `any_length`: the label is a name that somebody gave.
bool draw_choice(Ui& ui, const std::string& name, const Rect& place, const std::string& label,
                 const std::string& kind, Chord key, bool selected, bool any_length = false);
/// Ctrl and a digit, of the first nine.
[[nodiscard]] Chord key_of_choice(std::size_t place) noexcept;

[[nodiscard]] Colour colour_of(PreflightLine::Status status) noexcept;

/// A name at the left and what it is at the right of a line; where both have too little room,
/// each has its part of it.
void draw_name_and_value(Ui& ui, const Rect& line, std::string_view name,
                         const TextStyle& name_style, std::string_view value,
                         const TextStyle& value_style);

/// Places side by side, of one height, that go on in the next row where one is full.
class Flow {
 public:
  Flow(const Rect& area, float height, float gap)
      : area_(area), height_(height), gap_(gap), x_(area.x), y_(area.y) {}
  [[nodiscard]] Rect next(float width);
  /// Of all rows so far.
  [[nodiscard]] float height() const noexcept { return y_ + height_ - area_.y; }

 private:
  Rect area_;
  float height_, gap_, x_, y_;
};

/// Words in the middle of a place where there is nothing else.
void draw_notice(Ui& ui, const Rect& place, std::string_view words,
                 Colour colour = Colour::kSoft);

/// A number as `printf` has it, with words around it: "%.1f N"; 63 characters at most.
[[nodiscard]] std::string formatted(const char* format, double value);
/// "0.72", "13.6": a number of a table; "" for none.
[[nodiscard]] std::string table_number(double value);

}  // namespace jnd::app::gui
