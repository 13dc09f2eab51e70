#include "app/gui/views/record_view.h"

#include <algorithm>
#include <utility>

#include "app/gui/views/layout.h"
#include "app/gui/views/record_parts.h"
#include "app/gui/views/run_parts.h"
#include "app/gui/views/work_line.h"
#include "app/language/words.h"
#include "app/operator/study_words.h"

namespace jnd::app::gui {
namespace {

/// The height of a button; less in a low window.
float record_button(const Ui& ui) { return ui.screen().height < 720 ? 38 : 42; }

struct PageLook {
  RecordPage page;
  const char *name, *label;
  char digit;
};
constexpr PageLook kRecordPages[] = {
    {RecordPage::kTimeline, "page_timeline", tr_later("Timeline"), '1'},
    {RecordPage::kAnswers, "page_answers", tr_later("Answers"), '2'},
    {RecordPage::kNotes, "page_notes", tr_later("Notes"), '3'},
    {RecordPage::kFaults, "page_faults", tr_later("Faults"), '4'}};

std::string label_of(const PageLook& look, const SessionRecord& record) {
  if (look.page == RecordPage::kAnswers) return tr("Answers {}", record.answers.size());
  if (look.page == RecordPage::kNotes) {
    return record.num_unread() > 0 ? tr("Notes, {} new", record.num_unread())
                                   : tr("Notes {}", record.notes.size());
  }
  if (look.page == RecordPage::kFaults) return tr("Faults {}", record.faults.size());
  return tr(look.label);
}

std::string status_words(const SessionRecord& record) {
  switch (record.line.status) {
    case SessionLine::Status::kCompleted:
      return tr("completed");
    case SessionLine::Status::kEndedEarly:
      return tr("ended early");
    case SessionLine::Status::kOpen:
      return tr("open");
  }
  return "";
}

/// Draws whose session it is, and the tabs of the pages.
void draw_strip_of_record(Ui& ui, Rect strip, const SessionRecord& record,
                          RecordViewState& state) {
  float wanted = 0;
  bool has_keys = true;
  const auto style_of = [&](const PageLook& look) {
    return ButtonStyle{.key = {letter(look.digit)},
                       .selected = look.page == state.page,
                       .hides_key = !has_keys};
  };
  for (const bool keys : {true, false}) {
    has_keys = keys;
    wanted = 0;
    for (const PageLook& look : kRecordPages) {
      wanted += ui.button_width(label_of(look, record), style_of(look)) + 8;
    }
    if (wanted - 8 <= strip.width * 0.66f) break;
  }
  Rect pages = strip.take_right(std::min(wanted - 8, strip.width * 0.74f), 20);
  const float shrink = std::min(1.0f, (pages.width + 8) / wanted);
  for (const PageLook& look : kRecordPages) {
    const std::string label = label_of(look, record);
    const float width = shrink * (ui.button_width(label, style_of(look)) + 8) - 8;
    if (ui.button(look.name, pages.take_left(width, 8), label, style_of(look))) {
      state.page = look.page;
    }
  }
  const std::string name = record.line.participant;
  ui.text(strip.take_left(std::min(ui.text_width(name, Font::kTitle) + 2, strip.width), 14),
          name, {.font = Font::kTitle, .any_length = true});
  ui.text(strip,
          tr("session {} · {}", record.line.session, status_words(record)) +
              (record.line.when.empty() ? "" : " · " + record.line.when),
          {.colour = Colour::kSoft});
}

void draw_fact_line(Ui& ui, Rect& inside, const std::string& name, const std::string& value) {
  draw_name_and_value(ui, inside.take_top(26), name,
                      {.font = Font::kSmall, .colour = Colour::kSoft}, value,
                      {.font = Font::kSmallStrong, .any_length = true});
}

void draw_record_facts(Ui& ui, Rect& column, const SessionRecord& record, float most) {
  std::vector<std::pair<std::string, std::string>> facts = {
      {tr("Answers"),
       record.line.num_is_expected
           ? tr("{} of about {}", record.line.num_answers, record.line.num_trials)
           : tr("{} of {}", record.line.num_answers, record.line.num_trials)},
      {tr("At the device"), duration_words(record.duration_s)}};
  if (!record.hides_levels && !record.line.cells.empty()) {
    facts.emplace_back(tr("Order"), record.line.cells);
  }
  facts.insert(facts.end(), record.facts.begin(), record.facts.end());
  const float wanted = 28 + 26 * static_cast<float>(facts.size()) + 2 * kPadding;
  Rect inside =
      draw_card(ui, column.take_top(std::min(wanted, most), kGap), tr("This session"));
  inside = ui.begin_scroll("facts", inside, 26 * static_cast<float>(facts.size()));
  for (const auto& [name, value] : facts) draw_fact_line(ui, inside, name, value);
  ui.end_scroll();
}

/// The buttons with the actions of the page that is shown.
class RecordActions {
 public:
  RecordActions(Ui& ui, const SessionRecord& record, RecordViewState& state,
                RecordViewResult& result, bool is_idle)
      : ui_(ui), record_(record), state_(state), result_(result), is_idle_(is_idle) {}

  /// The height of all buttons.
  float height() const { return static_cast<float>(count()) * (record_button(ui_) + 8); }

  void draw(Rect& column) {
    const bool may_write = is_idle_ && !record_.is_backup;
    if (!record_.is_over && !record_.is_backup &&
        button(column, "resume", tr("Resume {}", record_.line.participant),
               {.tone = state_.page == RecordPage::kTimeline ? Tone::kPrimary : Tone::kPlain,
                .key = {letter('R')},
                .enabled = is_idle_})) {
      result_.resume = true;
    }
    if (state_.page == RecordPage::kAnswers) draw_of_answers(column, may_write);
    if (state_.page == RecordPage::kNotes) draw_of_notes(column, may_write);
    if (button(column, "write_note", tr("Write a note"),
               {.key = {letter('N')}, .enabled = may_write})) {
      begin_record_dialog(state_, RecordViewState::Dialog::kNote);
    }
    if (button(column, "withdraw", tr("Withdraw {}", record_.line.participant),
               {.key = {letter('W')}, .enabled = may_write})) {
      begin_record_dialog(state_, RecordViewState::Dialog::kWithdraw);
    }
    if (button(column, "back", tr("All sessions"), {.key = {Key::kBackspace}})) {
      result_.tab = StudyTab::kSessions;
    }
  }

 private:
  int count() const {
    const int of_page = state_.page == RecordPage::kAnswers ? 3
                        : state_.page == RecordPage::kNotes ? 1
                                                            : 0;
    return 3 + of_page + (!record_.is_over && !record_.is_backup ? 1 : 0);
  }
  bool button(Rect& column, const char* name, const std::string& label,
              const ButtonStyle& style) {
    return ui_.button(name, column.take_top(record_button(ui_), 8), label, style);
  }

  void draw_of_answers(Rect& column, bool may_write) {
    const RecordAnswer* answer = chosen_answer(record_, state_);
    const bool can_correct = may_write && answer != nullptr && record_.is_over;
    if (button(column, "correct", tr("Set the answer right"),
               {.key = {letter('C')}, .enabled = can_correct})) {
      begin_correction(*answer, state_);
    }
    const bool is_excluded = answer != nullptr && answer->excluded;
    if (button(column, "exclude",
               is_excluded ? tr("Take the trial in again") : tr("Leave the trial out"),
               {.key = {letter('X')}, .enabled = may_write && answer != nullptr})) {
      state_.whole_session = false;
      begin_record_dialog(state_, RecordViewState::Dialog::kExclude);
    }
    const bool all_excluded = std::ranges::all_of(
        record_.answers, [](const RecordAnswer& one) { return one.excluded; });
    if (button(column, "exclude_all",
               all_excluded && !record_.answers.empty() ? tr("Take the session in again")
                                                        : tr("Leave the session out"),
               {.key = {letter('L')}, .enabled = may_write && !record_.answers.empty()})) {
      state_.whole_session = true;
      begin_record_dialog(state_, RecordViewState::Dialog::kExclude);
    }
  }

  void draw_of_notes(Rect& column, bool may_write) {
    const RecordNote* note = chosen_note(record_, state_);
    const bool can_read = may_write && note != nullptr && is_new(*note);
    if (button(column, "acknowledge", tr("Acknowledge"),
               {.tone = Tone::kPrimary, .key = {letter('A')}, .enabled = can_read})) {
      result_.acknowledge = note->what;
    }
  }

  Ui& ui_;
  const SessionRecord& record_;
  RecordViewState& state_;
  RecordViewResult& result_;
  bool is_idle_;
};

void draw_page_of_record(Ui& ui, const Rect& place, const RecordViewModel& model,
                         RecordViewState& state, RecordViewResult& result) {
  switch (state.page) {
    case RecordPage::kTimeline:
      return draw_record_timeline(ui, place, *model.record, state);
    case RecordPage::kAnswers:
      return draw_record_answers(ui, place, *model.record, state);
    case RecordPage::kNotes:
      return draw_record_notes(ui, place, *model.record, state);
    case RecordPage::kFaults:
      return draw_record_faults(ui, place, model, state, result);
  }
}

/// Says what cannot be done here, and why.
std::string hint_of_record(const SessionRecord& record, RecordPage page) {
  if (record.is_backup) return tr("This folder is a backup: it can be read, and not changed.");
  if (page == RecordPage::kAnswers && !record.is_over) {
    return tr("Answers of an open session are set right when it is resumed.");
  }
  return "";
}

}  // namespace

RecordViewResult draw_record_view(Ui& ui, const RecordViewModel& model,
                                  RecordViewState& state) {
  RecordViewResult result;
  Rect rest = ui.screen();
  result.tab =
      draw_study_header(ui, rest.take_top(kHeaderHeight), model.study, StudyTab::kSessions)
          .chosen;
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  if (model.record == nullptr) {
    ui.card(rest);
    const bool failed = !model.problem.empty();
    draw_notice(ui, rest, failed ? model.problem : std::string(tr("Reading the session …")),
                failed ? Colour::kRed : Colour::kSoft);
    draw_study_footer(ui, footer, "", "");
    return result;
  }
  const SessionRecord& record = *model.record;
  draw_strip_of_record(ui, rest.take_top(44, 14), record, state);
  Rect column = rest.take_right(std::clamp(rest.width * 0.24f, 270.0f, 360.0f), kGap);
  RecordActions actions(ui, record, state, result, model.work.running.empty());
  const std::string hint = hint_of_record(record, state.page);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  const float below = hint.empty() ? 70.0f : 70.0f + ui.text_height(column.width, hint, soft);
  draw_record_facts(ui, column, record,
                    std::max(96.0f, column.height - actions.height() - kGap - below));
  draw_page_of_record(ui, rest, model, state, result);
  // The work under way is drawn below. Everything in the column scrolls if there is too little
  // room.
  column = ui.begin_scroll("record_actions", column, state.actions_height);
  const float top = column.y;
  actions.draw(column);
  if (!hint.empty()) {
    ui.text(column.take_top(ui.text_height(column.width, hint, soft), 10), hint, soft);
  }
  const Rect work = column.take_top(work_height(ui, column.width, model.work));
  if (draw_work(ui, work, model.work)) result.cancel = true;
  state.actions_height = column.y - top;
  ui.end_scroll();
  draw_study_footer(ui, footer, model.work.outcome.sentence,
                    record.hides_levels ? tr("levels hidden: double-blind") : "");
  draw_record_dialog(ui, record, state, result);
  return result;
}

}  // namespace jnd::app::gui
