#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/study_view.h"
#include "app/operator/study_outline.h"

namespace jnd::app::gui {

/// The study file: its stages, its stimuli, and the orders of the next participants. The screen
/// reads the file again whenever somebody saves it.
class StudyScreen final : public Screen {
 public:
  StudyScreen(ScreenHost& host, OpenStudy& study) : host_(host), study_(study) {}
  [[nodiscard]] const char* name() const noexcept override { return "study"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/how-to/check_a_study_while_you_write.md";
  }
  /// A file that is of no folder, to be shown next.
  void watch(const std::filesystem::path& file);
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool look_beside() override;
  void forget_study() override {
    watch_.reset();
    state_.problem.reset();
    state_.asks_for_folder = false;
  }

 private:
  void begin_study();

  ScreenHost& host_;
  OpenStudy& study_;
  std::unique_ptr<StudyWatch> watch_;
  std::vector<PlannedOrder> orders_;
  std::string orders_problem_;  ///< Why there are no orders; "" if there are.
  /// The folder proposed for a study of which only the file exists.
  std::string proposed_folder_;
  StudyViewState state_;
  double reloaded_s_ = 0.0, age_shown_s_ = 0.0;
};

}  // namespace jnd::app::gui
