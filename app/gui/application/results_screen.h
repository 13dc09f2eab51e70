#pragma once

#include <memory>

#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/results_view.h"
#include "app/operator/background_task.h"

namespace jnd::app::gui {

/// The results of a study. They are computed in the background whenever the screen is shown.
class ResultsScreen final : public Screen {
 public:
  ResultsScreen(ScreenHost& host, OpenStudy& study) : host_(host), study_(study) {}
  [[nodiscard]] const char* name() const noexcept override { return "results"; }
  [[nodiscard]] StudyTab tab() const noexcept override { return StudyTab::kResults; }
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return task_ && task_->running(); }
  void forget_study() override;

 private:
  ScreenHost& host_;
  OpenStudy& study_;
  std::unique_ptr<BackgroundTask<ResultsModel>> task_;
  ResultsViewState state_;
};

}  // namespace jnd::app::gui
