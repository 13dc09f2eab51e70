// The device's name, its profile, and the dialogs that choose a device and try a force.

#include <algorithm>

#include "app/gui/views/bench_parts.h"
#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kLine = 24;

void draw_block(Ui& ui, Rect& inside, const char* heading,
                const std::vector<DeviceLine>& lines) {
  if (lines.empty()) return;
  ui.heading(inside.take_top(18, 6), heading);
  for (const DeviceLine& line : lines) {
    inside.take_top(draw_device_line(ui, inside, line));
  }
  inside.take_top(14);
}

void draw_profile_status(Ui& ui, Rect& inside, const PreflightLine& line) {
  ui.heading(inside.take_top(18, 6), tr("What a session would say"));
  const TextStyle found{.font = Font::kStrong, .colour = colour_of(line.status), .wrap = true};
  Rect first = inside.take_top(ui.text_height(inside.width - 24, line.found, found), 4);
  const float middle = first.y + ui.line_height(Font::kStrong) / 2;
  if (line.status == PreflightLine::Status::kOk) {
    ui.check(first.x + 7, middle, 14, Colour::kGreen);
  } else {
    ui.dot(first.x + 7, middle, 5, colour_of(line.status));
  }
  first.take_left(24);
  ui.text(first, line.found, found);
  if (!line.remedy.empty()) {
    const TextStyle style{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
    ui.text(inside.take_top(ui.text_height(inside.width, line.remedy, style), 4), line.remedy,
            style);
  }
  inside.take_top(10);
}

void draw_checks(Ui& ui, Rect& inside, const std::vector<DeviceView::Check>& checks) {
  if (checks.empty()) return;
  constexpr std::size_t kMost = 5;
  ui.heading(inside.take_top(18, 6), tr("Daily checks"));
  for (std::size_t i = 0; i < std::min(checks.size(), kMost); ++i) {
    Rect line = inside.take_top(kLine);
    const float middle = line.y + kLine / 2;
    if (checks[i].passed) {
      ui.check(line.x + 6, middle, 12, Colour::kGreen);
    } else {
      ui.dot(line.x + 6, middle, 4.5f, Colour::kRed);
    }
    line.take_left(18);
    ui.text(line.take_left(78, 8), checks[i].day, {.font = Font::kSmall});
    ui.text(line, checks[i].words,
            {.font = Font::kSmall, .colour = Colour::kSoft, .any_length = true});
  }
  if (checks.size() > kMost) {
    ui.text(inside.take_top(kLine),
            trn("and {} earlier one", "and {} earlier ones", std::ssize(checks) - 5),
            {.font = Font::kSmall, .colour = Colour::kSoft});
  }
}

void draw_choose_dialog(Ui& ui, const BenchModel& model, BenchViewState& state,
                        BenchViewResult& result) {
  constexpr float kRow = 44;
  const auto num = static_cast<float>(model.choices.size());
  Rect inside = ui.begin_dialog("choose_device", 640, 232 + num * (kRow + 4));
  ui.text(inside.take_top(34, 8), tr("Choose a device"), {.font = Font::kLarge});
  Rect buttons = inside.take_bottom(44, 12);
  const auto choose = [&](const std::string& name) {
    result.choose = name;
    state.dialog = BenchViewState::Dialog::kNone;
  };
  for (std::size_t i = 0; i < model.choices.size(); ++i) {
    const BenchModel::Choice& choice = model.choices[i];
    const Rect row = inside.take_top(kRow, 4);
    const bool is_chosen = choice.name == model.device.name;
    if (is_chosen) ui.fill(row, Colour::kBlueSoft, 8);
    ui.outline(row, is_chosen ? Colour::kBlue : Colour::kLine, 8);
    if (ui.row("choose_" + choice.name, row, choice.name)) choose(choice.name);
    Rect words = row;
    words.take_left(12);
    words.take_right(12);
    const std::string name = choice.name + (choice.simulated ? tr(" · simulated") : "");
    ui.text(words.take_top(23), name, {.font = Font::kStrong});
    words.y -= 3;
    ui.text(words, choice.description,
            {.font = Font::kSmall, .colour = Colour::kSoft, .any_length = true});
  }
  inside.take_top(6);
  const bool entered =
      ui.text_field("address", inside.take_top(44), state.address,
                    tr("network:HOST:PORT,key=NAME or plugin:PATH or twin:seed=7"));
  const DialogChoice choice =
      draw_dialog_buttons(ui, buttons, tr("Choose"), !state.address.empty(), entered);
  ui.end_dialog();
  if (choice.done) choose(state.address);
  if (choice.cancelled) state.dialog = BenchViewState::Dialog::kNone;
}

void draw_push_dialog(Ui& ui, BenchViewState& state, BenchViewResult& result) {
  const char* words =
      tr("Nobody's hand is in the device, its tool has 10 cm of room all around, and somebody "
         "has the stop at hand? It is held by a soft spring and pushed to and fro by 0.5 N for "
         "six seconds.");
  const TextStyle style{.wrap = true};
  Rect inside = ui.begin_dialog("push_device", 560,
                                2 * 28 + 42 + 56 + 8 + ui.text_height(504, words, style));
  ui.text(inside.take_top(34, 8), tr("A force on a real device"), {.font = Font::kLarge});
  Rect buttons = inside.take_bottom(44, 12);
  ui.text(inside, words, style);
  const DialogChoice choice = draw_dialog_buttons(ui, buttons, tr("Push"), true, false);
  ui.end_dialog();
  if (choice.done) result.push = true;
  if (choice.done || choice.cancelled) state.dialog = BenchViewState::Dialog::kNone;
}

}  // namespace

float draw_device_line(Ui& ui, const Rect& place, const DeviceLine& line) {
  const float wanted = ui.text_width(line.what, Font::kSmall) + 2;
  const float value = ui.text_width(line.value, Font::kSmall) + 2;
  const TextStyle what{.font = Font::kSmall, .colour = Colour::kSoft};
  Rect first = place;
  first.height = kLine;
  if (wanted + value + 16 <= place.width) {
    ui.text(first, line.what, what);
    ui.text(first, line.value, {.font = Font::kSmall, .align = Align::kRight});
    return kLine;
  }
  // A path or a long value is on a line of its own below, wrapped.
  const TextStyle wrapped{.font = Font::kSmall, .wrap = true};
  ui.text(first, line.what, what);
  const float height = ui.text_height(place.width - 12, line.value, wrapped);
  ui.text({place.x + 12, place.y + kLine, place.width - 12, height}, line.value, wrapped);
  return kLine + height + 2;
}

void draw_device_card(Ui& ui, const Rect& place, const BenchModel& model, BenchViewState& state,
                      BenchViewResult& result) {
  const DeviceView& device = model.device;
  Rect inside = draw_card(ui, place, "");
  const bool is_busy = device.work != DeviceWork::kNone;
  const ButtonStyle change{.key = {letter('C')}, .enabled = !is_busy};
  const ButtonStyle again{.tone = Tone::kQuiet, .key = {letter('L')}, .enabled = !is_busy};
  Rect bottom = inside.take_bottom(42, 12);
  const float wanted =
      ui.button_width(tr("Change"), change) + 10 + ui.button_width(tr("Look again"), again);
  const float shrink = std::min(1.0f, bottom.width / wanted);
  if (ui.button("change_device",
                bottom.take_left(shrink * ui.button_width(tr("Change"), change), 10 * shrink),
                tr("Change"), change)) {
    state.dialog = BenchViewState::Dialog::kChoose;
    state.address = device.name.find(':') == std::string::npos ? "" : device.name;
  }
  if (ui.button("look_again",
                bottom.take_left(shrink * ui.button_width(tr("Look again"), again)),
                tr("Look again"), again)) {
    result.look_again = true;
  }
  Rect head = inside.take_top(38, 8);
  if (device.is_known) {
    const char* kind = device.is_simulated ? tr("SIMULATED") : tr("real");
    const Rect chip = head.take_right(ui.chip_width(kind), 12);
    ui.chip(chip.x, chip.y + 6, kind, device.is_simulated ? Colour::kAmber : Colour::kBlue);
  }
  ui.text(head, device.name, {.font = Font::kTitle, .any_length = true});
  inside = ui.begin_scroll("device", inside, state.left_height);
  const float top = inside.y;
  if (!device.problem.empty()) {
    const TextStyle style{.colour = Colour::kRed, .wrap = true};
    ui.text(inside.take_top(ui.text_height(inside.width, device.problem, style), 14),
            device.problem, style);
  }
  if (device.work == DeviceWork::kLooking && !device.is_known) {
    ui.text(inside.take_top(kLine), tr("Looking …"), {.colour = Colour::kSoft});
  }
  if (device.is_known) draw_profile_status(ui, inside, device.profile);
  draw_checks(ui, inside, device.checks);
  if (!device.checks.empty()) inside.take_top(14);
  draw_block(ui, inside, tr("Profile"), device.profile_facts);
  draw_block(ui, inside, tr("What was measured, 95 %"), device.profile_numbers);
  draw_block(ui, inside, tr("What the device says"), device.facts);
  state.left_height = inside.y - top;
  ui.end_scroll();
}

void draw_bench_dialog(Ui& ui, const BenchModel& model, BenchViewState& state,
                       BenchViewResult& result) {
  if (state.dialog == BenchViewState::Dialog::kChoose) {
    draw_choose_dialog(ui, model, state, result);
  } else if (state.dialog == BenchViewState::Dialog::kPush) {
    draw_push_dialog(ui, state, result);
  }
}

}  // namespace jnd::app::gui
