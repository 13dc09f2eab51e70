#include "app/gui/views/apparatus_view.h"

#include <algorithm>
#include <cmath>

#include "app/gui/views/layout.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kButtonRow = 36;
constexpr float kRefusalMargin = 10;
constexpr double kTurn_rad_per_px = 0.008;
constexpr double kTurn_rad_per_press = 0.12;
constexpr double kZoomStep = 1.12;

std::string loop_summary(const LoopView& loop) {
  std::string words = tr("{:.0f} Hz · latest {:.0f} µs · missed {} · lost {}", loop.rate_hz,
                         loop.max_lateness_us, loop.missed_ticks, loop.num_dropped_samples);
  if (loop.num_limited_ticks > 0) {
    words += tr(" · limited {}", loop.num_limited_ticks);
  }
  return words;
}

/// Shows what the session waits for, and how the loop is doing, so that nobody misses it here.
void draw_what_goes_on(Ui& ui, const Rect& place, const SessionView& view) {
  ui.card(place);
  Rect inside = place.middle(place.width - 2 * kPadding, place.height - 4);
  const bool has_fault = view.step == Step::kFault || view.step == Step::kFailed;
  const bool is_late = view.loop.missed_ticks > 0 || view.loop.num_dropped_samples > 0;
  const std::string right =
      view.step == Step::kFault ? tr("F4: where it is armed again") : loop_summary(view.loop);
  const float at_right = std::min(ui.text_width(right, Font::kSmall) + 2, inside.width * 0.45f);
  ui.text(inside.take_right(at_right, 20), right,
          {.font = Font::kSmall,
           .colour = is_late ? Colour::kAmber : Colour::kSoft,
           .align = Align::kRight});
  const Colour red = Colour::kRed;
  const float width =
      std::min(ui.text_width(view.heading, Font::kStrong) + 2, inside.width * 0.5f);
  ui.text(inside.take_left(width, 14), view.heading,
          {.font = Font::kStrong, .colour = has_fault ? red : Colour::kInk});
  ui.text(inside, has_fault ? view.fault : view.sentence,
          {.colour = has_fault ? red : Colour::kSoft, .any_length = true});
}

/// Tells why the last request was not carried out, as the card of a session does.
void draw_refusal(Ui& ui, Rect& rest, const SessionView& view) {
  if (view.refusal.empty()) return;
  const std::string words = tr("Not done: {}.", view.refusal);
  const TextStyle amber{.colour = Colour::kAmber, .wrap = true};
  const float width = rest.width - 2 * kPadding;
  const float height = ui.text_height(width, words, amber);
  const Rect place = rest.take_top(height + 2 * kRefusalMargin, kGap);
  ui.card(place);
  ui.text(place.middle(width, height), words, amber);
}

void draw_hidden_apparatus(Ui& ui, const Rect& place) {
  ui.card(place);
  draw_notice(
      ui, place,
      tr("This study is double-blind: forces, speeds, paths and the apparatus in motion "
         "would tell the level, so none of them is shown. Everything is recorded."));
}

/// Explains as many of the colours and shapes as have room.
void draw_legend(Ui& ui, Rect strip) {
  const float middle = strip.y + strip.height / 2;
  const auto entry = [&](std::string_view words, auto draw_mark) {
    const float width = ui.text_width(words, Font::kSmall) + 26;
    if (strip.width < width) return;
    draw_mark(strip.x + 8);
    strip.take_left(22);
    ui.text(strip.take_left(width - 22, 16), words,
            {.font = Font::kSmall, .colour = Colour::kSoft});
  };
  const std::string force = tr("force, 1 N is {:.0f} cm", 100.0 * kArrow_m_per_n);
  entry(force, [&](float x) {
    ui.line(x - 7, middle, x + 3, middle, Colour::kAmber, 2.5f);
    ui.line(x + 6, middle, x, middle - 4, Colour::kAmber, 2.0f);
    ui.line(x + 6, middle, x, middle + 4, Colour::kAmber, 2.0f);
  });
  entry(tr("in the fluid"), [&](float x) { ui.dot(x, middle, 6, Colour::kBlue); });
  entry(tr("outside"), [&](float x) { ui.dot(x, middle, 4, Colour::kSoft); });
  entry(tr("came off"), [&](float x) { ui.fill({x - 5, middle - 5, 10, 10}, Colour::kPilot); });
}

void turn_by_keys(Ui& ui, SceneCamera& camera) {
  const auto held = [&](Key key) {
    return ui.pressed({key}, true) ? kTurn_rad_per_press : 0.0;
  };
  const double sideways_rad = held(Key::kRight) - held(Key::kLeft);
  camera.turn(sideways_rad, held(Key::kUp) - held(Key::kDown));
  if (ui.pressed({Key::kPlus}, true)) camera.zoom(kZoomStep);
  if (ui.pressed({Key::kMinus}, true)) camera.zoom(1.0 / kZoomStep);
}

void draw_camera_buttons(Ui& ui, Rect strip, ApparatusViewState& state, bool& hold) {
  struct View {
    const char *name, *label;
    char key;
    SceneCamera (*camera)() noexcept;
  };
  constexpr View kViews[] = {{"camera_above", tr_later("Above"), 'A', camera_from_above},
                             {"camera_front", tr_later("Front"), 'F', camera_from_front},
                             {"camera_side", tr_later("Side"), 'S', camera_from_side},
                             {"camera_reset", tr_later("Reset"), 'R', camera_at_first}};
  constexpr float kNarrow = 640;
  const Tone tone = strip.width < kNarrow ? Tone::kQuiet : Tone::kPlain;
  const char* label = state.held ? tr("Go on") : tr("Hold");
  const float of_hold = ui.button_width(label, {.key = {letter('H')}}) + 16;
  float wanted = of_hold;
  for (const View& view : kViews) {
    wanted += ui.button_width(tr(view.label), {.tone = tone, .key = {letter('A')}}) + 8;
  }
  const bool has_keys = wanted <= strip.width;
  for (const View& view : kViews) {
    const ButtonStyle style{.tone = tone,
                            .key = {letter(view.key)},
                            .selected = state.camera == view.camera(),
                            .hides_key = !has_keys};
    const Rect its = strip.take_left(ui.button_width(tr(view.label), style), 8);
    if (ui.button(view.name, its, tr(view.label), style)) state.camera = view.camera();
  }
  const ButtonStyle style{
      .key = {letter('H')}, .selected = state.held.has_value(), .hides_key = !has_keys};
  const Rect its = strip.take_right(std::min(ui.button_width(label, style), strip.width), 16);
  hold = ui.button("hold", its, label, style);
  const char* hint = tr("Drag or arrow keys turn · wheel or + − zoom");
  if (ui.text_width(hint, Font::kSmall) > strip.width) return;
  ui.text(strip, hint, {.font = Font::kSmall, .colour = Colour::kSoft});
}

void draw_scene(Ui& ui, const Rect& place, const SessionView& view,
                const ApparatusSources& sources, const core::Sample& sample,
                ApparatusViewState& state) {
  ui.outline(place, Colour::kLine);
  const Rect inside = place.inset(1);
  turn_by_keys(ui, state.camera);
  const Ui::Drag drag = ui.dragged("scene", inside);
  state.camera.turn(-kTurn_rad_per_px * drag.x, -kTurn_rad_per_px * drag.y);
  if (drag.wheel != 0) state.camera.zoom(std::pow(kZoomStep, drag.wheel));
  if (!sources.paint) {
    draw_notice(ui, place,
                sources.paint_problem.empty() ? tr("No picture can be drawn here.")
                                              : sources.paint_problem);
    return;
  }
  const std::uintptr_t texture =
      sources.paint({.sample = sample,
                     .surroundings = view.surroundings,
                     .camera = state.camera,
                     .colours = scene_colours(ui.theme()),
                     .width_px = static_cast<int>(ui.px(inside.width)),
                     .height_px = static_cast<int>(ui.px(inside.height))});
  if (texture == 0) return draw_notice(ui, place, tr("Loading the 3D view …"));
  ui.image(inside, texture, as_is("picture of the apparatus"));
}

/// The scopes' contents: those that are held, or the present ones.
ScopePicture scopes_of(const ApparatusSources& sources, const ApparatusViewState& state) {
  const auto& names = state.scopes.channels;
  if (!state.held) {
    return sources.scopes ? sources.scopes({names.begin(), names.end()}) : ScopePicture{};
  }
  const ApparatusViewState::Held& held = *state.held;
  ScopePicture picture{.newest_s = held.scopes.newest_s,
                       .interval_s = held.scopes.interval_s,
                       .has_joints = held.scopes.has_joints};
  for (const std::string& name : names) {
    const auto found = std::ranges::find(held.names, name) - held.names.begin();
    const auto index = static_cast<std::size_t>(found);
    picture.channels.push_back(index < held.scopes.channels.size() ? held.scopes.channels[index]
                                                                   : std::vector<ScopePoint>{});
  }
  return picture;
}

void hold_or_go_on(const SessionView& view, const ApparatusSources& sources,
                   ApparatusViewState& state) {
  if (state.held) return state.held.reset();
  state.held.emplace();
  state.held->sample = view.telemetry.sample;
  for (const ScopeChannel& channel : scope_channels(true)) {
    state.held->names.push_back(channel.name);
  }
  if (sources.scopes) state.held->scopes = sources.scopes(state.held->names);
}

bool draw_what_moves(Ui& ui, Rect place, const SessionView& view,
                     const ApparatusSources& sources, ApparatusViewState& state) {
  const ScopePicture scopes = scopes_of(sources, state);
  draw_scopes(ui, place.take_right(std::clamp(place.width * 0.4f, 340.0f, 720.0f), kGap),
              scopes, state.scopes);
  ui.card(place);
  Rect inside = place.inset(12);
  bool hold = false;
  draw_camera_buttons(ui, inside.take_top(kButtonRow, 10), state, hold);
  draw_legend(ui, inside.take_bottom(20, 8));
  draw_scene(ui, inside, view, sources, state.held ? state.held->sample : view.telemetry.sample,
             state);
  if (hold) hold_or_go_on(view, sources, state);
  return scopes.has_joints;
}

}  // namespace

RunViewResult draw_apparatus_view(Ui& ui, const SessionView& view,
                                  const ApparatusSources& sources, RunViewState& run,
                                  ApparatusViewState& state) {
  RunViewResult result;
  Rect rest = ui.screen();
  run.pad = {};
  // A field on the card gets the keyboard when the card is shown again.
  run.item_is_new = true;
  const Rect header = rest.take_top(kRunHeader);
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  draw_what_goes_on(ui, rest.take_top(46, kGap), view);
  draw_refusal(ui, rest, view);
  bool has_joints = false;
  if (view.hides_levels || view.is_alone) {
    state.held.reset();
    state.scopes.choosing.reset();
    draw_hidden_apparatus(ui, rest);
  } else {
    has_joints = draw_what_moves(ui, rest, view, sources, state);
  }
  draw_run_header(ui, header, view, run, result);
  draw_run_footer(ui, footer, view);
  if (view.pilot) ui.outline(ui.screen().inset(2), Colour::kPilot, 0, 4);
  ask_why_paused(view, run);
  if (run.dialog != RunViewState::Dialog::kNone) {
    draw_run_dialog(ui, view, run, result);
  } else if (view.doubt) {
    draw_doubt_dialog(ui, *view.doubt, result);
  } else {
    draw_channel_chooser(ui, has_joints, state.scopes);
  }
  if (!run.is_covered) result.stop = draw_emergency_stop(ui);
  return result;
}

}  // namespace jnd::app::gui
