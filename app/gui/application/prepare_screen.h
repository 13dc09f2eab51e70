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

/// The screen before a session: who takes part, on which device, and a check of everything that
/// the session needs.
class PrepareScreen final : public Screen {
 public:
  /// `request` is what the command line asks of the first session; what is used up is removed
  /// from it. All arguments outlive the screen.
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
  /// Sets who takes part next; "" leaves it to the schedule.
  void propose(const std::string& participant) { proposed_ = participant; }
  /// Stops what the check does with a device; does nothing if no check is under way.
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
  /// The check before a session; empty while a session has the device.
  std::unique_ptr<Preflight> preflight_;
  SoundModel sound_;
  /// The sound that is being tried; empty if none is.
  std::unique_ptr<TriedSound> tried_sound_;
  std::chrono::steady_clock::time_point next_cue_, sound_ends_;
  std::vector<std::string> taken_;
  std::string proposed_;  ///< Who takes part next; `show` uses it up.
  std::string assigned_;  ///< The cell that comes next, in words.
  std::uint64_t seed_ = 0;
};

}  // namespace jnd::app::gui
