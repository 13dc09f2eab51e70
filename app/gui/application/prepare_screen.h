#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/command_line/open_window.h"
#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/controls_dialog.h"
#include "app/gui/views/prepare_view.h"
#include "app/operator/answer_controls.h"
#include "app/operator/preflight.h"

namespace jnd::app::gui {

/// Before a session: who, on which device, and a check of everything it needs.
class PrepareScreen final : public Screen {
 public:
  /// `request`: what the command line asks of the first session; what is used up is taken out
  /// of it. All outlive it.
  PrepareScreen(ScreenHost& host, OpenStudy& study, WindowRequest& request,
                AnswerControls& controls)
      : host_(host), study_(study), request_(request), controls_(controls) {}
  [[nodiscard]] const char* name() const noexcept override { return "prepare"; }
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override {
    return preflight_ && preflight_->running();
  }
  void forget_study() override;
  /// Ends what the check does with a device; nothing where no check is under way.
  void press_stop() noexcept;

 private:
  void assign(const core::StudyStore& store);
  void look_before();
  [[nodiscard]] PrepareModel model() const;
  void draw_controls(Ui& ui);

  ScreenHost& host_;
  OpenStudy& study_;
  WindowRequest& request_;
  AnswerControls& controls_;
  ControlsState mapping_;
  PrepareViewState state_;
  std::vector<PrepareModel::Device> devices_;
  std::unique_ptr<Preflight> preflight_;  ///< Empty while a session has the device.
  std::vector<std::string> taken_;
  std::string assigned_;  ///< The cell that comes next, in words.
  std::uint64_t seed_ = 0;
};

}  // namespace jnd::app::gui
