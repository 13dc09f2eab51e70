#include "app/gui/views/bench_view.h"

#include <algorithm>
#include <vector>

#include "app/gui/views/bench_parts.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

/// While the device may move, the header has no tabs that lead away from the stop.
void draw_header(Ui& ui, const Rect& place, const BenchModel& model, bool may_move,
                 BenchViewResult& result) {
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.bottom(), place.right(), place.bottom(), Colour::kLine);
  Rect strip = place;
  strip.take_left(20);
  strip.take_right(20 + emergency_stop_width(ui), 12);
  ui.text(strip.take_left(ui.text_width("jnd", Font::kLarge) + 1, 18), "jnd",
          {.font = Font::kLarge});
  if (may_move) {
    ui.text(strip,
            model.device.work == DeviceWork::kWatching
                ? tr("The device is watched and has no force.")
                : tr("The device may move: keep clear of it."),
            {.colour = Colour::kAmber});
    return;
  }
  std::vector<StudyTabLook> tabs = study_tabs();
  if (!model.has_study) {
    std::erase_if(tabs, [](const StudyTabLook& tab) {
      return tab.tab != StudyTab::kStart && tab.tab != StudyTab::kDevice;
    });
  }
  result.tab = draw_tabs(ui, strip, tabs, StudyTab::kDevice, 0);
}

}  // namespace

StudyTabLook tab_of_device() {
  return {StudyTab::kDevice, "tab_device", tr_later("Device"), '4'};
}

BenchViewResult draw_bench_view(Ui& ui, const BenchModel& model, BenchViewState& state) {
  BenchViewResult result;
  const DeviceWork work = model.device.work;
  const bool may_move = work == DeviceWork::kMeasuring || work == DeviceWork::kChecking ||
                        work == DeviceWork::kTryingForce || work == DeviceWork::kWatching;
  Rect rest = ui.screen();
  draw_header(ui, rest.take_top(kHeaderHeight), model, may_move, result);
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  const Rect left = rest.take_left(std::clamp(rest.width * 0.38f, 330.0f, 560.0f), kGap);
  draw_device_card(ui, left, model, state, result);
  draw_work_card(ui, rest, model, state, result);
  draw_study_footer(ui, footer,
                    model.device.record.empty()
                        ? std::string()
                        : tr("Every measurement is kept in {}", model.device.record),
                    "");
  if (may_move) state.dialog = BenchViewState::Dialog::kNone;
  draw_bench_dialog(ui, model, state, result);
  result.stop = draw_emergency_stop(ui);
  return result;
}

}  // namespace jnd::app::gui
