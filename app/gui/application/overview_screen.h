#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/command_line/open_window.h"
#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/overview_view.h"
#include "app/operator/background_task.h"

namespace jnd::app::gui {

/// Where a study stands: how many participants are done, who comes next, and whether the
/// sessions went well.
class OverviewScreen final : public Screen {
 public:
  /// `request` holds the seed that the command line asks for. All arguments outlive the screen.
  OverviewScreen(ScreenHost& host, OpenStudy& study, const WindowRequest& request)
      : host_(host), study_(study), request_(request) {}
  [[nodiscard]] const char* name() const noexcept override { return "overview"; }
  [[nodiscard]] StudyTab tab() const noexcept override { return StudyTab::kOverview; }
  void show() override;
  void update(Ui& ui) override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return task_ && task_->running(); }
  void forget_study() override;

 private:
  /// Stores something by `work`, and reads the study again. If it fails, the dialog stays open
  /// and shows the reason.
  void write(OverviewState::Dialog dialog, const std::function<void()>& work);

  ScreenHost& host_;
  OpenStudy& study_;
  const WindowRequest& request_;
  std::unique_ptr<BackgroundTask<StudyOverview>> task_;
  std::optional<StudyOverview> overview_;  ///< The overview that was read last.
  std::string problem_;
  bool was_working_ = false;
  OverviewState state_;
};

}  // namespace jnd::app::gui
