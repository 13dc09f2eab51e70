#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/command_line/open_window.h"
#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/bench_view.h"
#include "app/operator/operated_device.h"

namespace jnd::app::gui {

/// A device outside of any session: what it is, its profile, its commissioning and checks.
class DeviceScreen final : public Screen {
 public:
  /// `request` names the device that the command line asks for. All arguments outlive the
  /// screen.
  DeviceScreen(ScreenHost& host, const OpenStudy& study, const WindowRequest& request);
  [[nodiscard]] const char* name() const noexcept override { return "device"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/commissioning.md";
  }
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return device_.works(); }

  /// True while the device may move, or waits for an answer.
  [[nodiscard]] bool is_live() const noexcept { return device_.is_live(); }
  /// May be called from any thread.
  void press_stop() noexcept { device_.press_stop(); }
  void beat(bool is_in_sight) noexcept { device_.beat(is_in_sight); }
  /// Ends what goes on; what was measured is kept.
  void leave_off() { device_.leave_off(); }

 private:
  void act(const BenchViewResult& result);

  ScreenHost& host_;
  const OpenStudy& study_;
  const WindowRequest& request_;
  std::vector<BenchModel::Choice> choices_;
  BenchViewState state_;
  OperatedDevice device_;
};

/// The device that is proposed first: the one that the command line asks for, otherwise the
/// first of the registry.
[[nodiscard]] std::string waiting_device(const WindowRequest& request);

}  // namespace jnd::app::gui
