// The participants beside the figures, and the pages that are tables.

#include <algorithm>

#include "app/gui/views/chart_plot.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/results_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using namespace results;

constexpr float kResultsRowHeight = 36;
constexpr float kBetweenNumbers = 8;

Colour colour_of_quality(QualityChip::Tone tone) {
  switch (tone) {
    case QualityChip::Tone::kGood:
      return Colour::kGreen;
    case QualityChip::Tone::kWarning:
      return Colour::kAmber;
    case QualityChip::Tone::kNeutral:
      break;
  }
  return Colour::kBlue;
}

std::vector<ColumnLook> columns_of(const ResultsModel& results) {
  std::vector<ColumnLook> columns = {{"", 0.85f}};
  for (const TableColumn& column : results.columns) {
    columns.push_back({column.title, 1.0f, Align::kRight, column.unit});
  }
  return columns;
}

/// Draws the titles of columns, which may be longer than the numbers below, on two lines.
void draw_participants_head(Ui& ui, Rect& place, const std::vector<ColumnLook>& columns) {
  constexpr float kHead = 44;
  const Rect head = place.take_top(kHead);
  const std::vector<Rect> cells = cells_of(head, columns, kBetweenNumbers);
  for (std::size_t i = 1; i < columns.size(); ++i) {
    Rect cell = cells[i];
    // Titles name what the study measures in its author's words, so they may be cut.
    const TextStyle style{.font = Font::kTiny,
                          .colour = Colour::kSoft,
                          .align = Align::kRight,
                          .any_length = true};
    if (columns[i].unit.empty()) {
      ui.text(cell, columns[i].title, style);
      continue;
    }
    ui.text(cell.take_top(kHead / 2 - 2), columns[i].title, style);
    ui.text(cell.take_top(kHead / 2 - 2), columns[i].unit, style);
  }
  ui.line(head.x, head.bottom(), head.right(), head.bottom(), Colour::kLine);
}

void draw_participant(Ui& ui, const Rect& row, const TableRow& line,
                      const std::vector<ColumnLook>& columns, bool selected) {
  const std::vector<Rect> cells = cells_of(row, columns, kBetweenNumbers);
  Rect name = cells[0];
  ui.text(name, line.participant,
          {.font = selected ? Font::kStrong : Font::kBody,
           .colour = selected ? Colour::kBlue : Colour::kInk,
           .any_length = true});
  if (!line.note.empty()) {
    const float x = name.x + ui.text_width(line.participant, Font::kStrong) + 12;
    ui.dot(x, row.y + row.height / 2, 4, Colour::kAmber);
  }
  for (std::size_t i = 0; i < line.values.size(); ++i) {
    const std::optional<double>& value = line.values[i];
    ui.text(cells[i + 1], value ? table_number(*value) : "-",
            {.font = Font::kMono,
             .colour = value ? Colour::kInk : Colour::kAmber,
             .align = Align::kRight,
             .any_length = true});
  }
  if (!line.note.empty() && ui.hovered(row)) {
    ui.tooltip(ui.mouse_x(), ui.mouse_y(), line.note);
  }
}

void draw_boxes_page(Ui& ui, const Rect& place, const ResultsModel& results) {
  const auto count = static_cast<int>(results.boxes.size());
  const int columns = count > 1 ? 2 : 1;
  const int num_rows = (count + columns - 1) / columns;
  const auto rows = static_cast<float>(num_rows);
  const float height = (place.height - kGap * (rows - 1)) / rows;
  const std::vector<Rect> cards = grid_of(place, count, columns, height);
  for (std::size_t i = 0; i < cards.size(); ++i) {
    ui.card(cards[i]);
    (void)draw_plot(ui, cards[i].inset(kPadding), box_plot(results.boxes[i]));
  }
}

void draw_comparisons_page(Ui& ui, const Rect& place, const ResultsModel& results,
                           ResultsViewState& state) {
  Rect inside = draw_card(ui, place, tr("Comparisons"));
  inside = ui.begin_scroll("comparisons", inside, state.page_height);
  const float top = inside.y;
  const TextStyle name{.wrap = true};
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  for (const ComparisonLine& line : results.comparisons) {
    const float width = inside.width - 110;
    const float text = ui.text_height(width, line.name, name);
    const float detail = ui.text_height(width, line.detail, soft);
    Rect row = inside.take_top(text + detail + 18);
    const Rect whole = row;
    row = row.middle(row.width, text + detail);
    const Rect value = row.take_right(100, 10);
    ui.text(value, line.estimate ? two_digits(*line.estimate) : tr("none"),
            {.font = Font::kAnswer,
             .colour = line.estimate ? Colour::kInk : Colour::kAmber,
             .align = Align::kRight});
    ui.text(row.take_top(text), line.name, name);
    ui.text(row, line.detail, soft);
    ui.line(whole.x, whole.bottom(), whole.right(), whole.bottom(), Colour::kLine);
  }
  state.page_height = inside.y - top;
  ui.end_scroll();
}

void draw_numbers_page(Ui& ui, const Rect& place, const ResultsModel& results,
                       ResultsViewState& state) {
  std::vector<ColumnLook> columns = {
      {"", 2.7f}, {tr("value"), 1.3f, Align::kRight}, {"95 %", 1.9f, Align::kRight}};
  // Most studies have no published values to compare with.
  const bool has_published = std::ranges::any_of(results.numbers, [](const NumberLine& line) {
    return !line.published.empty() || !line.basis.empty();
  });
  if (has_published) {
    columns.push_back({tr("published"), 1.4f, Align::kRight});
    columns.push_back({tr("basis, tail"), 2.1f, Align::kRight});
  }
  Rect inside = draw_card(ui, place, tr("Every number"));
  Rect head = inside;
  head.take_right(16);
  need_room_for_titles(ui, columns);
  draw_table_head(ui, head, columns);
  inside.take_top(32);
  inside = ui.begin_scroll("numbers", inside, state.page_height);
  const float top = inside.y;
  std::string section;
  for (const NumberLine& line : results.numbers) {
    if (line.section != section) {
      section = line.section;
      ui.heading(inside.take_top(34), section, "", Align::kLeft, /*any_length=*/true);
    }
    const bool is_sure = line.caution.empty();
    const std::string label = is_sure ? line.label : tr("{}: caution", line.label);
    const TextStyle name{
        .font = Font::kSmall, .colour = is_sure ? Colour::kInk : Colour::kAmber, .wrap = true};
    const float width = cells_of(inside, columns)[0].width;
    const Rect row = inside.take_top(std::max(30.0f, ui.text_height(width, label, name) + 12));
    const std::vector<Rect> cells = cells_of(row, columns);
    const TextStyle number{.font = Font::kMono, .align = Align::kRight, .any_length = true};
    const TextStyle soft{.font = Font::kSmall,
                         .colour = Colour::kSoft,
                         .align = Align::kRight,
                         .any_length = true};
    ui.text(cells[0].middle(cells[0].width, ui.text_height(width, label, name)), label, name);
    ui.text(cells[1], line.value.empty() ? "-" : line.value, number);
    const std::string start = "95 % ";
    const bool plain = line.interval.starts_with(start);
    ui.text(cells[2], plain ? line.interval.substr(start.size()) : line.interval, number);
    if (has_published) {
      ui.text(cells[3], line.published, number);
      ui.text(cells[4], line.basis, soft);
    }
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
    if (ui.hovered(row)) {
      ui.tooltip(ui.mouse_x(), ui.mouse_y(),
                 is_sure ? line.meaning : tr("Caution: {}. {}", line.caution, line.meaning));
    }
  }
  state.page_height = inside.y - top;
  ui.end_scroll();
}

}  // namespace

std::vector<ResultsPageLook> pages_of(const ResultsModel& results) {
  std::vector<ResultsPageLook> pages;
  if (!results.charts.empty()) {
    pages.push_back({ResultsPage::kCharts, "page_charts", tr("Charts")});
  }
  if (!results.boxes.empty()) pages.push_back({ResultsPage::kBoxes, "page_boxes", tr("Boxes")});
  if (!results.comparisons.empty()) {
    pages.push_back({ResultsPage::kComparisons, "page_comparisons", tr("Tests")});
  }
  pages.push_back({ResultsPage::kNumbers, "page_numbers", tr("Numbers")});
  return pages;
}

std::string shown_participant(const ResultsModel& results, const ResultsViewState& state) {
  if (state.participant == 0 || state.participant > results.rows.size()) return kEveryone;
  return results.rows[state.participant - 1].participant;
}

void draw_results_page(Ui& ui, const Rect& place, const ResultsModel& results, ResultsPage page,
                       ResultsViewState& state) {
  switch (page) {
    case ResultsPage::kCharts:
      return draw_charts_page(ui, place, results, state);
    case ResultsPage::kBoxes:
      return draw_boxes_page(ui, place, results);
    case ResultsPage::kComparisons:
      return draw_comparisons_page(ui, place, results, state);
    case ResultsPage::kNumbers:
      return draw_numbers_page(ui, place, results, state);
  }
}

void draw_participants(Ui& ui, const Rect& place, const ResultsModel& results, bool marks,
                       ResultsViewState& state) {
  Rect inside = draw_card(ui, place, tr("Participants"));
  if (marks) {
    const float width = ui.chip_width(tr("simulated data"));
    ui.chip(inside.right() - width, place.y + 14, tr("simulated data"), Colour::kAmber);
  }
  const std::vector<ColumnLook> columns = columns_of(results);
  const float content = kResultsRowHeight * static_cast<float>(results.rows.size() + 1);
  const bool scrolls = content > inside.height - 44;
  const auto padded = [scrolls](Rect line, bool is_head) {
    line.take_left(8);
    line.take_right(scrolls && is_head ? 24 : 8);
    return line;
  };
  Rect head = padded(inside, true);
  draw_participants_head(ui, head, columns);
  inside.take_top(44);
  Rect rows = ui.begin_scroll("participants", inside, content);
  const auto select = [&](std::size_t place_in_list, const std::string& name) {
    const Rect row = rows.take_top(kResultsRowHeight);
    const bool selected = state.participant == place_in_list;
    if (selected) ui.fill(row, Colour::kBlueSoft, 8);
    if (ui.row("participant_" + std::to_string(place_in_list), row, name)) {
      state.participant = place_in_list;
    }
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
    return padded(row, false);
  };
  const Rect all = select(0, kEveryone);
  ui.text(all, tr("All participants"),
          {.font = state.participant == 0 ? Font::kStrong : Font::kBody,
           .colour = state.participant == 0 ? Colour::kBlue : Colour::kInk});
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const Rect row = select(i + 1, results.rows[i].participant);
    draw_participant(ui, row, results.rows[i], columns, state.participant == i + 1);
  }
  ui.end_scroll();
}

float draw_quality(Ui& ui, const Rect& place, const ResultsModel& results) {
  constexpr float kChip = 26;
  constexpr float kBetween = 8;
  float x = place.x;
  float y = place.y;
  for (const QualityChip& chip : results.quality) {
    // A sentence that is too long for a chip is drawn as wrapped words.
    const float width = std::min(ui.chip_width(chip.text), place.width);
    if (x > place.x && x + width > place.right()) {
      x = place.x;
      y += kChip + kBetween;
    }
    if (ui.chip_width(chip.text) <= place.width) {
      ui.chip(x, y, chip.text, colour_of_quality(chip.tone));
    } else {
      const TextStyle style{
          .font = Font::kSmall, .colour = colour_of_quality(chip.tone), .wrap = true};
      const float height = ui.text_height(place.width, chip.text, style);
      ui.text({x, y, place.width, height}, chip.text, style);
      y += std::max(0.0f, height - kChip);
    }
    x += width + kBetween;
  }
  return results.quality.empty() ? 0 : y + kChip - place.y;
}

}  // namespace jnd::app::gui
