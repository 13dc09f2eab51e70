// How many participants are done, who comes next, how old the backup is, and how even orders
// and arms are.

#include <algorithm>

#include "app/gui/views/fitted_text.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/overview_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kBalanceRow = 32;
constexpr float kFigureButton = 42;

void draw_words(Ui& ui, Rect& inside, const std::string& words, const TextStyle& style) {
  const float height = draw_fitted(ui, inside, words, style);
  if (height > 0) inside.take_top(height, 4);
}

constexpr TextStyle kSoftWords{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};

void draw_done(Ui& ui, const Rect& place, const OverviewModel& model, OverviewState& state) {
  const StudyOverview& overview = *model.overview;
  Rect inside = draw_card(ui, place, tr("Participants"));
  const Rect bottom = inside.take_bottom(kFigureButton, 8);
  const std::string done = overview.num_planned
                               ? tr("{} of {}", overview.num_done, *overview.num_planned)
                               : std::to_string(overview.num_done);
  ui.text(inside.take_top(52, 6), done, {.font = Font::kHuge});
  if (overview.num_planned && *overview.num_planned > 0) {
    ui.progress(inside.take_top(8, 8),
                std::min(1.0, static_cast<double>(overview.num_done) /
                                  static_cast<double>(*overview.num_planned)));
  }
  draw_words(ui, inside,
             !overview.num_planned         ? tr("done; nobody has said how many are planned")
             : overview.planned_by.empty() ? tr("done, as planned here")
                                           : tr("done, {}", overview.planned_by),
             kSoftWords);
  const bool may_plan = overview.planned_by.empty() && !overview.is_backup;
  if (ui.button("plan_number", bottom, tr("Plan"),
                {.key = {letter('P')}, .enabled = may_plan})) {
    state.dialog = OverviewState::Dialog::kPlan;
    state.dialog_is_new = true;
    state.problem.clear();
    state.number = overview.num_planned ? std::to_string(*overview.num_planned) : "";
  }
}

void draw_next(Ui& ui, const Rect& place, const StudyOverview& overview,
               OverviewResult& result) {
  Rect inside = draw_card(ui, place, tr("Next participant"));
  const Rect bottom = inside.take_bottom(kFigureButton, 8);
  ui.text(inside.take_top(40, 4), overview.next_participant,
          {.font = Font::kTitle, .any_length = true});
  if (overview.hides_levels) {
    draw_words(ui, inside, tr("Double-blind: the order is assigned, and hidden."), kSoftWords);
  } else if (!overview.cell_problem.empty()) {
    draw_words(ui, inside, overview.cell_problem, kSoftWords);
  } else {
    for (const NextCell& next : overview.next_cells) {
      const std::string cell =
          next.cell.empty() ? std::string(tr("the same order for everyone")) : next.cell;
      draw_words(
          ui, inside,
          next.brings.empty() ? tr("gets {}", cell) : tr("{}: gets {}", next.brings, cell),
          {.font = Font::kSmall, .wrap = true});
    }
  }
  if (ui.button("prepare", bottom, tr("Prepare the session"),
                {.tone = Tone::kPrimary,
                 .key = {letter('N')},
                 .enabled = !overview.is_backup && !overview.next_participant.empty()})) {
    result.prepare = overview.next_participant;
  }
}

void draw_copy(Ui& ui, const Rect& place, const OverviewModel& model, OverviewState& state) {
  const BackupAge& backup = model.overview->backup;
  const bool is_old = !backup.hint.empty();
  Rect inside = draw_card(ui, place, tr("Backup"));
  if (is_old) ui.outline(place, Colour::kAmber, 10, 1.5f);
  const Rect bottom = inside.take_bottom(kFigureButton, 8);
  ui.text(inside.take_top(34, 4), backup.is_known ? backup.when : std::string(tr("none")),
          {.font = Font::kLarge, .colour = is_old ? Colour::kAmber : Colour::kInk});
  draw_words(ui, inside, backup.hint,
             {.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true});
  draw_words(ui, inside, backup.folder, kSoftWords);
  if (ui.button("back_up", bottom, tr("Back up"),
                {.key = {letter('B')},
                 .enabled = model.work.running.empty() && !model.overview->is_backup})) {
    state.asks_for_backup = state.backup_is_new = true;
  }
}

int most_in(const StudyOverview& overview) {
  int most = 1;
  for (const BalanceGroup& group : overview.balance) {
    for (const BalanceLine& line : group.lines) {
      most = std::max(most, line.num_done + line.num_open);
    }
  }
  return most;
}

std::string counts_words(const BalanceLine& line) {
  return line.num_open > 0 ? tr("{}, {} open", line.num_done, line.num_open)
                           : std::to_string(line.num_done);
}

/// The places of a line's parts.
struct BalanceCells {
  Rect words, chip, bar, counts;
};

BalanceCells cells_of_balance(const Ui& ui, Rect row, const BalanceLine& line) {
  BalanceCells cells{};
  row.take_right(2);
  const float counts = ui.text_width(counts_words(line), Font::kMono) + 2;
  cells.counts = row.take_right(std::max(counts, line.num_open > 0 ? 96.0f : 30.0f), 10);
  cells.bar = row.take_right(std::max(60.0f, row.width * 0.2f), 14);
  if (line.is_next) cells.chip = row.take_right(ui.chip_width(tr("next")), 10);
  cells.words = row;
  return cells;
}

TextStyle style_of_balance(const BalanceLine& line) {
  return {.font = line.is_next ? Font::kSmallStrong : Font::kSmall, .wrap = true};
}

/// Long words take a second line.
float height_of_balance(const Ui& ui, float width, const BalanceLine& line) {
  const Rect words = cells_of_balance(ui, {0, 0, width, kBalanceRow}, line).words;
  return std::max(kBalanceRow,
                  ui.text_height(words.width, line.words, style_of_balance(line)) + 10);
}

void draw_balance_line(Ui& ui, const Rect& row, const BalanceLine& line, int most) {
  const BalanceCells cells = cells_of_balance(ui, row, line);
  const Rect bar = cells.bar.middle(cells.bar.width, 14);
  const float one = bar.width / static_cast<float>(most);
  ui.fill(bar, Colour::kLine, 4, 0.6f);
  const float done = one * static_cast<float>(line.num_done);
  const float open = one * static_cast<float>(line.num_open);
  if (open > 0) ui.fill({bar.x, bar.y, done + open, bar.height}, Colour::kAmber, 4, 0.55f);
  if (done > 0) ui.fill({bar.x, bar.y, done, bar.height}, Colour::kBlue, 4);
  ui.text(cells.counts, counts_words(line), {.font = Font::kMono, .align = Align::kRight});
  if (line.is_next) {
    ui.chip(cells.chip.x, cells.chip.y + (cells.chip.height - 26) / 2, tr("next"),
            Colour::kBlue);
  }
  const TextStyle style = style_of_balance(line);
  const float height = ui.text_height(cells.words.width, line.words, style);
  ui.text(cells.words.middle(cells.words.width, height), line.words, style);
}

float height_of_groups(const Ui& ui, float width, const StudyOverview& overview) {
  float height = 0;
  for (const BalanceGroup& group : overview.balance) {
    if (!group.title.empty()) height += 30;
    for (const BalanceLine& line : group.lines) height += height_of_balance(ui, width, line);
  }
  return height;
}

}  // namespace

void draw_overview_figures(Ui& ui, const Rect& place, const OverviewModel& model,
                           OverviewState& state, OverviewResult& result) {
  Rect rest = place;
  const float third = (rest.width - 2 * kGap) / 3.3f;
  draw_done(ui, rest.take_left(third, kGap), model, state);
  draw_next(ui, rest.take_left(third * 1.3f, kGap), *model.overview, result);
  draw_copy(ui, rest, model, state);
}

float balance_height(const Ui& ui, float width, const StudyOverview& overview) {
  return 28 + 2 * kPadding +
         std::max(height_of_groups(ui, width - 2 * kPadding, overview), 72.0f);
}

void draw_balance(Ui& ui, const Rect& place, const StudyOverview& overview) {
  Rect inside = draw_card(ui, place, tr("Balance"));
  if (overview.balance.empty()) {
    draw_notice(ui, inside,
                overview.hides_levels
                    ? tr("Double-blind: who has which order is hidden. The program keeps them "
                         "even by itself.")
                    : tr("Everybody gets the same order: there is nothing to balance."));
    return;
  }
  const int most = most_in(overview);
  inside = ui.begin_scroll("balance", inside, height_of_groups(ui, inside.width, overview));
  for (const BalanceGroup& group : overview.balance) {
    if (!group.title.empty()) {
      ui.text(inside.take_top(26, 4), group.title, {.font = Font::kStrong, .any_length = true});
    }
    for (const BalanceLine& line : group.lines) {
      draw_balance_line(ui, inside.take_top(height_of_balance(ui, inside.width, line)), line,
                        most);
    }
  }
  ui.end_scroll();
}

}  // namespace jnd::app::gui
