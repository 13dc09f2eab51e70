#pragma once

#include <chrono>
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
#include "app/sound/tried_sound.h"

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
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/how-to/run_a_session.md";
  }
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override {
    return (preflight_ && preflight_->running()) || tried_sound_ != nullptr;
  }
  void forget_study() override;
  /// Who takes part next; "" for whoever the schedule says.
  void propose(const std::string& participant) { proposed_ = participant; }
  /// Ends what the check does with a device; nothing where no check is under way.
  void press_stop() noexcept;

 private:
  void assign(const core::StudyStore& store);
  void look_before();
  void look_at_sound();
  void judge_sound();
  void try_sound();
  void go_on_with_tried_sound();
  void keep_output() const;
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
  SoundModel sound_;
  std::unique_ptr<TriedSound> tried_sound_;  ///< Empty while none is tried.
  std::chrono::steady_clock::time_point next_cue_, sound_ends_;
  std::vector<std::string> taken_;
  std::string proposed_;  ///< Who takes part next; used up by `show`.
  std::string assigned_;  ///< The cell that comes next, in words.
  std::uint64_t seed_ = 0;
};

}  // namespace jnd::app::gui
