// Shows the curves, their table, and every number of the chosen curve.

#include <algorithm>
#include <functional>
#include <iterator>

#include "app/gui/views/data_parts.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/stack.h"
#include "app/language/words.h"
#include "app/operator/curve_choices.h"

namespace jnd::app::gui {
namespace {

constexpr float kFitRow = 46;
constexpr float kNumberRow = 25;
constexpr TextStyle kSmallSoft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
constexpr TextStyle kSmallAmber{.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true};

/// A column of the table of fits.
struct FitColumn {
  ColumnLook look;
  std::function<DataValue(const DataGroup&)> value_of;
};

/// The interval without the words about an open end; those are among the numbers beside the
/// curve.
std::string shown_interval(const DataValue& value) {
  return value.interval.substr(0, value.interval.find(" ("));
}

/// As many columns as have room. The most important ones come first, so that they stay.
std::vector<FitColumn> fit_columns(const Ui& ui, const DataResults& results, float width) {
  constexpr float kName = 150;
  float least_column = 92;
  for (std::size_t i = 0; i < std::min<std::size_t>(results.groups.size(), 30); ++i) {
    for (const DataValue* value : {&results.groups[i].pse, &results.groups[i].jnd}) {
      least_column =
          std::max(least_column, ui.text_width(shown_interval(*value), Font::kTiny) + 4);
    }
  }
  const auto most =
      static_cast<std::size_t>(std::max(2.0f, (width - kName) / (least_column + 18)));
  const auto column = [](std::string title, DataValue DataGroup::*value) {
    return FitColumn{{std::move(title), 1.0f, Align::kRight},
                     [value](const DataGroup& group) { return group.*value; }};
  };
  std::vector<FitColumn> columns = {column(tr("PSE"), &DataGroup::pse),
                                    column(tr("JND"), &DataGroup::jnd)};
  for (std::size_t i = 0; i < results.levels.size(); ++i) {
    // The threshold at 0.5 is the PSE, which has a column already.
    if (results.levels[i] == 0.5) continue;
    columns.push_back({{tr("threshold {:.4g}", results.levels[i]), 1.0f, Align::kRight},
                       [i](const DataGroup& group) {
                         return i < group.thresholds.size() ? group.thresholds[i] : DataValue();
                       }});
  }
  std::vector<FitColumn> others = {
      column(tr("location"), &DataGroup::location),
      column(tr("scale"), &DataGroup::scale),
      {{tr("deviance"), 0.75f, Align::kRight}, [](const DataGroup& group) {
         return DataValue{group.deviance, ""};
       }}};
  std::ranges::move(others, std::back_inserter(columns));
  if (columns.size() > most) columns.resize(most);
  columns.insert(columns.begin(),
                 FitColumn{{tr("trials"), 0.6f, Align::kRight}, [](const DataGroup& group) {
                             return DataValue{std::to_string(group.num_trials), ""};
                           }});
  return columns;
}

std::vector<ColumnLook> looks_of(const Ui& ui, const std::vector<FitColumn>& columns) {
  std::vector<ColumnLook> looks = {{"", 1.5f}};
  for (const FitColumn& column : columns) looks.push_back(column.look);
  need_room_for_titles(ui, looks);
  return looks;
}

void draw_fit_row(Ui& ui, const Rect& row, const DataResults& results, std::size_t place,
                  const std::vector<FitColumn>& columns, bool is_selected) {
  const DataGroup& group = results.groups[place];
  const std::vector<Rect> cells = cells_of(row, looks_of(ui, columns));
  Rect name = cells[0];
  if (results.groups.size() > 1 && results.groups.size() <= 6) {
    ui.dot(name.x + 6, row.y + row.height / 2, 5, group_colour(place));
  }
  name.take_left(18);
  const bool is_doubtful = !group.cautions.empty() || !group.reason.empty();
  const Rect mark = is_doubtful ? name.take_right(12, 4) : Rect{};
  ui.text(name, group.name,
          {.font = is_selected ? Font::kStrong : Font::kBody,
           .colour = is_selected ? Colour::kBlue : Colour::kInk,
           .any_length = true});
  if (is_doubtful) ui.dot(mark.x + 6, row.y + row.height / 2, 4, Colour::kAmber);
  if (!group.reason.empty()) {
    Rect rest = row;
    rest.take_left(cells[1].right() - row.x, 18);
    ui.text(cells[1], std::to_string(group.num_trials),
            {.font = Font::kMono, .align = Align::kRight});
    ui.text(rest, tr("no curve: {}", group.reason),
            {.font = Font::kSmall, .colour = Colour::kAmber, .any_length = true});
    return;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const DataValue value = columns[i].value_of(group);
    Rect cell = cells[i + 1];
    const bool has_interval = !value.interval.empty();
    if (has_interval) cell.take_top(3);
    ui.text(has_interval ? cell.take_top(21) : cell, value.value,
            {.font = Font::kMono, .align = Align::kRight, .any_length = true});
    if (has_interval) {
      ui.text(cell.take_top(16), shown_interval(value),
              {.font = Font::kTiny,
               .colour = Colour::kSoft,
               .align = Align::kRight,
               .any_length = true});
    }
  }
}

void draw_fits(Ui& ui, const Rect& place, const DataResults& results, DataViewState& state) {
  Rect inside = draw_card(ui, place, results.title);
  const float content = kFitRow * static_cast<float>(results.groups.size());
  const bool scrolls = content > inside.height - 32;
  const auto padded = [](Rect row) {
    row.take_left(6);
    row.take_right(6);
    return row;
  };
  Rect head = padded(inside);
  if (scrolls) head.take_right(16);
  const std::vector<FitColumn> columns = fit_columns(ui, results, head.width);
  draw_table_head(ui, head, looks_of(ui, columns));
  inside.take_top(32);
  Rect rows = ui.begin_scroll("fits", inside, content);
  for (std::size_t i = 0; i < results.groups.size(); ++i) {
    const Rect row = rows.take_top(kFitRow);
    const bool is_selected = i == state.group;
    if (is_selected && results.groups.size() > 1) ui.fill(row, Colour::kBlueSoft, 8);
    if (ui.row("group_" + std::to_string(i + 1), row, results.groups[i].name)) {
      state.group = i;
      state.numbers_height = 0;
    }
    draw_fit_row(ui, padded(row), results, i, columns,
                 is_selected && results.groups.size() > 1);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
}

/// Draws every number of a group, and the cautions for whoever reads them.
void draw_numbers(Ui& ui, const Rect& place, const DataResults& results, DataViewState& state) {
  const DataGroup& group = results.groups[state.group];
  Rect inside = draw_card(ui, place, tr("Every number of"), group.name);
  inside = ui.begin_scroll("data_numbers", inside, state.numbers_height);
  const float top = inside.y;
  const auto say = [&](const std::string& words, const TextStyle& style, float gap) {
    const float height = ui.text_height(inside.width, words, style);
    ui.text(inside.take_top(height, gap), words, style);
  };
  if (!group.reason.empty()) say(tr("no curve: {}", group.reason), kSmallAmber, 8);
  for (const std::string& caution : group.cautions) say(caution, kSmallAmber, 8);
  if (group.reason.empty()) say(results.formula, kSmallSoft, 8);
  float of_names = 60;
  for (const DataNumber& number : group.numbers) {
    of_names = std::max(of_names, ui.text_width(number.name, Font::kSmall) + 2);
  }
  of_names = std::min(of_names, 0.42f * inside.width);
  for (const DataNumber& number : group.numbers) {
    const Rect row = inside.take_top(kNumberRow);
    Rect cells = row;
    ui.text(cells.take_left(of_names, 6), number.name, {.font = Font::kSmall});
    ui.text(cells.take_left(row.width * 0.23f, 8), number.number.value,
            {.font = Font::kMono, .align = Align::kRight});
    const bool has_interval = !number.number.interval.empty();
    ui.text(cells, has_interval ? number.number.interval : number.remark,
            {.font = Font::kSmall,
             .colour = Colour::kSoft,
             .align = Align::kRight,
             .any_length = true});
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
    if (ui.hovered(row) && !(number.remark + number.number.interval).empty()) {
      std::string words = number.name + " " + number.number.value;
      if (has_interval) words += " · 95 % " + number.number.interval;
      if (!number.remark.empty()) words += " · " + number.remark;
      ui.tooltip(ui.mouse_x(), ui.mouse_y(), words);
    }
  }
  state.numbers_height = inside.y - top;
  ui.end_scroll();
}

/// Asks what the task was, because nobody said it and the fit depends on it.
void draw_task_question(Ui& ui, const Rect& place, const DataView& data, int alternatives,
                        DataViewResult& result) {
  ui.card(place);
  const float width = std::min(620.0f, place.width - 64);
  Stack stack(ui);
  stack.add_text(tr("What were the answers?"), Font::kTitle, Colour::kInk, width, 14);
  stack.add_text(
      tr("They look like right ones of a forced choice among {}, for no level lies below "
         "{:.3g} %. The curve then rises from there, not from 0.",
         alternatives, 100.0 / alternatives),
      Font::kBody, Colour::kSoft, width, 26);
  const auto answer = [&](const std::string& task) {
    result.request = with_task(data.request, task);
  };
  const std::string right = tr("Right answers among {}", alternatives);
  stack.add(50, 0, [&, alternatives](const Rect& row) {
    draw_button_row(ui, row,
                    {{"task_right",
                      right,
                      {.key = {letter('R')}},
                      [&] { answer("mafc:" + std::to_string(alternatives)); }},
                     {"task_yes_no", tr("Answers of yes and no"), {.key = {letter('J')}}, [&] {
                        answer("yes-no");
                      }}});
  });
  stack.draw(place.inset(kPadding));
}

/// Tells why there are no curves to see.
void draw_without_curves(Ui& ui, const Rect& place, const DataView& data) {
  ui.card(place);
  if (!names_its_columns(data.request)) {
    return draw_notice(ui, place,
                       tr("Choose the column of the intensities and that of the answers, at "
                          "the left or by a click on their headings in the table."));
  }
  if (!data.fit_problem.empty()) {
    const TextStyle red{.colour = Colour::kRed, .wrap = true};
    const float width = std::min(760.0f, place.width - 48);
    const float height =
        std::min(ui.text_height(width, data.fit_problem, red), place.height - 24);
    ui.text(place.middle(width, height), data.fit_problem, red);
    return;
  }
  if (data.is_computing) {
    Rect middle = place.middle(std::min(420.0f, place.width - 64), 60);
    ui.text(middle.take_top(34, 10), tr("Fitting …"),
            {.font = Font::kLarge, .align = Align::kCentre});
    ui.progress(middle.take_top(8), data.progress);
    return;
  }
  draw_notice(ui, place, tr("There are no rows with answers."));
}

void draw_notes(Ui& ui, Rect& place, const DataResults& results) {
  for (const std::string& note : results.notes) {
    const float height = ui.text_height(place.width, note, kSmallAmber);
    ui.text(place.take_top(height, 8), note, kSmallAmber);
  }
}

}  // namespace

void draw_data_curves(Ui& ui, Rect place, const DataView& data, DataViewState& state,
                      DataViewResult& result) {
  if (data.results && data.results->suspected_alternatives) {
    return draw_task_question(ui, place, data, *data.results->suspected_alternatives, result);
  }
  if (!data.results || data.results->groups.empty()) {
    return draw_without_curves(ui, place, data);
  }
  const DataResults& results = *data.results;
  state.group = std::min(state.group, results.groups.size() - 1);
  const std::size_t count = results.groups.size();
  if (ui.pressed({Key::kDown}, true)) state.group = (state.group + 1) % count;
  if (ui.pressed({Key::kUp}, true)) state.group = (state.group + count - 1) % count;
  draw_notes(ui, place, results);
  const float wanted = 28 + 32 + kFitRow * static_cast<float>(count) + 2 * kPadding;
  const float fits = std::clamp(wanted, 100.0f, std::max(120.0f, place.height * 0.42f));
  draw_fits(ui, place.take_bottom(fits, kGap), results, state);
  const float numbers = std::clamp(place.width * 0.38f, 300.0f, 440.0f);
  draw_numbers(ui, place.take_right(numbers, kGap), results, state);
  ui.card(place);
  (void)draw_plot(ui, place.inset(kPadding), data_plot(results, state.group));
}

}  // namespace jnd::app::gui
