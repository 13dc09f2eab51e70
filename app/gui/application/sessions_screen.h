#pragma once

#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/sessions_view.h"

namespace jnd::app::gui {

/// The sessions of a study: what was run, what can be resumed, and whether all of it is safe.
class SessionsScreen final : public Screen {
 public:
  SessionsScreen(ScreenHost& host, OpenStudy& study) : host_(host), study_(study) {}
  [[nodiscard]] const char* name() const noexcept override { return "sessions"; }
  [[nodiscard]] StudyTab tab() const noexcept override { return StudyTab::kSessions; }
  void show() override;
  void draw(Ui& ui) override;
  void forget_study() override { state_ = {}; }

 private:
  ScreenHost& host_;
  OpenStudy& study_;
  SessionsViewState state_;
};

}  // namespace jnd::app::gui
