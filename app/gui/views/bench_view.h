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

/// What the view of a device shows.
struct BenchModel {
  const DeviceView& device;
  struct Choice {
    std::string name, description;
    bool simulated = false;
  };
  const std::vector<Choice>& choices;  ///< Devices without an address, and the one asked for.
  bool has_study = false;              ///< One is open, so that its tabs lead somewhere.
};

struct BenchViewState {
  enum class Page { kCommission, kDaily, kForce, kWatch };
  Page page = Page::kCommission;
  enum class Dialog { kNone, kChoose, kPush };
  Dialog dialog = Dialog::kNone;
  /// Chosen by the person; none: the one that comes next.
  std::optional<std::size_t> step;
  std::string address;  ///< Typed, of the dialog.
  int axis = 0;         ///< That is tried.
  bool rehearses = false;
  float left_height = 0, found_height = 0;
};

struct BenchViewResult {
  StudyTab tab = StudyTab::kNone;
  std::optional<std::string> choose;  ///< A device.
  std::optional<CommissioningStep> measure, undo;
  bool write_profile = false, check = false, push = false, watch = false, look_again = false;
  bool answer = false, leave_off = false;
  bool stop = false, release_stop = false;
};

[[nodiscard]] BenchViewResult draw_bench_view(Ui& ui, const BenchModel& model,
                                              BenchViewState& state);

}  // namespace jnd::app::gui
