#include "app/gui/views/results_view.h"

#include <algorithm>
#include <utility>

#include "app/gui/views/layout.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/work_line.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

const ButtonStyle kExport{.key = {letter('E'), true}};
const ButtonStyle kReport{.tone = Tone::kPrimary, .key = {letter('R'), true}};

/// True if the tabs and the title have enough room beside the buttons and their keys.
bool own_keys_have_room(const Ui& ui) {
  const float wanted = ui.button_width(tr("Export"), kExport) + 10 +
                       ui.button_width(tr("Write report"), kReport);
  return wanted < 0.3f * ui.screen().width;
}

ButtonStyle own_style(const Ui& ui, ButtonStyle style) {
  style.hides_key = !own_keys_have_room(ui);
  return style;
}

float own_width(const Ui& ui) {
  return ui.button_width(tr("Export"), own_style(ui, kExport)) + 10 +
         ui.button_width(tr("Write report"), own_style(ui, kReport));
}

void draw_own_buttons(Ui& ui, Rect strip, const ResultsViewModel& model,
                      ResultsViewState& state, ResultsViewResult& result) {
  ButtonStyle report = own_style(ui, kReport);
  ButtonStyle exporting = own_style(ui, kExport);
  report.enabled = exporting.enabled = model.results != nullptr && model.work.running.empty();
  Rect place = strip.take_right(ui.button_width(tr("Write report"), report), 10);
  result.write_report =
      ui.button("write_report", place.middle(place.width, 38), tr("Write report"), report);
  place = strip.take_right(ui.button_width(tr("Export"), exporting));
  if (ui.button("export", place.middle(place.width, 38), tr("Export"), exporting)) {
    state.asks_for_format = true;
  }
}

/// Which of the report's figures the page shows; none if it has no figures.
std::optional<StudyFiguresRequest::What> figures_of_page(ResultsPage page) {
  if (page == ResultsPage::kCharts) return StudyFiguresRequest::What::kCharts;
  if (page == ResultsPage::kBoxes) return StudyFiguresRequest::What::kBoxes;
  return std::nullopt;
}

/// Draws the tabs of the pages at the left, and whose results are shown at the right.
void draw_strip(Ui& ui, Rect strip, const std::vector<ResultsPageLook>& pages,
                const ResultsViewModel& model, ResultsViewState& state,
                ResultsViewResult& result) {
  const ResultsModel& results = *model.results;
  bool has_keys = true;
  const auto style_of = [&](std::size_t i) {
    return ButtonStyle{.key = {letter(static_cast<char>('1' + i))},
                       .selected = i == state.page,
                       .hides_key = !has_keys};
  };
  const auto wanted_width = [&] {
    float width = 0;
    for (std::size_t i = 0; i < pages.size(); ++i) {
      width += ui.button_width(pages[i].label, style_of(i)) + 8;
    }
    return width;
  };
  float wanted = wanted_width();
  const auto figures = figures_of_page(pages[state.page].page);
  const ButtonStyle save{.key = {letter('S'), true},
                         .enabled = figures.has_value() && model.work.running.empty()};
  const bool has_room = wanted + ui.button_width(tr("Save picture"), save) <= strip.width;
  const char* label = has_room ? tr("Save picture") : tr("Save");
  const Rect at_right = strip.take_right(ui.button_width(label, save), 8);
  if (ui.button("save_picture", at_right, label, save)) result.save_picture = figures;
  if (wanted > strip.width) {
    has_keys = false;
    wanted = wanted_width();
  }
  const float shrink = std::min(1.0f, strip.width / wanted);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const ButtonStyle style = style_of(i);
    const float width = shrink * (ui.button_width(pages[i].label, style) + 8) - 8;
    if (ui.button(pages[i].name, strip.take_left(width, 8), pages[i].label, style)) {
      state.page = i;
      state.page_height = 0;
    }
  }
  // The arrow keys go through the participants, whose table has no room to show keys.
  const std::size_t count = results.rows.size() + 1;
  if (ui.pressed({Key::kDown}, true)) state.participant = (state.participant + 1) % count;
  if (ui.pressed({Key::kUp}, true)) state.participant = (state.participant + count - 1) % count;
}

void draw_without_results(Ui& ui, const Rect& place, const ResultsViewModel& model,
                          ResultsViewState& state) {
  ui.card(place);
  if (model.problem.empty()) {
    Rect middle = place.middle(std::min(420.0f, place.width - 64), 70);
    ui.text(middle.take_top(34, 10), tr("Computing the results …"),
            {.font = Font::kLarge, .align = Align::kCentre});
    ui.progress(middle.take_top(8), model.progress);
    return;
  }
  const TextStyle style{.align = Align::kCentre, .wrap = true};
  const float width = std::min(640.0f, place.width - 64);
  const std::string title = model.is_blinded ? tr("Double-blind") : tr("No results");
  const float words = ui.text_height(width, model.problem, style);
  Rect middle = place.middle(width, 48 + words + 28 + 52);
  ui.text(middle.take_top(40, 8), title, {.font = Font::kTitle, .align = Align::kCentre});
  ui.text(middle.take_top(words, 28), model.problem, style);
  if (!model.is_blinded) return;
  const ButtonStyle unblind{.tone = Tone::kDanger, .key = {letter('U'), true}};
  const float button = ui.button_width(tr("Unblind the study"), unblind);
  if (ui.button("unblind", middle.middle(button, 52), tr("Unblind the study"), unblind)) {
    state.asks_to_unblind = true;
    state.dialog_is_new = true;
    state.reason.clear();
  }
}

void draw_unblind_dialog(Ui& ui, ResultsViewState& state, ResultsViewResult& result) {
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* words = tr(
      "From now on levels, orders and results can be seen by everybody who opens this folder. "
      "When and why is stored with the study and cannot be taken back.");
  Rect inside =
      ui.begin_dialog("unblind_dialog", 620, 290 + more_lines(ui, 620, words, soft, 3));
  ui.text(inside.take_top(34, 4), tr("Unblind the study"), {.font = Font::kLarge});
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 16), words, soft);
  const bool entered = ui.text_field("unblind_reason", inside.take_top(46), state.reason,
                                     tr("reason"), state.dialog_is_new);
  const DialogChoice choice = draw_dialog_buttons(ui, inside.take_bottom(48), tr("Unblind"),
                                                  !state.reason.empty(), entered);
  ui.end_dialog();
  // Enter ends a field. If something is still missing, the field gets the keyboard again.
  state.dialog_is_new = entered && !choice.done;
  result.unblind = choice.done;
  if (choice.done || choice.cancelled) state.asks_to_unblind = false;
}

/// Draws the dialog that asks for the format; each has a key.
void draw_export_dialog(Ui& ui, ResultsViewState& state, ResultsViewResult& result) {
  struct Format {
    const char *name, *label, *words;
  };
  constexpr Format kFormats[] = {
      {"csv", tr_later("CSV"), tr_later("tables with a codebook, for R, Python, spreadsheets")},
      {"bids", tr_later("BIDS"), tr_later("a data set in the layout of neuroimaging")},
      {"hdf5", tr_later("HDF5"), tr_later("tables, and one file with every sample")},
      {"xdf", tr_later("XDF"),
       tr_later("a file for each session, in step with other recorders")}};
  constexpr float kRow = 54, kNumFormats = std::size(kFormats);
  Rect inside =
      ui.begin_dialog("export_dialog", 640, 56 + 46 + kNumFormats * (kRow + 8) + 50 + 62);
  ui.text(inside.take_top(34, 12), tr("Export the study as …"), {.font = Font::kLarge});
  for (std::size_t i = 0; i < std::size(kFormats); ++i) {
    const Format& format = kFormats[i];
    const Chord key = {letter(static_cast<char>('1' + i))};
    const Rect row = inside.take_top(kRow, 8);
    ui.outline(row, Colour::kLine, 8);
    if (ui.row(std::string("export_") + format.name, row, tr(format.label), key)) {
      result.export_as = ExportChoice{format.name, state.with_recordings};
    }
    Rect words = row.inset(6);
    words.take_left(10);
    const Rect cap = words.take_right(ui.key_cap_width(key), 12);
    ui.key_cap(cap.x, cap.y + (cap.height - Ui::kKeyCapHeight) / 2, key);
    ui.text(words.take_left(70), tr(format.label), {.font = Font::kStrong});
    ui.text(words, tr(format.words), {.colour = Colour::kSoft});
  }
  const ButtonStyle samples{.key = {letter('R')}, .selected = state.with_recordings};
  const char* label = state.with_recordings ? tr("With every sample of CSV and BIDS")
                                            : tr("Without samples in CSV and BIDS");
  Rect line = inside.take_top(42);
  if (ui.button("export_recordings", line.take_left(ui.button_width(label, samples)), label,
                samples)) {
    state.with_recordings = !state.with_recordings;
  }
  Rect row = inside.take_bottom(46);
  const ButtonStyle cancel{.key = {Key::kF2}};
  const bool cancelled =
      ui.button("export_cancel", row.take_right(ui.button_width(tr("Cancel"), cancel)),
                tr("Cancel"), cancel);
  ui.end_dialog();
  if (cancelled || result.export_as) state.asks_for_format = false;
}

/// Draws how the last work ended, and a button that opens what it wrote.
void draw_written_card(Ui& ui, Rect& rest, const StudyWork& work, ResultsViewResult& result) {
  const Rect card = rest.take_bottom(42 + 2 * 12, kGap);
  ui.card(card);
  Rect inside = card.inset(12);
  inside.x += 6;
  const ButtonStyle open{.tone = Tone::kPrimary, .key = {letter('O'), true}};
  const Rect button = inside.take_right(ui.button_width(tr("Open"), open), 16);
  result.open = ui.button("open_written", button, tr("Open"), open);
  const std::size_t num_problems = work.outcome.problems.size();
  const std::string first = num_problems == 0 ? "" : " · " + work.outcome.problems.front();
  ui.text(inside, work.outcome.sentence + first,
          {.colour = work.outcome.ok && num_problems == 0 ? Colour::kInk : Colour::kAmber,
           .any_length = true});
}

/// Draws the work under way, or how it ended, above the footer.
void draw_work_card(Ui& ui, Rect& rest, const ResultsViewModel& model,
                    ResultsViewResult& result) {
  if (model.work.running.empty()) {
    if (!model.work.outcome.opens.empty()) {
      draw_written_card(ui, rest, model.work, result);
    }
    return;
  }
  const Rect card = rest.take_bottom(42 + 2 * 12, kGap);
  ui.card(card);
  Rect inside = card;
  inside.take_left(kPadding);
  inside.take_right(kPadding);
  result.cancel = draw_work(ui, inside.middle(inside.width, 42), model.work);
}

}  // namespace

StudyTabLook tab_of_results() {
  return {StudyTab::kResults, "tab_results", tr_later("Results"), '2'};
}

ResultsViewResult draw_results_view(Ui& ui, const ResultsViewModel& model,
                                    ResultsViewState& state) {
  ResultsViewResult result;
  Rect rest = ui.screen();
  const StudyHeader header = draw_study_header(ui, rest.take_top(kHeaderHeight), model.study,
                                               StudyTab::kResults, own_width(ui));
  result.tab = header.chosen;
  draw_own_buttons(ui, header.own_buttons, model, state, result);
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  draw_work_card(ui, rest, model, result);
  if (model.results == nullptr) {
    draw_without_results(ui, rest, model, state);
  } else {
    const ResultsModel& results = *model.results;
    const std::vector<ResultsPageLook> pages = pages_of(results);
    // With one participant, their own value and interval are shown, because everybody's would
    // be the same.
    if (std::exchange(state.is_new, false) && results.rows.size() == 1) state.participant = 1;
    state.page = std::min(state.page, pages.size() - 1);
    state.participant = std::min(state.participant, results.rows.size());
    const float table = std::clamp(150.0f + 84.0f * static_cast<float>(results.columns.size()),
                                   340.0f, rest.width * 0.36f);
    draw_participants(ui, rest.take_right(table, kGap), results,
                      results.simulated && !header.shows_marks, state);
    draw_strip(ui, rest.take_top(40, kGap), pages, model, state, result);
    draw_results_page(ui, rest, results, pages[state.page].page, state);
  }
  const bool is_on_card = !model.work.outcome.opens.empty();
  draw_study_footer(ui, footer, is_on_card ? "" : model.work.outcome.sentence, "");
  if (state.asks_for_format) draw_export_dialog(ui, state, result);
  if (state.asks_to_unblind) draw_unblind_dialog(ui, state, result);
  return result;
}

}  // namespace jnd::app::gui
