#pragma once

#include <filesystem>
#include <memory>

#include "app/command_line/open_window.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/start_view.h"
#include "app/operator/background_task.h"
#include "app/operator/recent_studies.h"

namespace jnd::app::gui {

/// The start: recent studies, shipped studies, and a look at the machine.
class StartScreen final : public Screen {
 public:
  /// `request` names the device that the command line asks for. All arguments outlive the
  /// screen.
  StartScreen(ScreenHost& host, RecentStudies& recent, const WindowRequest& request)
      : host_(host), recent_(recent), request_(request) {}
  [[nodiscard]] const char* name() const noexcept override { return "start"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/tutorials/first_study.md";
  }
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return task_ && task_->running(); }

 private:
  void start_tour();
  void open(const std::filesystem::path& path, bool from_dialog);
  void create(const StartViewResult::New& wanted);

  ScreenHost& host_;
  RecentStudies& recent_;
  const WindowRequest& request_;
  StartModel model_;
  std::unique_ptr<BackgroundTask<StartModel>> task_;
  StartViewState state_;
};

}  // namespace jnd::app::gui
