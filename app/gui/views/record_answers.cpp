// Shows the answers of a session, each with its history.

#include <algorithm>

#include "app/gui/views/layout.h"
#include "app/gui/views/record_parts.h"
#include "app/language/words.h"
#include "app/operator/study_words.h"

namespace jnd::app::gui {
namespace {

constexpr float kAnswerRow = 34;
constexpr float kAnswerDetail = 96;

std::vector<ColumnLook> columns_of_answers(const Ui& ui, const SessionRecord& record) {
  std::vector<ColumnLook> columns = {{tr("Trial"), 0.7f, Align::kRight}, {tr("Block"), 1.8f}};
  if (!record.hides_levels) columns.push_back({tr("Stimulus"), 1.8f});
  columns.push_back({tr("Answer"), 1.0f});
  columns.push_back({tr("Took"), 0.6f, Align::kRight});
  columns.push_back({tr("Remarks"), 1.4f});
  need_room_for_titles(ui, columns);
  return columns;
}

/// The most important remark about the answer, in a few words.
std::pair<std::string, Colour> remark_of(const RecordAnswer& answer) {
  if (answer.excluded) return {tr("left out"), Colour::kAmber};
  if (!answer.history.empty() && answer.attempt == 1) {
    return {tr("set right"), Colour::kBlue};
  }
  if (!answer.hint.empty()) return {answer.hint, Colour::kAmber};
  if (answer.attempt > 1) {
    return {tr("run again, attempt {}", answer.attempt), Colour::kSoft};
  }
  return {"", Colour::kSoft};
}

void draw_answer_row(Ui& ui, const Rect& row, const SessionRecord& record, std::size_t index,
                     RecordViewState& state) {
  const RecordAnswer& answer = record.answers[index];
  if (state.answer == index) ui.fill(row, Colour::kBlueSoft, 8);
  const std::string name = "answer_" + std::to_string(answer.trial);
  if (ui.row(name, row, tr("{}, trial {}", answer.block, answer.in_block))) {
    state.answer = index;
  }
  Rect inside = row;
  inside.take_left(8);
  inside.take_right(8);
  const std::vector<Rect> cells = cells_of(inside, columns_of_answers(ui, record));
  const Colour ink = answer.excluded ? Colour::kSoft : Colour::kInk;
  const TextStyle small{.font = Font::kSmall, .colour = ink, .any_length = true};
  std::size_t next = 0;
  ui.text(cells[next++], std::to_string(answer.trial),
          {.font = Font::kMono, .colour = Colour::kSoft, .align = Align::kRight});
  ui.text(cells[next++], short_title(answer.block) + " · " + std::to_string(answer.in_block),
          small);
  if (!record.hides_levels) ui.text(cells[next++], answer.stimulus, small);
  ui.text(cells[next++], answer.answer,
          {.font = Font::kStrong, .colour = ink, .any_length = true});
  ui.text(cells[next++],
          answer.response_time_s ? formatted("%.1f s", *answer.response_time_s) : "",
          {.font = Font::kMono, .colour = ink, .align = Align::kRight});
  const auto [words, colour] = remark_of(answer);
  // The words may be cut, because the detail below shows them in full for the chosen row.
  ui.text(cells[next], words, {.font = Font::kSmall, .colour = colour, .any_length = true});
}

/// Draws everything that is known about the chosen answer.
void draw_answer_detail(Ui& ui, const Rect& place, const RecordAnswer* answer,
                        RecordViewState& state) {
  ui.line(place.x, place.y, place.right(), place.y, Colour::kLine);
  Rect inside = place;
  inside.take_top(8);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  if (answer == nullptr) {
    ui.text(inside, tr("Choose an answer to see what became of it."), soft);
    return;
  }
  std::vector<std::string> told = answer->history;
  if (!answer->hint.empty()) told.push_back(answer->hint);
  if (answer->attempt > 1) {
    told.push_back(tr("This is attempt {} of its trial.", answer->attempt));
  }
  if (told.empty())
    told.emplace_back(tr("Nothing was changed, and nothing speaks against it."));
  inside = ui.begin_scroll("answer_detail", inside, state.detail_height);
  const float top = inside.y;
  for (const std::string& words : told) {
    ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 4), words, soft);
  }
  state.detail_height = inside.y - top;
  ui.end_scroll();
}

}  // namespace

const RecordAnswer* chosen_answer(const SessionRecord& record, const RecordViewState& state) {
  return state.answer && *state.answer < record.answers.size() ? &record.answers[*state.answer]
                                                               : nullptr;
}

void draw_record_answers(Ui& ui, const Rect& place, const SessionRecord& record,
                         RecordViewState& state) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(20, 8);
  if (record.answers.size() > 1) draw_list_keys(ui, title);
  ui.heading(title, tr("Answers"));
  if (record.answers.empty()) {
    draw_notice(ui, inside,
                record.is_over
                    ? tr("No answer of this session stands.")
                    : tr("No answer yet. Resume the session, and its answers come here."));
    return;
  }
  const Rect detail = inside.take_bottom(kAnswerDetail, 8);
  const float content = kAnswerRow * static_cast<float>(record.answers.size());
  constexpr float kHead = 30;
  Rect head = inside;
  head.take_left(8);
  head.take_right(content > inside.height - kHead ? 24 : 8);
  draw_table_head(ui, head, columns_of_answers(ui, record));
  inside.take_top(kHead);
  if (move_in_list(ui, record.answers.size(), state.answer)) {
    ui.scroll_into_view("answers", kAnswerRow * static_cast<float>(*state.answer), kAnswerRow);
  }
  Rect rows = ui.begin_scroll("answers", inside, content);
  for (std::size_t i = 0; i < record.answers.size(); ++i) {
    const Rect row = rows.take_top(kAnswerRow);
    // Draws only the answers that can be seen, because there may be a thousand.
    if (row.bottom() < inside.y || row.y > inside.bottom()) continue;
    draw_answer_row(ui, row, record, i, state);
  }
  ui.end_scroll();
  draw_answer_detail(ui, detail, chosen_answer(record, state), state);
}

}  // namespace jnd::app::gui
