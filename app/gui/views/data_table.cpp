// Shows the first rows of the file, with the roles of its columns.

#include <algorithm>
#include <cmath>

#include "app/gui/views/data_parts.h"
#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using DataDialog = DataViewState::Dialog;

constexpr float kHeadHeight = 52, kDataRow = 28, kCellPadding = 10;

/// Wide enough for the column's name, its role and its first cells, within reason.
float column_width(Ui& ui, const DataView& data, std::size_t place) {
  const PreviewColumn& column = data.preview->columns[place];
  constexpr std::size_t kMostLooked = 30;
  float width =
      std::max(ui.text_width(column.name, Font::kSmallStrong),
               ui.text_width(role_words(role_of(data.request, column.name)), Font::kSmall));
  for (std::size_t row = 0; row < std::min(kMostLooked, data.preview->rows.size()); ++row) {
    width = std::max(width, ui.text_width(data.preview->rows[row][place], Font::kMono));
  }
  return std::clamp(width + 2 * kCellPadding + 4, 74.0f, 260.0f);
}

struct ShownColumn {
  std::size_t place;
  float x, width;
};

/// The columns that have room, beginning with `first`; at least one.
std::vector<ShownColumn> shown_columns(Ui& ui, const Rect& place, const DataView& data,
                                       std::size_t first) {
  std::vector<ShownColumn> shown;
  float x = place.x;
  for (std::size_t i = first; i < data.preview->columns.size(); ++i) {
    const float width = column_width(ui, data, i);
    if (!shown.empty() && x + width > place.right()) break;
    shown.push_back({i, x, std::min(width, place.right() - x)});
    x += width;
  }
  return shown;
}

/// Draws, at the right, which columns are shown and buttons that lead to the others. Returns
/// their width.
float draw_column_pager(Ui& ui, Rect line, const DataView& data,
                        const std::vector<ShownColumn>& shown, DataViewState& state) {
  const std::size_t count = data.preview->columns.size();
  const std::size_t last = shown.empty() ? 0 : shown.back().place + 1;
  if (state.first_column == 0 && last >= count) return 0;
  const float whole = line.width;
  const ButtonStyle right{.key = {Key::kRight}, .enabled = last < count};
  const ButtonStyle left{.key = {Key::kLeft}, .enabled = state.first_column > 0};
  const char *more = tr("Further columns"), *fewer = tr("Back");
  const std::size_t step = std::max<std::size_t>(1, shown.size() - 1);
  if (ui.button("columns_right", line.take_right(ui.button_width(more, right), 8), more,
                right)) {
    state.first_column = std::min(count - 1, state.first_column + step);
  }
  if (ui.button("columns_left", line.take_right(ui.button_width(fewer, left), 12), fewer,
                left)) {
    state.first_column -= std::min(state.first_column, step);
  }
  const std::string which = tr("columns {} to {} of {}", state.first_column + 1, last, count);
  const float width = std::min(ui.text_width(which, Font::kSmall) + 2, 0.5f * line.width);
  ui.text(line.take_right(width, 16), which,
          {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kRight});
  return whole - line.width;
}

void draw_column_head(Ui& ui, const Rect& head, const DataView& data, const ShownColumn& column,
                      DataViewState& state) {
  const std::string& name = data.preview->columns[column.place].name;
  const ColumnRole role = role_of(data.request, name);
  Rect cell{column.x, head.y, column.width, head.height};
  cell.width -= 3;
  if (role != ColumnRole::kNone) ui.fill(cell, Colour::kBlueSoft, 6);
  if (!name.empty() && ui.row("column_" + std::to_string(column.place + 1), cell, name, {})) {
    state.column = name;
    open_data_dialog(state, DataDialog::kRole);
  }
  cell.take_left(kCellPadding);
  cell.take_right(kCellPadding);
  cell.take_top(5);
  ui.text(cell.take_top(21), name, {.font = Font::kSmallStrong, .any_length = true});
  ui.text(cell.take_top(20), role_words(role), {.font = Font::kSmall, .colour = Colour::kBlue});
}

}  // namespace

void draw_data_table(Ui& ui, const Rect& place, const DataView& data, DataViewState& state) {
  const DataPreview& preview = *data.preview;
  ui.card(place);
  Rect inside = place.inset(kPadding);
  state.first_column = std::min(state.first_column, preview.columns.size() - 1);
  const std::vector<ShownColumn> shown = shown_columns(ui, inside, data, state.first_column);
  Rect line = inside.take_top(34, 10);
  Rect words = line;
  words.width -= draw_column_pager(ui, line, data, shown, state);
  ui.text(words, tr("Click a column's heading to say what it is."),
          {.font = Font::kSmall, .colour = Colour::kSoft});
  const Rect head = inside.take_top(kHeadHeight, 4);
  for (const ShownColumn& column : shown) draw_column_head(ui, head, data, column, state);
  ui.line(head.x, head.bottom() + 2, head.right(), head.bottom() + 2, Colour::kLine);
  const std::size_t count = preview.rows.size();
  const bool is_cut = static_cast<std::int64_t>(count) < preview.num_rows;
  const float content = kDataRow * static_cast<float>(count + (is_cut ? 1 : 0));
  const Rect rows = ui.begin_scroll("data_rows", inside, content);
  const auto first =
      static_cast<std::size_t>(std::max(0.0f, std::floor((inside.y - rows.y) / kDataRow)));
  const std::size_t last = std::min(
      count, first + static_cast<std::size_t>(std::ceil(inside.height / kDataRow)) + 1);
  for (std::size_t row = first; row < last; ++row) {
    const float y = rows.y + kDataRow * static_cast<float>(row);
    for (const ShownColumn& column : shown) {
      const bool is_number = preview.columns[column.place].is_numeric;
      ui.text({column.x + kCellPadding, y, column.width - 2 * kCellPadding, kDataRow},
              preview.rows[row][column.place],
              {.font = Font::kMono,
               .colour = role_of(data.request, preview.columns[column.place].name) ==
                                 ColumnRole::kNone
                             ? Colour::kSoft
                             : Colour::kInk,
               .align = is_number ? Align::kRight : Align::kLeft,
               .any_length = true});
    }
    ui.line(rows.x, y + kDataRow, rows.right(), y + kDataRow, Colour::kLine);
  }
  if (is_cut && last == count) {
    ui.text({rows.x + kCellPadding, rows.y + kDataRow * static_cast<float>(count), rows.width,
             kDataRow},
            tr("… and {} more rows", preview.num_rows - static_cast<std::int64_t>(count)),
            {.font = Font::kSmall, .colour = Colour::kSoft});
  }
  ui.end_scroll();
}

void draw_data_command(Ui& ui, const Rect& place, const DataView& data, DataViewState& state) {
  Rect inside = draw_card(ui, place, tr("The same on the command line"));
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* words =
      tr("This command reads the same file, fits the same curves and prints the same numbers. "
         "Kept beside the data, it says how they came about.");
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 18), words, soft);
  const TextStyle mono{.font = Font::kMono, .wrap = true};
  const float height = ui.text_height(inside.width - 32, data.command, mono);
  const Rect box = inside.take_top(height + 28, 18);
  ui.fill(box, Colour::kGround, 8);
  ui.text(box.inset(14), data.command, mono);
  const ButtonStyle copy{.tone = Tone::kPrimary, .key = {letter('C'), true}};
  Rect row = inside.take_top(46);
  if (ui.button("copy_command", row.take_left(ui.button_width(tr("Copy command"), copy), 16),
                tr("Copy command"), copy)) {
    ui.copy_text(data.command);
    state.is_copied = true;
  }
  if (state.is_copied) ui.text(row, tr("Copied"), {.colour = Colour::kGreen});
}

}  // namespace jnd::app::gui
