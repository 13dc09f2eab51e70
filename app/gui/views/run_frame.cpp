// Everything around the card: header, footer, list of stages, progress and last answers.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "app/gui/views/layout.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

/// The button acts when the mouse button goes down.
constexpr ButtonStyle kStop{.tone = Tone::kDanger, .key = {Key::kEscape}, .at_once = true};
constexpr const char* kStopLabel = tr_later("Emergency stop");
constexpr float kStopMargin = 20;

struct Chip {
  std::string_view words;
  Colour colour;
};

/// What kind of session it is, as chips; the most important one comes first.
std::vector<Chip> chips_of(const SessionView& view) {
  std::vector<Chip> chips = {{view.participant, Colour::kBlue}};
  if (view.pilot) chips.push_back({tr("pilot: not data"), Colour::kPilot});
  if (view.blinding != experiments::Blinding::kNone) {
    chips.push_back(
        {view.hides_levels ? tr("levels hidden") : tr("levels shown"), Colour::kBlue});
  }
  if (view.simulated) chips.push_back({tr("simulated hand"), Colour::kAmber});
  return chips;
}

/// The width of the chips that are never left out, and of the gaps between them.
float least_title_width(const Ui& ui, const SessionView& view) {
  constexpr float kTitle = 40, kAfterTitle = 18, kBetween = 10;
  float width = kTitle + kAfterTitle;
  const std::vector<Chip> chips = chips_of(view);
  // The participant's chip, and the pilot's if there is one.
  const std::size_t never_left_out = view.pilot ? 2 : 1;
  for (std::size_t i = 0; i < std::min(chips.size(), never_left_out); ++i) {
    width += ui.chip_width(chips[i].words) + kBetween;
  }
  return width;
}

/// Draws the title and the chips. A long title is shortened in favour of the participant and
/// the pilot chip. Chips without room are left out from the end.
void draw_title(Ui& ui, const Rect& strip, const SessionView& view) {
  constexpr float kBetween = 10;
  constexpr float kAfterTitle = 18;
  const std::size_t never_left_out = view.pilot ? 2 : 1;
  const std::vector<Chip> chips = chips_of(view);
  float needed = 0;
  for (std::size_t i = 0; i < std::min(chips.size(), never_left_out); ++i) {
    needed += ui.chip_width(chips[i].words) + kBetween;
  }
  const float middle = strip.y + strip.height / 2;
  const float title = std::clamp(strip.width - kAfterTitle - needed, 0.0f,
                                 ui.text_width(view.study, Font::kBody) + 2);
  ui.text({strip.x, middle - ui.line_height(Font::kBody) / 2, title, 24}, view.study,
          {.any_length = true});
  float x = strip.x + title + kAfterTitle;
  for (const Chip& chip : chips) {
    if (x + ui.chip_width(chip.words) > strip.right()) return;
    x += ui.chip(x, middle - 13, chip.words, chip.colour) + kBetween;
  }
}

/// A part of the session's state in the footer: a dot and words. Words *between stars* are
/// drawn stronger.
struct Health {
  Colour dot;
  std::string words;
};

constexpr float kBeforeHealth = 16;

float health_width(const Ui& ui, std::string_view words, Font font) {
  float width = kBeforeHealth;
  while (!words.empty()) {
    const std::string_view part = words.substr(0, words.find('*'));
    words.remove_prefix(std::min(part.size() + 1, words.size()));
    width += ui.text_width(part, font);
  }
  return width;
}

void draw_health(Ui& ui, float x, const Rect& strip, const Health& health, Font font) {
  const float middle = strip.y + strip.height / 2;
  ui.dot(x + 4.5f, middle, 4.5f, health.dot);
  x += kBeforeHealth;
  std::string_view words = health.words;
  for (bool is_strong = false; !words.empty(); is_strong = !is_strong) {
    const std::string_view part = words.substr(0, words.find('*'));
    words.remove_prefix(std::min(part.size() + 1, words.size()));
    if (part.empty()) continue;
    const float width = ui.text_width(part, font);
    ui.text({x, middle - ui.line_height(font) / 2, width + 2, 20}, part,
            {.font = font, .colour = is_strong ? Colour::kInk : Colour::kSoft});
    x += width;
  }
}

/// Draws the parts from the left, as large and as far apart as there is room for. If there is
/// too little room, good news is left out from the end, but never bad news.
void draw_healths(Ui& ui, const Rect& strip, std::vector<Health> healths) {
  struct Look {
    Font font;
    float between;
  };
  constexpr Look kLooks[] = {{Font::kSmall, 26}, {Font::kSmall, 14}, {Font::kTiny, 14}};
  Look look = kLooks[0];
  const auto wanted = [&] {
    float width = -look.between;
    for (const Health& health : healths) {
      width += health_width(ui, health.words, look.font) + look.between;
    }
    return width;
  };
  for (const Look& tried : kLooks) {
    look = tried;
    if (wanted() <= strip.width) break;
  }
  while (healths.size() > 1 && wanted() > strip.width) {
    const auto well = std::find_if(healths.rbegin(), healths.rend(),
                                   [](const Health& one) { return one.dot == Colour::kGreen; });
    if (well == healths.rend()) break;
    healths.erase(std::next(well).base());
  }
  float x = strip.x;
  for (const Health& health : healths) {
    draw_health(ui, x, strip, health, look.font);
    x += health_width(ui, health.words, look.font) + look.between;
  }
}

std::string loop_words(const LoopView& loop) {
  // Translators: what stands *between stars* is drawn stronger, here and below.
  return tr("*{:.0f} Hz* · late {:.2f} µs · missed {}", loop.rate_hz, loop.lateness_p99_us,
            loop.missed_ticks) +
         (loop.num_dropped_samples > 0 ? tr(" · samples lost") : "");
}

/// How much of the session is on disk.
std::string stored_up_to(const SessionView& view) {
  if (view.trials_on_disk > 0) return tr("On disk up to *trial {}*", view.trials_on_disk);
  if (view.last_sequence > 0) return tr("On disk up to *event {}*", view.last_sequence);
  return tr("Nothing stored yet");
}

}  // namespace

float emergency_stop_width(const Ui& ui) { return ui.button_width(tr(kStopLabel), kStop); }

bool draw_emergency_stop(Ui& ui) {
  Rect strip = ui.screen().take_top(kRunHeader);
  strip.take_right(kStopMargin);
  const Rect place = strip.take_right(ui.button_width(tr(kStopLabel), kStop));
  return ui.button("emergency_stop", place.middle(place.width, 38), tr(kStopLabel), kStop);
}

void draw_run_header(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state,
                     RunViewResult& result) {
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.bottom(), place.right(), place.bottom(), Colour::kLine);
  Rect strip = place.inset(0);
  strip.take_left(20);
  strip.take_right(kStopMargin);
  // The stop is drawn last, above every dialog.
  strip.take_right(ui.button_width(tr(kStopLabel), kStop), 10);
  using Dialog = RunViewState::Dialog;
  const bool running = view.step != Step::kFailed && view.step != Step::kFinished;
  const bool begun = running && view.step != Step::kBegin;
  struct Command {
    const char *name, *label;
    Chord key;
    bool enabled;
    Dialog dialog;
  };
  const Command commands[] = {
      {"leave", tr("Leave"), {letter('W'), true}, running, Dialog::kLeave},
      {"pause",
       tr("Pause"),
       {letter('P')},
       begun && view.step != Step::kPaused && view.step != Step::kFault,
       Dialog::kWhyPaused},
      {"note", tr("Note"), {letter('N'), true}, begun, Dialog::kNote},
      {"undo",
       tr("Undo"),
       {letter('Z'), true},
       begun && view.step != Step::kFault && !view.answers.empty() &&
           view.answers.front().can_undo,
       Dialog::kUndo}};
  const ButtonStyle apparatus_style{.tone = Tone::kQuiet, .key = {Key::kF4}};
  const bool has_apparatus = running && !view.is_alone;
  const char* apparatus_label =
      state.shows_apparatus ? tr("Back to the session") : tr("Apparatus");
  // If room is short, keys are left out first, so that participant and pilot remain; then the
  // buttons are narrower.
  const float room =
      strip.width - ui.text_width("jnd", Font::kLarge) - 18 - least_title_width(ui, view);
  const auto wanted = [&](bool has_keys) {
    const auto of = [&](const char* label, const Chord& key) {
      return ui.button_width(label,
                             {.tone = Tone::kQuiet, .key = key, .hides_key = !has_keys}) +
             4;
    };
    float width = has_apparatus ? of(apparatus_label, apparatus_style.key) : 0.0f;
    for (const Command& command : commands) width += of(command.label, command.key);
    return width;
  };
  const bool has_keys = wanted(true) <= room;
  const float shrink = std::min(1.0f, std::max(0.5f, room / wanted(has_keys)));
  for (const Command& command : commands) {
    const ButtonStyle style{.tone = Tone::kQuiet,
                            .key = command.key,
                            .enabled = command.enabled,
                            .hides_key = !has_keys};
    const Rect its = strip.take_right(shrink * ui.button_width(command.label, style), 4);
    if (!ui.button(command.name, its.middle(its.width, 36), command.label, style)) continue;
    if (command.dialog == Dialog::kWhyPaused) {
      // The hand is released first; the reason is asked once the pause has begun.
      result.requests.emplace_back(operate::Pause{});
      state.asked_to_pause = true;
    } else {
      open_dialog(state, command.dialog);
    }
  }
  // A participant who is alone could read the answer from the apparatus.
  if (has_apparatus) {
    ButtonStyle style = apparatus_style;
    style.hides_key = !has_keys;
    const Rect its = strip.take_right(shrink * ui.button_width(apparatus_label, style), 4);
    if (ui.button("apparatus", its.middle(its.width, 36), apparatus_label, style)) {
      state.shows_apparatus = !state.shows_apparatus;
    }
  }
  ui.text(strip.middle(strip.width, ui.line_height(Font::kLarge)), "jnd",
          {.font = Font::kLarge});
  strip.take_left(ui.text_width("jnd", Font::kLarge), 18);
  draw_title(ui, strip, view);
}

void draw_run_footer(Ui& ui, const Rect& place, const SessionView& view) {
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.y, place.right(), place.y, Colour::kLine);
  std::vector<Health> healths;
  const LoopView& loop = view.loop;
  const bool late = loop.missed_ticks > 0 || loop.num_dropped_samples > 0;
  healths.push_back({view.step == Step::kFault || view.step == Step::kFailed ? Colour::kRed
                     : late                                                  ? Colour::kAmber
                                                                             : Colour::kGreen,
                     loop_words(loop)});
  if (view.is_disarmed) {
    healths.push_back({Colour::kAmber, tr("*Disarmed*, no force")});
  } else if (view.hides_levels || view.is_alone) {
    healths.push_back({Colour::kGreen, tr("Force *within limits*")});
  } else {
    const core::PlainVector& force = view.telemetry.total_force_n;
    const double force_n =
        std::sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    const core::PlainVector& velocity = view.telemetry.hand_velocity_m_per_s;
    const double speed_m_per_s = std::sqrt(
        velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
    healths.push_back({view.telemetry.limited ? Colour::kAmber : Colour::kGreen,
                       tr("Force *{:.1f} N* of {:.0f} N · {:.2f} m/s", force_n,
                          view.max_total_force_n, speed_m_per_s)});
  }
  healths.push_back(
      {view.step == Step::kFailed ? Colour::kRed : Colour::kGreen, stored_up_to(view)});
  const int attached = __builtin_popcount(view.telemetry.sample.attached_bits);
  if (view.telemetry.warning != core::Fault::kNone) {
    healths.push_back(
        {Colour::kAmber,
         "*" + std::string(tr(core::warning_words(view.telemetry.warning).data())) + "*"});
  } else {
    healths.push_back({attached == view.num_contact_points ? Colour::kGreen : Colour::kAmber,
                       tr("*{}* of {} points attached", attached, view.num_contact_points)});
  }
  const ButtonStyle keys{.tone = Tone::kQuiet, .key = {Key::kF1}};
  Rect strip = place;
  strip.take_left(20);
  strip.take_right(16);
  (void)strip.take_right(ui.button_width(tr("All keys"), keys),
                         // The application draws this button.
                         8);
  float wanted = 0;
  for (const Health& health : healths) {
    wanted += health_width(ui, health.words, Font::kSmall) + 26;
  }
  // The device's name is left out first, because the preparation shows it, too.
  const float width = ui.text_width(view.device, Font::kSmall) + 2;
  if (wanted + width <= strip.width) {
    ui.text(strip.take_right(width, 10), view.device,
            {.font = Font::kSmall, .colour = Colour::kSoft});
  }
  draw_healths(ui, strip, std::move(healths));
}

void draw_stage_list(Ui& ui, const Rect& place, const SessionView& view) {
  ui.card(place);
  Rect inside = place.inset(18);
  Rect times = inside.take_bottom(84, 10);
  ui.heading(inside.take_top(16, 10), tr("Session"));
  // A long session shows the stages around the one under way.
  constexpr float kLine = 38, kNarrow = 220;
  const bool is_narrow = place.width < kNarrow;
  const auto room = static_cast<std::size_t>(std::max(1.0f, inside.height / kLine));
  const std::size_t count = view.stages.size();
  const auto now = static_cast<std::size_t>(std::max<std::int64_t>(0, view.stage));
  std::size_t first = 0;
  if (count > room) first = std::min(now > room / 2 ? now - room / 2 : 0, count - room);
  for (std::size_t i = first; i < std::min(count, first + room); ++i) {
    const StageLine& stage = view.stages[i];
    Rect line = inside.take_top(kLine);
    const bool is_now = stage.status == StageLine::Status::kNow;
    if (is_now) ui.fill(line, Colour::kBlueSoft, 6);
    const float middle = line.y + line.height / 2;
    const float x = line.x + 18;
    if (stage.status == StageLine::Status::kDone) {
      ui.line(x - 5, middle, x - 1, middle + 4, Colour::kInk, 1.6f);
      ui.line(x - 1, middle + 4, x + 6, middle - 5, Colour::kInk, 1.6f);
    } else {
      ui.dot(x, middle, 6, is_now ? Colour::kBlue : Colour::kSoft);
      if (!is_now) ui.dot(x, middle, 4.6f, Colour::kCard);
    }
    line.take_left(40);
    ui.text(line, stage.title,
            {.font = is_narrow ? (is_now ? Font::kSmallStrong : Font::kSmall)
                     : is_now  ? Font::kStrong
                               : Font::kBody,
             .colour = is_now                                      ? Colour::kBlue
                       : stage.status == StageLine::Status::kLater ? Colour::kSoft
                                                                   : Colour::kInk,
             .any_length = true});
  }
  const auto time_line = [&](const char* name, const std::string& value) {
    draw_name_and_value(ui, times.take_top(28), name, {.colour = Colour::kSoft}, value,
                        {.font = Font::kStrong});
  };
  if (view.num_trials > 0) {
    time_line(tr("Answers"), view.num_trials_is_expected
                                 ? tr("{} of about {}", view.trials_on_disk, view.num_trials)
                                 : tr("{} of {}", view.trials_on_disk, view.num_trials));
  }
  time_line(tr("Elapsed"), clock_words(view.elapsed_s));
  time_line(tr("About left"),
            view.step == Step::kFinished ? tr("{} s", 0) : about_words(view.left_s));
}

void draw_progress_card(Ui& ui, const Rect& place, const SessionView& view) {
  ui.card(place);
  Rect inside = place.inset(18);
  inside.y -= 6;
  const Rect words = inside.take_top(24, 8);
  std::string left;
  std::string right;
  double ratio = view.done_ratio;
  if (view.trial) {
    const TrialView& trial = *view.trial;
    left = trial.num_is_expected
               ? tr("Trial {} of about {}", trial.in_block, trial.num_in_block)
               : tr("Trial {} of {}", trial.in_block, trial.num_in_block);
    const auto now = static_cast<std::size_t>(view.stage);
    right = now < view.stages.size() ? view.stages[now].title : "";
    if (trial.num_repetitions > 1) {
      right += tr(" · repetition {} of {}", trial.repetition, trial.num_repetitions);
    }
    ratio = static_cast<double>(trial.in_block - 1) / trial.num_in_block;
  } else {
    left = view.step == Step::kFinished
               ? tr("Session finished")
               : tr("Part {} of {}",
                    std::min<std::size_t>(static_cast<std::size_t>(view.stage) + 1,
                                          view.stages.size()),
                    view.stages.size());
    right = view.item && view.item->count > 1
                ? tr("{} of {}", view.item->index, view.item->count)
            : view.medium && view.medium->count > 1
                ? tr("{} of {}", view.medium->index, view.medium->count)
                : "";
  }
  draw_name_and_value(ui, words, left, {.font = Font::kStrong}, right,
                      {.colour = Colour::kSoft, .any_length = true});
  ui.progress(inside.take_top(8), ratio);
}

void draw_answers(Ui& ui, const Rect& place, const SessionView& view, RunViewState& state) {
  ui.card(place);
  Rect inside = place.inset(14);
  const Rect head = inside.take_top(24);
  std::vector<ColumnLook> columns = {{tr("Last answers"), 0.42f},
                                     {tr("answer"), 0.2f, Align::kRight},
                                     {tr("time"), 0.18f, Align::kRight},
                                     {"", 0.2f, Align::kRight}};
  need_room_for_titles(ui, columns);
  need_room(ui, columns[2], as_is("00.0 s"), Font::kMono);
  need_room(ui, columns[3], tr("change"), Font::kBody);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft};
  Rect padded = head;
  padded.x += 8;
  padded.width -= 16;
  std::vector<Rect> cells = cells_of(padded, columns, 10);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    TextStyle style = soft;
    style.align = columns[i].align;
    ui.text(cells[i], columns[i].title, style);
  }
  ui.line(inside.x, inside.y, inside.right(), inside.y, Colour::kLine);
  constexpr float kLine = 34;
  const auto correct = [&state](const AnswerLine& answer) {
    open_dialog(state, RunViewState::Dialog::kCorrect);
    state.correct = {.line = answer};
  };
  const bool may_correct = view.step != Step::kFinished && view.step != Step::kFailed &&
                           view.step != Step::kFault && view.step != Step::kBegin;
  if (may_correct && !view.answers.empty()) {
    const Chord key{Key::kF3};
    ui.text(cells[3], printed_words(key),
            {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kRight});
    if (ui.pressed(key)) correct(view.answers.front());
  }
  for (const AnswerLine& answer : view.answers) {
    if (inside.height < kLine) break;
    Rect line = inside.take_top(kLine);
    const std::string name = "answer_" + std::to_string(answer.trial);
    const std::string label = tr("{}, trial {}", answer.block, answer.in_block);
    if (ui.row(name, line, label) && may_correct) correct(answer);
    line.x += 8;
    line.width -= 16;
    cells = cells_of(line, columns, 10);
    Rect trial = cells[0];
    const float width = ui.text_width(label, Font::kBody) + 2;
    // A hint stands beside the trial if there is room; otherwise the mouse shows it.
    constexpr float kLeastHint = 80;
    const bool has_hint = !answer.hint.empty() && trial.width - width - 14 >= kLeastHint;
    ui.text(has_hint ? trial.take_left(width, 14) : trial, label,
            {.colour = answer.hint.empty() || has_hint ? Colour::kInk : Colour::kAmber,
             .any_length = true});
    if (has_hint) {
      ui.text(trial, answer.hint,
              {.font = Font::kSmall, .colour = Colour::kAmber, .any_length = true});
    }
    if (!answer.hint.empty() && ui.hovered(cells[0])) {
      ui.tooltip(ui.mouse_x(), ui.mouse_y(), answer.hint);
    }
    ui.text(cells[1], answer.answer, {.align = Align::kRight, .any_length = true});
    ui.text(cells[2], formatted("%.1f s", answer.response_time_s),
            {.font = Font::kMono, .align = Align::kRight});
    if (may_correct) {
      ui.text(cells[3], tr("change"), {.colour = Colour::kSoft, .align = Align::kRight});
    }
    ui.line(inside.x, inside.y, inside.right(), inside.y, Colour::kLine);
  }
}

}  // namespace jnd::app::gui
