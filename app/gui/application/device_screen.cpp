#include "app/gui/application/device_screen.h"

#include "app/language/words.h"
#include "app/operator/device_look.h"
#include "app/operator/remembered_stop.h"
#include "device/registry/device_registry.h"

namespace jnd::app::gui {
namespace {

/// All devices that need no address, and the one that was asked for with its address.
std::vector<BenchModel::Choice> choices_with(const std::string& asked) {
  std::vector<BenchModel::Choice> all;
  bool has_asked = false;
  for (const device::DeviceEntry& entry : device::devices()) {
    if (!entry.argument.empty()) continue;
    has_asked |= entry.name == asked;
    all.push_back({.name = std::string(entry.name),
                   .description = tr(entry.description.data()),
                   .simulated = entry.make("", kDeviceRate_hz)->capabilities().simulated});
  }
  if (!has_asked && !asked.empty()) all.push_back({asked, tr("as it was asked for"), false});
  return all;
}

}  // namespace

std::string waiting_device(const WindowRequest& request) {
  return request.device.empty() ? std::string(device::devices().front().name) : request.device;
}

DeviceScreen::DeviceScreen(ScreenHost& host, const OpenStudy& study,
                           const WindowRequest& request)
    : host_(host),
      study_(study),
      request_(request),
      device_(host.wake(), request.allow_no_realtime, stops_folder()) {}

void DeviceScreen::show() {
  if (choices_.empty()) choices_ = choices_with(waiting_device(request_));
  if (device_.device().empty()) {
    device_.choose(waiting_device(request_), request_.device_profile.string());
  } else {
    device_.look_again();
  }
}

void DeviceScreen::draw(Ui& ui) {
  const DeviceView view = device_.view();
  act(draw_bench_view(ui, {.device = view, .choices = choices_, .has_study = study_.is_open()},
                      state_));
}

void DeviceScreen::act(const BenchViewResult& result) {
  if (result.stop) device_.press_stop();
  if (result.release_stop) device_.release_stop();
  if (result.answer) device_.answer();
  if (result.leave_off) device_.leave_off();
  device_.set_rehearsing(state_.rehearses);
  if (result.choose) {
    const bool is_asked = *result.choose == request_.device;
    device_.choose(*result.choose, is_asked ? request_.device_profile.string() : "");
    state_.step.reset();
  }
  if (result.look_again) device_.look_again();
  if (result.measure) device_.measure(*result.measure);
  if (result.undo) device_.undo(*result.undo);
  if (result.write_profile) device_.write_profile();
  if (result.check) device_.check_daily();
  if (result.push) device_.try_force(state_.axis);
  if (result.watch) device_.watch();
  if (result.tab != StudyTab::kNone) host_.go_to(result.tab);
}

}  // namespace jnd::app::gui
