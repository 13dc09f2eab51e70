// The dialogs that choose columns, cells, curves and names of files.

#include <algorithm>
#include <functional>

#include "app/gui/views/data_parts.h"
#include "app/gui/views/layout.h"
#include "app/language/words.h"
#include "app/operator/curve_choices.h"

namespace jnd::app::gui {
namespace {

using DataDialog = DataViewState::Dialog;

constexpr float kChoiceRow = 40;

/// One line of the list in a dialog.
struct ListChoice {
  std::string label, note;
  bool is_selected = false;
  std::function<void()> act;
};

/// What a dialog asks.
struct ListQuestion {
  std::string title, sentence;
  std::vector<ListChoice> choices;
  bool goes_on = false;  ///< Several lines may be chosen, one after the other.
  /// The hint of a field for what is in no list; "" for no field.
  std::string hint;
  /// Takes what was typed; returns why it cannot be used, or "".
  std::function<std::string()> type;
  std::string verb;  ///< The button for what is typed; "Use" if empty.
};

void close_dialog(DataViewState& state) {
  state.dialog = DataDialog::kNone;
  state.problem.clear();
}

/// The key of a line. It needs no Control if the dialog has no field for typing.
Chord list_key(std::size_t place, bool has_field) {
  Chord key = key_of_choice(place);
  if (!has_field) key.control = false;
  return key;
}

void draw_list_question(Ui& ui, DataViewState& state, const ListQuestion& question) {
  const bool has_field = !question.hint.empty();
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const TextStyle red{.font = Font::kSmall, .colour = Colour::kRed, .wrap = true};
  constexpr float kWidth = 620, kAround = 2 * 28;
  const auto content = kChoiceRow * static_cast<float>(question.choices.size());
  const float sentence = ui.text_height(kWidth - kAround, question.sentence, soft);
  const float problem =
      state.problem.empty() ? 0 : ui.text_height(kWidth - kAround, state.problem, red) + 8;
  const float others =
      kAround + 34 + 6 + sentence + 14 + (has_field ? 46 + 14 : 0) + 48 + 12 + problem;
  const float height = std::min(others + content, ui.screen().height - 60);
  Rect inside = ui.begin_dialog("data_dialog", kWidth, height);
  ui.text(inside.take_top(34, 6), question.title, {.font = Font::kLarge});
  ui.text(inside.take_top(sentence, 14), question.sentence, soft);
  Rect buttons = inside.take_bottom(48, 12);
  if (problem > 0) ui.text(inside.take_bottom(problem - 8, 8), state.problem, red);
  bool entered = false;
  if (has_field) {
    const std::string name = state.num_rewrites == 0
                                 ? "data_typed"
                                 : "data_typed_" + std::to_string(state.num_rewrites);
    entered = ui.text_field(name, inside.take_bottom(46, 14), state.typed, question.hint,
                            state.dialog_is_new);
  }
  Rect rows = ui.begin_scroll("data_choices", inside, content);
  const ListChoice* chosen = nullptr;
  for (std::size_t i = 0; i < question.choices.size(); ++i) {
    const ListChoice& choice = question.choices[i];
    if (draw_choice(ui, "choice_" + std::to_string(i + 1), rows.take_top(kChoiceRow),
                    choice.label, choice.note, list_key(i, has_field), choice.is_selected)) {
      chosen = &choice;
    }
  }
  ui.end_scroll();
  bool is_closed = false, is_typed = false;
  if (has_field) {
    const DialogChoice choice =
        draw_dialog_buttons(ui, buttons, question.verb.empty() ? tr("Use") : question.verb,
                            !state.typed.empty(), entered);
    is_typed = choice.done;
    is_closed = choice.cancelled;
  } else {
    const ButtonStyle close{.key = {Key::kF2}};
    is_closed =
        ui.button("dialog_cancel", buttons.take_right(ui.button_width(tr("Close"), close)),
                  tr("Close"), close);
  }
  ui.end_dialog();
  state.dialog_is_new = false;
  if (chosen != nullptr) {
    const DataDialog asked = state.dialog;
    chosen->act();
    // The act may have opened another dialog.
    if (!question.goes_on && state.dialog == asked) close_dialog(state);
  } else if (is_typed) {
    state.problem = question.type();
    state.dialog_is_new = !state.problem.empty();
    if (state.problem.empty()) close_dialog(state);
  } else if (is_closed) {
    close_dialog(state);
  }
}

/// As many of the column's cells as have room: "-90, -60, -30, 0 …".
std::string held_words(const PreviewColumn& column) {
  std::string cells;
  constexpr std::size_t kMostShown = 26;
  for (const std::string& cell : column.cells) {
    if (cells.size() + cell.size() > kMostShown) return cells + " …";
    cells += (cells.empty() ? "" : ", ") + cell;
  }
  return cells;
}

/// A choice for each column that has a name.
std::vector<ListChoice> column_choices(const DataView& data, ColumnRole role,
                                       DataViewResult& result) {
  std::vector<ListChoice> choices;
  for (const PreviewColumn& column : data.preview->columns) {
    if (column.name.empty()) continue;
    const bool is_selected = role_of(data.request, column.name) == role;
    // The command line separates columns by commas.
    const bool is_left_out =
        role == ColumnRole::kGroup && column.name.find(',') != std::string::npos;
    if (is_left_out) continue;
    choices.push_back({column.name, held_words(column), is_selected,
                       [&data, &result, role, is_selected, name = column.name] {
                         const bool goes = role == ColumnRole::kGroup && is_selected;
                         result.request = with_role(data.request, *data.preview, name,
                                                    goes ? ColumnRole::kNone : role);
                       }});
  }
  return choices;
}

ListQuestion role_question(const DataView& data, DataViewState& state, DataViewResult& result) {
  ListQuestion question{.title = tr("What is “{}”?", state.column),
                        .sentence = tr("What the cells of this column say.")};
  const ColumnRole now = role_of(data.request, state.column);
  const auto add = [&](ColumnRole role, const char* label) {
    question.choices.push_back({label, "", role == now, [&data, &state, &result, role] {
                                  result.request = with_role(data.request, *data.preview,
                                                             state.column, role);
                                }});
  };
  add(ColumnRole::kIntensity, tr("The intensity"));
  add(ColumnRole::kYes, tr("The answers, or how many were yes"));
  add(ColumnRole::kTrials, tr("How many trials a row is"));
  if (state.column.find(',') == std::string::npos) {
    add(ColumnRole::kGroup, tr("A condition or a person: a curve for each"));
  }
  question.choices.push_back({tr("Some rows alone, by their cell in it"), "", false,
                              [&state] { open_data_dialog(state, DataDialog::kFilterCell); }});
  add(ColumnRole::kNone, tr("Nothing that matters here"));
  return question;
}

ListQuestion yes_value_question(const DataView& data, DataViewResult& result) {
  ListQuestion question{.title = tr("Which cell is a yes?"),
                        .sentence = tr("Every other cell is a no.")};
  const auto add = [&](const std::string& label, const std::string& value) {
    question.choices.push_back(
        {label, "", value == data.request.yes_value, [&data, &result, value] {
           CurveRequest request = data.request;
           request.yes_value = value;
           result.request = request;
         }});
  };
  add(tr("1, true or yes; 0, -1, false or no is a no"), "");
  const std::size_t place = data.preview->place_of(data.request.yes);
  if (place >= data.preview->columns.size()) return question;
  for (const std::string& cell : data.preview->columns[place].cells) add(cell, cell);
  return question;
}

ListQuestion trials_question(const DataView& data, DataViewResult& result) {
  ListQuestion question{
      .title = tr("How many trials is a row?"),
      .sentence = tr("Where a row is a count of trials, its column of answers says how many of "
                     "them were yes.")};
  question.choices.push_back(
      {tr("Each row is one trial"), "", data.request.trials.empty(), [&data, &result] {
         result.request =
             with_role(data.request, *data.preview, data.request.trials, ColumnRole::kNone);
       }});
  for (ListChoice& choice : column_choices(data, ColumnRole::kTrials, result)) {
    question.choices.push_back(std::move(choice));
  }
  return question;
}

ListQuestion filters_question(const DataView& data, DataViewState& state,
                              DataViewResult& result) {
  ListQuestion question{.title = tr("Which rows?"),
                        .sentence = tr("Rows that have this cell in a column; others are left "
                                       "out. Choose a column, or a filter to take it away."),
                        .goes_on = true};
  for (const std::string& where : data.request.where) {
    const RowFilter filter = filter_of(where);
    question.choices.push_back(
        {filter.column + " = " + filter.cell, tr("take away"), true, [&data, &result, filter] {
           result.request = without_filter(data.request, filter.column);
         }});
  }
  for (const PreviewColumn& column : data.preview->columns) {
    // On the command line, the first = ends the column's name.
    if (column.name.empty() || column.name.find('=') != std::string::npos) continue;
    question.choices.push_back(
        {column.name, held_words(column), false, [&state, name = column.name] {
           state.column = name;
           open_data_dialog(state, DataDialog::kFilterCell);
         }});
  }
  return question;
}

ListQuestion filter_cell_question(const DataView& data, DataViewState& state,
                                  DataViewResult& result) {
  ListQuestion question{.title = tr("Rows in which “{}” is …", state.column),
                        .sentence = tr("All other rows are left out.")};
  const std::size_t place = data.preview->place_of(state.column);
  if (place >= data.preview->columns.size()) return question;
  for (const std::string& cell : data.preview->columns[place].cells) {
    question.choices.push_back(
        {cell, "", false, [&data, &state, &result, cell] {
           result.request = with_filter(data.request, {state.column, cell});
         }});
  }
  return question;
}

/// A question whose answer sets one word of the request.
ListQuestion word_question(const DataView& data, DataViewResult& result, std::string title,
                           std::string sentence, const std::vector<CurveChoice>& choices) {
  ListQuestion question{.title = std::move(title), .sentence = std::move(sentence)};
  for (const CurveChoice& one : choices) {
    question.choices.push_back(
        {one.label, one.note, one.is_chosen(data.request),
         [&data, &result, choose = one.choose] { result.request = choose(data.request); }});
  }
  return question;
}

/// Adds a field to a question. `settle` makes a request of what was typed, or says why it
/// cannot.
void let_type(ListQuestion& question, const char* hint, const DataView& data,
              const DataViewState& state, DataViewResult& result,
              TypedRequest (*settle)(const CurveRequest&, const std::string&)) {
  question.hint = hint;
  question.type = [&data, &state, &result, settle] {
    TypedRequest typed = settle(data.request, state.typed);
    if (typed.problem.empty()) result.request = std::move(typed.request);
    return typed.problem;
  };
}

ListQuestion save_question(bool is_picture, DataViewState& state, DataViewResult& result) {
  ListQuestion question{
      .title = is_picture ? tr("Save the picture") : tr("Save the table of fits"),
      .sentence = is_picture ? tr("The ending of the name says the format. Nothing is "
                                  "overwritten.")
                             : tr("As CSV, a row for each threshold of each curve. Nothing is "
                                  "overwritten."),
      .goes_on = true,
      .hint = tr("path of a new file")};
  if (is_picture) {
    for (const char* ending : {".svg", ".pdf", ".png"}) {
      const std::filesystem::path named(state.typed);
      question.choices.push_back({std::string(ending).substr(1), "",
                                  named.extension() == ending, [&state, named, ending] {
                                    std::filesystem::path other = named;
                                    state.typed = other.replace_extension(ending).string();
                                    ++state.num_rewrites;
                                    state.dialog_is_new = true;
                                  }});
    }
  }
  question.verb = tr("Save");
  question.type = [is_picture, &state, &result]() -> std::string {
    (is_picture ? result.save_picture : result.save_table) = typed_path(state.typed);
    return "";
  };
  return question;
}

ListQuestion question_of(const DataView& data, DataViewState& state, DataViewResult& result) {
  switch (state.dialog) {
    case DataDialog::kRole:
      return role_question(data, state, result);
    case DataDialog::kIntensity:
      return {.title = tr("Which column has the intensities?"),
              .sentence = tr("What the answers depend on, as a number."),
              .choices = column_choices(data, ColumnRole::kIntensity, result)};
    case DataDialog::kYes:
      return {.title = tr("Which column has the answers?"),
              .sentence = tr("A yes or a no in each row, or how many were yes."),
              .choices = column_choices(data, ColumnRole::kYes, result)};
    case DataDialog::kYesValue:
      return yes_value_question(data, result);
    case DataDialog::kTrials:
      return trials_question(data, result);
    case DataDialog::kGroups:
      return {.title = tr("A curve for each of which?"),
              .sentence = tr("Choose one column or several; what is chosen again is taken "
                             "away."),
              .choices = column_choices(data, ColumnRole::kGroup, result),
              .goes_on = true};
    case DataDialog::kFilters:
      return filters_question(data, state, result);
    case DataDialog::kFilterCell:
      return filter_cell_question(data, state, result);
    case DataDialog::kFamily:
      return word_question(data, result, tr("Which family?"),
                           tr("The form of the curve between guess and lapse rate."),
                           family_choices(data.request));
    case DataDialog::kTask: {
      ListQuestion question = word_question(
          data, result, tr("What are the answers?"),
          tr("Right answers of a forced choice rise from chance, the guess rate."),
          task_choices());
      let_type(question, tr("or another guess rate, such as 0.1"), data, state, result,
               with_typed_guess);
      return question;
    }
    case DataDialog::kLapse: {
      ListQuestion question =
          word_question(data, result, tr("Which lapse rate?"),
                        tr("How far the upper end of the curve is from 1."), lapse_choices());
      let_type(question, tr("or another rate, such as 0.03"), data, state, result,
               with_typed_lapse);
      return question;
    }
    case DataDialog::kLevels: {
      ListQuestion question{
          .title = tr("Thresholds at which levels?"),
          .sentence = tr("Levels of the curve between guess and lapse rate, from 0 to 1: 0.75 "
                         "of right answers among two is 87.5 % right.")};
      let_type(question, tr("such as 0.5, 0.75"), data, state, result, with_typed_levels);
      return question;
    }
    case DataDialog::kInterval:
      return word_question(
          data, result, tr("Which 95 % intervals?"),
          tr("The likelihood ratio's are right where a bootstrap is not, with few answers a "
             "level. The picture and the comparison have them whatever is chosen here."),
          interval_choices());
    case DataDialog::kGoodness:
      return word_question(
          data, result, tr("How well do the curves fit?"),
          tr("Answers are drawn from each curve again and again. p is how often they lie as "
             "far from their curve as yours do; a small one says that the curve is not "
             "theirs."),
          goodness_choices());
    case DataDialog::kPicture:
      return save_question(true, state, result);
    case DataDialog::kTable:
      return save_question(false, state, result);
    case DataDialog::kNone:
    case DataDialog::kFile:
      break;
  }
  return {};
}

}  // namespace

void draw_data_dialog(Ui& ui, const DataView& data, const EntriesOf& entries_of,
                      DataViewState& state, DataViewResult& result) {
  if (state.dialog == DataDialog::kFile) {
    const FileDialogResult found =
        draw_file_dialog(ui,
                         {.title = tr("Open a table of answers"),
                          .hint = tr("path of a CSV, TSV or jsPsych JSON file"),
                          .nothing = tr("There is no table and no folder here.")},
                         entries_of, state.opening);
    if (found.chosen) result.open = found.chosen;
    if (found.is_closed) close_dialog(state);
    return;
  }
  if (!data.preview) return close_dialog(state);
  draw_list_question(ui, state, question_of(data, state, result));
}

}  // namespace jnd::app::gui
