#include "app/gui/views/study_problems.h"

#include <algorithm>

#include "app/gui/views/layout.h"
#include "app/gui/views/list_keys.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kExcerptLine = 22;
constexpr float kLineNumber = 46;
constexpr TextStyle kProblemMessage{.wrap = true};

std::string place_words(const experiments::StudyProblem& problem) {
  return problem.line > 0 ? tr("line {}, column {}", problem.line, problem.column)
                          : std::string(tr("the file as a whole"));
}

/// Draws the file's text around a problem, and marks the place of the problem.
void draw_excerpt(Ui& ui, const Rect& place, const FileExcerpt& excerpt) {
  ui.fill(place, Colour::kGround, 6);
  Rect inside = place.inset(6);
  for (const FileExcerpt::Line& line : excerpt.lines) {
    Rect row = inside.take_top(kExcerptLine);
    if (line.is_meant) ui.fill(row, Colour::kRed, 3, 0.10f);
    ui.text(row.take_left(kLineNumber, 10), std::to_string(line.number),
            {.font = Font::kMono,
             .colour = line.is_meant ? Colour::kRed : Colour::kSoft,
             .align = Align::kRight});
    ui.text(row, line.text, {.font = Font::kMono, .any_length = true});
    if (!line.is_meant || line.before.size() >= line.text.size()) continue;
    const float x = row.x + ui.text_width(line.before, Font::kMono);
    ui.line(x, row.bottom() - 3, std::min(x + 24, row.right()), row.bottom() - 3, Colour::kRed,
            2);
  }
}

float height_of_excerpt(const FileExcerpt& excerpt) {
  return excerpt.lines.empty()
             ? 0
             : 12 + kExcerptLine * static_cast<float>(excerpt.lines.size()) + 6;
}

float height_of_problem(const Ui& ui, float width, const experiments::StudyProblem& problem,
                        const FileExcerpt& excerpt) {
  return 12 + 24 + ui.text_height(width - 24, problem.message, kProblemMessage) + 8 +
         height_of_excerpt(excerpt) + 12;
}

void draw_problem_row(Ui& ui, const Rect& row, const experiments::StudyProblem& problem,
                      const FileExcerpt& excerpt, std::size_t place, StudyViewState& state) {
  if (state.problem == place) ui.fill(row, Colour::kBlueSoft, 8);
  if (ui.row("problem_" + std::to_string(place + 1), row, problem.message)) {
    state.problem = place;
  }
  Rect inside = row;
  inside.take_left(12);
  inside.take_right(12);
  inside.take_top(12);
  Rect head = inside.take_top(24);
  const std::string where = place_words(problem);
  ui.text(head.take_left(ui.text_width(where, Font::kSmallStrong) + 2, 16), where,
          {.font = Font::kSmallStrong, .colour = Colour::kRed});
  ui.text(head, problem.pointer.empty() ? "/" : problem.pointer,
          {.font = Font::kMono, .colour = Colour::kSoft, .any_length = true});
  ui.text(inside.take_top(ui.text_height(inside.width, problem.message, kProblemMessage), 8),
          problem.message, kProblemMessage);
  if (!excerpt.lines.empty()) {
    draw_excerpt(ui, inside.take_top(height_of_excerpt(excerpt)), excerpt);
  }
}

const FileExcerpt& excerpt_of(const StudyOutline& outline, std::size_t place) {
  static const FileExcerpt kNone{};
  return place < outline.excerpts.size() ? outline.excerpts[place] : kNone;
}

}  // namespace

void draw_study_problems(Ui& ui, const Rect& place, const StudyOutline& outline,
                         StudyViewState& state, StudyViewResult& result) {
  const std::size_t count = outline.problems.size();
  ui.card(place);
  ui.outline(place, Colour::kRed, 10, 2);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(38, 2);
  const ButtonStyle edit{.key = {letter('E')}};
  const Rect button = title.take_right(ui.button_width(tr("Edit the file"), edit), 14);
  if (ui.button("edit_file", button, tr("Edit the file"), edit)) result.edit = true;
  if (count > 1) draw_list_keys(ui, title);
  ui.text(title,
          trn("{} problem in the file", "{} problems in the file", static_cast<int>(count)),
          {.font = Font::kLarge, .colour = Colour::kRed});
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* how = tr("Mend them in your editor; the file is read again once it is saved.");
  ui.text(inside.take_top(ui.text_height(inside.width, how, soft), 8), how, soft);
  const float width = inside.width - 16;
  float content = 0, chosen_from = 0, chosen_height = 0;
  const bool moved = move_in_list(ui, count, state.problem);
  for (std::size_t i = 0; i < count; ++i) {
    const float height =
        height_of_problem(ui, width, outline.problems[i], excerpt_of(outline, i));
    if (state.problem == i) {
      chosen_from = content;
      chosen_height = height;
    }
    content += height;
  }
  if (moved) ui.scroll_into_view("outline", chosen_from, chosen_height);
  Rect rows = ui.begin_scroll("outline", inside, content);
  rows.width = width;
  for (std::size_t i = 0; i < count; ++i) {
    const experiments::StudyProblem& problem = outline.problems[i];
    const FileExcerpt& excerpt = excerpt_of(outline, i);
    const Rect row = rows.take_top(height_of_problem(ui, width, problem, excerpt));
    draw_problem_row(ui, row, problem, excerpt, i, state);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
}

void draw_study_doubts(Ui& ui, const Rect& place, const StudyOutline& outline) {
  ui.fill(place, Colour::kAmber, 8, 0.10f);
  const TextStyle style{.font = Font::kSmall, .wrap = true};
  Rect inside = place.inset(10);
  ui.text(inside.take_top(24, 4),
          trn("{} thing to look at once more", "{} things to look at once more",
              static_cast<int>(outline.doubts.size())),
          {.font = Font::kSmallStrong, .colour = Colour::kAmber});
  for (const experiments::StudyProblem& doubt : outline.doubts) {
    const std::string words = tr("{}: {}", place_words(doubt), doubt.message);
    const float height = ui.text_height(inside.width, words, style);
    if (height > inside.height) break;
    ui.text(inside.take_top(height, 4), words, style);
  }
}

}  // namespace jnd::app::gui
