#include "app/gui/application/start_screen.h"

#include "app/gui/application/device_screen.h"
#include "app/gui/application/start_contents.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/session/shipped_files.h"
#include "core/clock.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

void StartScreen::show() {
  state_.new_folder.clear();
  task_ = std::make_unique<BackgroundTask<StartModel>>(
      [recent = recent_, device = waiting_device(request_),
       profile = request_.device_profile.string()](WorkControl& control) {
        return look_around(recent, device, profile, control);
      },
      host_.wake());
}

void StartScreen::draw(Ui& ui) {
  if (const StartModel* model = task_ ? task_->result() : nullptr) model_ = *model;
  const StartViewResult result = draw_start_view(ui, model_, entries_of, state_);
  if (result.resume) {
    host_.attempt(tr("The session cannot be resumed"),
                  [&] { host_.resume_session(result.resume->folder, result.resume->session); });
  } else if (result.open) {
    host_.attempt(tr("The study cannot be opened"), [&] { host_.open(*result.open); });
  } else if (result.create) {
    host_.attempt(tr("The study cannot be made"), [&] {
      create_study_folder(user_or_shipped(result.create->study, "protocols"),
                          result.create->folder);
      host_.open(result.create->folder);
    });
  } else if (result.device) {
    host_.go_to(StudyTab::kDevice);
  } else if (result.data) {
    host_.go_to(StudyTab::kData);
  } else if (result.start_tour) {
    host_.attempt(tr("The tour cannot be started"), [this] { start_tour(); });
  }
}

void StartScreen::start_tour() {
  const fs::path folder = default_study_folder("short_tour");
  create_study_folder(user_or_shipped("short_tour", "protocols"), folder);
  host_.open(folder);
  host_.start_session({.participant = "P01",
                       .device = "mouse",
                       .seed = static_cast<std::uint64_t>(core::SystemClock().now_ns())});
}

}  // namespace jnd::app::gui
