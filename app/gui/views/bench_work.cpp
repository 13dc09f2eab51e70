// What is done at the device: the steps of its commissioning, a check, or a small force.

#include <algorithm>
#include <array>

#include "app/gui/views/bench_parts.h"
#include "app/gui/views/bench_picture.h"
#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using Page = BenchViewState::Page;

constexpr float kButtons = 48;
/// The greatest height of a drawing, however large the window is.
constexpr float kTallest = 440;
constexpr std::array kStepNames = {tr_later("Homing"), tr_later("Noise"),
                                   tr_later("Frame"),  tr_later("Force"),
                                   tr_later("Delay"),  tr_later("Stability")};
static_assert(kStepNames.size() == kCommissioningSteps.size());

bool is_busy(const DeviceView& device) { return device.work != DeviceWork::kNone; }

std::size_t shown_step(const DeviceView& device, const BenchViewState& state) {
  if (device.work == DeviceWork::kMeasuring) return device.working_step;
  return state.step.value_or(device.next_step.value_or(device.steps.size() - 1));
}

void draw_pages(Ui& ui, Rect strip, const DeviceView& device, BenchViewState& state) {
  struct Look {
    Page page;
    const char *name, *label;
    char key;
  };
  const Look looks[] = {{Page::kCommission, "page_commission", tr("Commission"), '1'},
                        {Page::kDaily, "page_daily", tr("Daily check"), '2'},
                        {Page::kForce, "page_force", tr("Try a force"), '3'},
                        {Page::kWatch, "page_watch", tr("Watch"), '4'}};
  const auto style_of = [&](const Look& look, bool has_keys) {
    return ButtonStyle{.tone = Tone::kQuiet,
                       .key = {letter(look.key)},
                       .enabled = !is_busy(device),
                       .selected = state.page == look.page,
                       .hides_key = !has_keys};
  };
  const auto wanted = [&](bool has_keys) {
    float width = 0;
    for (const Look& look : looks) {
      width += ui.button_width(look.label, style_of(look, has_keys)) + 6;
    }
    return width;
  };
  const bool has_keys = wanted(true) <= strip.width;
  const float shrink = std::min(1.0f, strip.width / wanted(has_keys));
  for (const Look& look : looks) {
    const ButtonStyle style = style_of(look, has_keys);
    const Rect its = strip.take_left(shrink * ui.button_width(look.label, style), 6 * shrink);
    if (ui.button(look.name, its, look.label, style)) state.page = look.page;
  }
}

constexpr float kBesideStep = 36, kBetweenSteps = 8;

/// As many steps side by side as have room for their names.
std::size_t steps_in_row(const Ui& ui, float width) {
  float widest = 0;
  for (const char* name : kStepNames) {
    widest = std::max(widest, ui.text_width(tr(name), Font::kSmallStrong));
  }
  const float step = kBesideStep + widest + 6 + kBetweenSteps;
  const std::size_t count = kStepNames.size();
  for (const std::size_t rows : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const std::size_t in_row = (count + rows - 1) / rows;
    if (static_cast<float>(in_row) * step - kBetweenSteps <= width) return in_row;
  }
  return 2;
}

float height_of_steps(const Ui& ui, float width) {
  const std::size_t in_row = steps_in_row(ui, width);
  const std::size_t rows = (kStepNames.size() + in_row - 1) / in_row;
  const float row = rows > 1 ? 34 : 44;
  return static_cast<float>(rows) * (row + kBetweenSteps) - kBetweenSteps;
}

void draw_step_strip(Ui& ui, const Rect& strip, const DeviceView& device,
                     BenchViewState& state) {
  const std::size_t shown = shown_step(device, state);
  const std::size_t in_row = steps_in_row(ui, strip.width);
  const std::size_t num_rows = (device.steps.size() + in_row - 1) / in_row;
  const auto per_row = static_cast<float>(in_row), rows = static_cast<float>(num_rows);
  const float width = (strip.width - (per_row - 1) * kBetweenSteps) / per_row;
  const float height = (strip.height - (rows - 1) * kBetweenSteps) / rows;
  for (std::size_t i = 0; i < device.steps.size(); ++i) {
    const std::size_t column = i % in_row, line = i / in_row;
    const Rect cell{strip.x + static_cast<float>(column) * (width + kBetweenSteps),
                    strip.y + static_cast<float>(line) * (height + kBetweenSteps), width,
                    height};
    const bool is_shown = i == shown;
    if (is_shown) ui.fill(cell, Colour::kBlueSoft, 8);
    ui.outline(cell, is_shown ? Colour::kBlue : Colour::kLine, 8);
    if (ui.row(std::string("step_") + std::string(words_of(kCommissioningSteps[i]).name), cell,
               tr(kStepNames[i])) &&
        !is_busy(device)) {
      state.step = i;
    }
    const float middle = cell.y + cell.height / 2;
    if (!device.steps[i].measured_at.empty()) {
      ui.check(cell.x + 20, middle, 14, Colour::kGreen);
    } else {
      ui.ring(cell.x + 20, middle, 6, device.steps[i].waits ? Colour::kLine : Colour::kInk);
    }
    ui.text({cell.x + kBesideStep, cell.y, cell.width - kBesideStep - 4, cell.height},
            tr(kStepNames[i]),
            {.font = is_shown ? Font::kStrong : Font::kBody,
             .colour = is_shown ? Colour::kBlue : Colour::kInk});
  }
  if (is_busy(device) || ui.is_editing()) return;
  if (ui.pressed({Key::kRight})) state.step = std::min(shown + 1, device.steps.size() - 1);
  if (ui.pressed({Key::kLeft})) state.step = shown > 0 ? shown - 1 : 0;
}

/// Draws a picture with words beside it.
void draw_scene(Ui& ui, const Rect& place, const BenchPicture& picture,
                const std::string& title, const std::string& words, const std::string& below) {
  Rect rest = place;
  Rect left = rest.take_left(std::min(place.width * 0.48f, place.height * 1.34f), 22);
  left.height = std::min(left.height, 0.8f * left.width);
  ui.fill(left, Colour::kGround, 8);
  draw_bench_picture(ui, left.inset(8), picture);
  const TextStyle large{.font = Font::kLarge, .wrap = true};
  TextStyle plain{.wrap = true};
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  rest.take_top(4);
  const auto height_of = [&](float width) {
    return ui.text_height(width, title, large) + 10 +
           (words.empty() ? 0 : ui.text_height(width, words, plain) + 10) +
           (below.empty() ? 0 : ui.text_height(width, below, soft));
  };
  if (height_of(rest.width) > rest.height) plain.font = Font::kSmall;
  // The words get less width if they scroll, because the scroll bar is beside them.
  const bool scrolls = height_of(rest.width) > rest.height;
  const float content = scrolls ? height_of(rest.width - 16) : rest.height;
  rest = ui.begin_scroll("scene_words", rest, content);
  ui.text(rest.take_top(ui.text_height(rest.width, title, large), 10), title, large);
  if (!words.empty()) {
    ui.text(rest.take_top(ui.text_height(rest.width, words, plain), 10), words, plain);
  }
  if (!below.empty()) ui.text(rest, below, soft);
  ui.end_scroll();
}

std::string num_words(const std::vector<Eigen::Vector3d>& marks_m,
                      const DeviceQuestion& question) {
  return tr("Mark {} of {}: {}", question.num_touched + 1, marks_m.size(),
            place_words(marks_m, question.mark_m));
}

/// Draws what is asked, or what the device is doing.
void draw_under_way(Ui& ui, const Rect& place, const DeviceView& device,
                    const BenchViewState& state) {
  const std::vector<Eigen::Vector3d>& marks_m =
      device.work == DeviceWork::kChecking ? device.daily_marks_m : device.marks_m;
  if (device.question) {
    const DeviceQuestion& question = *device.question;
    const bool is_mark = question.act == DeviceQuestion::Act::kTouch;
    draw_scene(ui, place, picture_of_question(marks_m, question),
               is_mark ? num_words(marks_m, question) : question.words,
               is_mark ? question.words : "",
               tr("Then press Done. You have as long as you need."));
    return;
  }
  const bool rests =
      device.work == DeviceWork::kMeasuring &&
      (device.working_step == static_cast<std::size_t>(CommissioningStep::kHoming) ||
       device.working_step == static_cast<std::size_t>(CommissioningStep::kNoise) ||
       device.working_step == static_cast<std::size_t>(CommissioningStep::kFrame));
  BenchPicture picture;
  if (device.work == DeviceWork::kTryingForce) {
    picture = {.scene = BenchPicture::Scene::kPushed, .axis = state.axis};
  } else if (rests) {
    picture = picture_of_step(device, device.working_step);
  } else {
    picture.scene = BenchPicture::Scene::kMoves;
  }
  draw_scene(ui, place, picture, device.now.empty() ? tr("The device starts.") : device.now, "",
             tr("Keep clear, with the stop at hand."));
}

/// Tells how the last work ended, on the page that began it.
void draw_outcome(Ui& ui, Rect& inside, const DeviceView& device, Page page) {
  const Page its = device.outcome_of == DeviceWork::kChecking      ? Page::kDaily
                   : device.outcome_of == DeviceWork::kTryingForce ? Page::kForce
                   : device.outcome_of == DeviceWork::kWatching    ? Page::kWatch
                                                                   : Page::kCommission;
  if (device.outcome.empty() || is_busy(device) || its != page) return;
  const TextStyle style{.font = Font::kSmall,
                        .colour = device.outcome_is_good ? Colour::kGreen : Colour::kRed,
                        .wrap = true};
  const float height = ui.text_height(inside.width, device.outcome, style);
  Rect place = inside.take_bottom(std::min(height, 80.0f), 10);
  place = ui.begin_scroll("outcome", place, height);
  ui.text(place, device.outcome, style);
  ui.end_scroll();
}

/// Draws the bottom line while work goes on: its progress, Done and Stop.
void draw_busy_buttons(Ui& ui, Rect bottom, const DeviceView& device, BenchViewResult& result) {
  const bool may_leave =
      device.work != DeviceWork::kLooking && device.work != DeviceWork::kWriting;
  const ButtonStyle stop{.key = {Key::kF2}};
  const ButtonStyle done{.tone = Tone::kPrimary, .key = {Key::kEnter}, .large = true};
  if (device.question) {
    if (ui.button("done",
                  bottom.take_right(std::max(160.0f, ui.button_width(tr("Done"), done)), 12),
                  tr("Done"), done)) {
      result.answer = true;
    }
  }
  if (may_leave &&
      ui.button("leave_off", bottom.take_right(ui.button_width(tr("Stop"), stop), 20),
                tr("Stop"), stop)) {
    result.leave_off = true;
  }
  if (device.work != DeviceWork::kWatching) {
    ui.progress(bottom.middle(bottom.width, 8), device.progress);
  }
}

void draw_release(Ui& ui, Rect bottom, BenchViewResult& result) {
  const ButtonStyle release{.tone = Tone::kPrimary, .key = {letter('R')}};
  const char* label = tr("Release the stop");
  if (ui.button("release_stop", bottom.take_right(ui.button_width(label, release), 20), label,
                release)) {
    result.release_stop = true;
  }
  ui.text(bottom, tr("The emergency stop is pressed."),
          {.font = Font::kStrong, .colour = Colour::kRed});
}

void draw_rehearsal(Ui& ui, Rect& bottom, const DeviceView& device, BenchViewState& state) {
  if (!device.is_simulated) return;
  const ButtonStyle style{
      .tone = Tone::kQuiet, .key = {letter('Q')}, .selected = state.rehearses};
  const char* label = tr("Rehearse");
  constexpr float kLeast = 60;
  if (bottom.width < kLeast) return;
  const float width = std::min(ui.button_width(label, style), bottom.width);
  if (ui.button("rehearse", bottom.take_left(width, 12), label, style)) {
    state.rehearses = !state.rehearses;
  }
}

void draw_commission_buttons(Ui& ui, Rect bottom, const DeviceView& device,
                             BenchViewState& state, BenchViewResult& result) {
  const std::size_t shown = shown_step(device, state);
  const DeviceView::Step& step = device.steps[shown];
  const CommissioningStep which = kCommissioningSteps[shown];
  const bool is_measured = !step.measured_at.empty();
  const bool can = device.is_known && device.record_problem.empty();
  if (!is_measured) {
    const ButtonStyle style{
        .tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = can && !step.waits};
    if (ui.button("measure", bottom.take_right(ui.button_width(tr("Measure"), style), 12),
                  tr("Measure"), style)) {
      result.measure = which;
      state.step.reset();
    }
  } else {
    if (!device.next_step) {
      const ButtonStyle style{.tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = can};
      const char* label = tr("Write the profile");
      if (ui.button("write_profile", bottom.take_right(ui.button_width(label, style), 12),
                    label, style)) {
        result.write_profile = true;
      }
    }
    const ButtonStyle again{.key = {letter('M')}, .enabled = can && !step.waits};
    const char* label = tr("Again");
    if (ui.button("measure_again", bottom.take_right(ui.button_width(label, again), 12), label,
                  again)) {
      result.measure = which;
      state.step = shown;
    }
    const ButtonStyle undo{.key = {letter('Z'), true}, .enabled = can};
    if (ui.button("undo", bottom.take_right(ui.button_width(tr("Undo"), undo), 12), tr("Undo"),
                  undo)) {
      result.undo = which;
      state.step = shown;
    }
  }
  draw_rehearsal(ui, bottom, device, state);
}

void draw_found(Ui& ui, const Rect& place, const std::vector<DeviceLine>& lines,
                BenchViewState& state) {
  Rect inside = ui.begin_scroll("found", place, state.found_height);
  const float top = inside.y;
  for (const DeviceLine& line : lines) {
    const float height = draw_device_line(ui, inside, line);
    inside.take_top(height, 2);
    ui.line(inside.x, inside.y - 1, inside.right(), inside.y - 1, Colour::kLine);
  }
  state.found_height = inside.y - top;
  ui.end_scroll();
}

void draw_commission(Ui& ui, Rect inside, const DeviceView& device, BenchViewState& state) {
  draw_step_strip(ui, inside.take_top(height_of_steps(ui, inside.width), 14), device, state);
  if (is_busy(device) && device.work != DeviceWork::kLooking) {
    return draw_under_way(ui, inside.take_top(std::min(inside.height, kTallest)), device,
                          state);
  }
  draw_outcome(ui, inside, device, state.page);
  const DeviceView::Step& step = device.steps[shown_step(device, state)];
  const bool is_measured = !step.measured_at.empty();
  std::string below;
  if (is_measured) {
    below = tr("Measured {}.", step.measured_at);
  } else if (!device.record_problem.empty()) {
    below = device.record_problem;
  } else if (step.waits) {
    below = tr("A step before it has to be measured first.");
  } else if (device.is_simulated) {
    below =
        tr("A simulated device does all of it by itself. To rehearse, let it ask as a real "
           "one would.");
  }
  const float lines = static_cast<float>(step.found.size()) * 27.0f;
  const float room = is_measured ? inside.height - lines - 14 : inside.height;
  draw_scene(ui, inside.take_top(std::clamp(room, 130.0f, kTallest), 14),
             picture_of_step(device, shown_step(device, state)), step.title, step.to_do, below);
  if (is_measured) draw_found(ui, inside, step.found, state);
}

void draw_checked(Ui& ui, const Rect& place, const DeviceView& device, BenchViewState& state) {
  std::vector<ColumnLook> columns = {{tr("Quantity"), 1.3f},
                                     {tr("Found"), 1.3f, Align::kRight},
                                     {tr("Passes within"), 0.85f, Align::kRight}};
  need_room_for_titles(ui, columns);
  Rect inside = ui.begin_scroll("found", place, state.found_height);
  const float top = inside.y;
  draw_table_head(ui, inside, columns);
  for (const DeviceView::CheckedLine& one : device.checked) {
    Rect line = inside.take_top(27);
    const std::vector<Rect> cells = cells_of(line, columns);
    const float middle = line.y + line.height / 2;
    if (one.passed) {
      ui.check(cells[0].x + 6, middle, 12, Colour::kGreen);
    } else {
      ui.dot(cells[0].x + 6, middle, 4.5f, Colour::kRed);
    }
    Rect words = cells[0];
    words.take_left(20);
    const Colour colour = one.passed ? Colour::kInk : Colour::kRed;
    ui.text(words, one.what, {.font = Font::kSmall, .colour = colour});
    ui.text(cells[1], one.found,
            {.font = Font::kSmall, .colour = colour, .align = Align::kRight});
    ui.text(cells[2], one.expected,
            {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kRight});
  }
  state.found_height = inside.y - top;
  ui.end_scroll();
}

void draw_daily(Ui& ui, Rect inside, const DeviceView& device, BenchViewState& state) {
  if (is_busy(device) && device.work != DeviceWork::kLooking) {
    return draw_under_way(ui, inside.take_top(std::min(inside.height, kTallest)), device,
                          state);
  }
  draw_outcome(ui, inside, device, state.page);
  const bool has_result = !device.checked.empty();
  const float lines = 30 + static_cast<float>(device.checked.size()) * 27.0f;
  const float room = has_result ? inside.height - lines - 14 : inside.height;
  draw_scene(
      ui, inside.take_top(std::clamp(room, 130.0f, kTallest), 14),
      {.scene = BenchPicture::Scene::kMarks, .marks_m = device.daily_marks_m},
      tr("Is the device still as its profile says?"),
      has_result && room < 200 ? "" : device.daily_to_do,
      device.profile_file.empty() ? tr("It has no profile yet: commission it first.") : "");
  if (has_result) draw_checked(ui, inside, device, state);
}

void draw_force(Ui& ui, Rect inside, const DeviceView& device, BenchViewState& state) {
  if (is_busy(device) && device.work != DeviceWork::kLooking) {
    return draw_under_way(ui, inside.take_top(std::min(inside.height, kTallest)), device,
                          state);
  }
  draw_outcome(ui, inside, device, state.page);
  Rect strip = inside.take_top(42, 14);
  struct Look {
    const char *name, *label;
    char key;
  };
  const Look looks[] = {
      {"axis_x", tr("Right"), 'X'}, {"axis_y", tr("Away"), 'Y'}, {"axis_z", tr("Up"), 'Z'}};
  for (int axis = 0; axis < 3; ++axis) {
    const Look& look = looks[axis];
    const ButtonStyle style{.key = {letter(look.key)}, .selected = state.axis == axis};
    const Rect its = strip.take_left(std::max(110.0f, ui.button_width(look.label, style)), 10);
    if (ui.button(look.name, its, look.label, style)) state.axis = axis;
  }
  draw_scene(ui, inside.take_top(std::clamp(inside.height, 130.0f, kTallest)),
             {.scene = BenchPicture::Scene::kPushed, .axis = state.axis},
             tr("Does it push the way it is told?"),
             tr("A soft spring holds the tool, and 0.5 N push it to and fro, through the loop "
                "and the limiter of a session. Nobody's hand is in it."),
             tr("Look whether it moves that way first."));
}

/// Draws what the device tells at the moment, in large lines.
void draw_watch(Ui& ui, Rect inside, const DeviceView& device, BenchViewState& state) {
  draw_outcome(ui, inside, device, state.page);
  const bool watches = device.work == DeviceWork::kWatching;
  const TextStyle large{.font = Font::kLarge, .wrap = true};
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const std::string title = tr("What does the device tell?");
  const std::string words =
      watches
          ? tr("It has no force. Move its tool, press its switch and its buttons.")
          : tr("Its enabling switch, its buttons, its places and its sensors, as they are at "
               "each moment. It has no force meanwhile, so a hand may move it.");
  ui.text(inside.take_top(ui.text_height(inside.width, title, large), 10), title, large);
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 18), words, soft);
  if (!watches) return;
  for (const DeviceLine& line : device.live) {
    Rect its = inside.take_top(34);
    ui.fill({its.x, its.y + its.height - 1, its.width, 1}, Colour::kLine, 0);
    draw_name_and_value(ui, its, line.what, {.colour = Colour::kSoft}, line.value,
                        {.font = Font::kStrong, .any_length = true});
  }
}

}  // namespace

void draw_work_card(Ui& ui, const Rect& place, const BenchModel& model, BenchViewState& state,
                    BenchViewResult& result) {
  const DeviceView& device = model.device;
  Rect inside = draw_card(ui, place, "");
  draw_pages(ui, inside.take_top(38, 12), device, state);
  Rect bottom = inside.take_bottom(kButtons, 12);
  switch (state.page) {
    case Page::kCommission:
      draw_commission(ui, inside, device, state);
      break;
    case Page::kDaily:
      draw_daily(ui, inside, device, state);
      break;
    case Page::kForce:
      draw_force(ui, inside, device, state);
      break;
    case Page::kWatch:
      draw_watch(ui, inside, device, state);
      break;
  }
  if (is_busy(device)) return draw_busy_buttons(ui, bottom, device, result);
  if (device.stop_is_pressed) return draw_release(ui, bottom, result);
  if (state.page == Page::kCommission) {
    return draw_commission_buttons(ui, bottom, device, state, result);
  }
  if (state.page == Page::kWatch) {
    const ButtonStyle style{
        .tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = device.is_known};
    const char* label = tr("Watch");
    if (ui.button("watch",
                  bottom.take_right(std::max(140.0f, ui.button_width(label, style)), 12), label,
                  style)) {
      result.watch = true;
    }
    return;
  }
  const bool checks = state.page == Page::kDaily;
  const ButtonStyle style{
      .tone = Tone::kPrimary,
      .key = {Key::kEnter},
      .enabled = device.is_known && (!checks || !device.profile_file.empty())};
  const char* label = checks ? tr("Check") : tr("Push");
  if (ui.button(checks ? "check" : "push",
                bottom.take_right(std::max(140.0f, ui.button_width(label, style)), 12), label,
                style)) {
    if (checks) {
      result.check = true;
    } else if (device.is_simulated) {
      result.push = true;
    } else {
      state.dialog = BenchViewState::Dialog::kPush;
    }
  }
  draw_rehearsal(ui, bottom, device, state);
}

}  // namespace jnd::app::gui
