#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/record_view.h"
#include "app/operator/background_task.h"

namespace jnd::app::gui {

/// The page of one stored session: what happened in it, and what can be done to it afterwards.
class RecordScreen final : public Screen {
 public:
  RecordScreen(ScreenHost& host, OpenStudy& study) : host_(host), study_(study) {}
  [[nodiscard]] const char* name() const noexcept override { return "record"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/how-to/look_through_a_session.md";
  }
  /// Which session is shown next.
  void choose(std::int64_t session);
  void show() override;
  void update(Ui& ui) override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return task_ && task_->running(); }
  void forget_study() override;

 private:
  void read();
  void look_at_fault();
  void act(const RecordViewResult& result);

  ScreenHost& host_;
  OpenStudy& study_;
  std::int64_t session_ = 0;
  std::unique_ptr<BackgroundTask<SessionRecord>> task_;
  std::optional<SessionRecord> record_;  ///< The session that was read last.
  std::string problem_;
  std::optional<std::size_t> shown_fault_;  ///< The fault whose flight record was read.
  std::optional<FlightRecord> flight_;
  std::string flight_problem_;
  bool was_withdrawing_ = false;
  RecordViewState state_;
};

}  // namespace jnd::app::gui
