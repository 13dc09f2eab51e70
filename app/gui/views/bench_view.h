#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"
#include "app/gui/ui.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/device_view.h"

namespace jnd::app::gui {

/// What the device's view shows.
struct BenchModel {
  const DeviceView& device;
  struct Choice {
    std::string name, description;
    bool simulated = false;
  };
  /// The devices without an address, and the one that was asked for.
  const std::vector<Choice>& choices;
  bool has_study = false;  ///< A study is open, so the tabs that need one are shown.
};

struct BenchViewState {
  enum class Page { kCommission, kDaily, kForce, kWatch };
  Page page = Page::kCommission;
  enum class Dialog { kNone, kChoose, kPush };
  Dialog dialog = Dialog::kNone;
  /// The step that the person chose; none for the one that comes next.
  std::optional<std::size_t> step;
  std::string address;  ///< The address typed in the dialog.
  int axis = 0;         ///< The axis along which a force is tried.
  bool rehearses = false;
  float left_height = 0, found_height = 0;
};

struct BenchViewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<std::string> choose;  ///< The device to change to.
  std::optional<CommissioningStep> measure, undo;
  bool write_profile = false, check = false, push = false, watch = false, look_again = false;
  bool answer = false, leave_off = false;
  bool stop = false, release_stop = false;
};

[[nodiscard]] BenchViewResult draw_bench_view(Ui& ui, const BenchModel& model,
                                              BenchViewState& state);

}  // namespace jnd::app::gui
