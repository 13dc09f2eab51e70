#include "app/gui/application/start_screen.h"

#include <exception>
#include <string>
#include <system_error>

#include "app/gui/application/device_screen.h"
#include "app/gui/application/start_contents.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/session/shipped_files.h"
#include "core/clock.h"
#include "core/error.h"
#include "experiments/study/study_problem.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

void StartScreen::show() {
  state_.new_folder.clear();
  state_.study.reset();
  task_ = std::make_unique<BackgroundTask<StartModel>>(
      [recent = recent_, device = waiting_device(request_),
       profile = request_.device_profile.string()](WorkControl& control) {
        return look_around(recent, device, profile, control);
      },
      host_.wake());
}

void StartScreen::draw(Ui& ui) {
  if (const StartModel* model = task_ ? task_->result() : nullptr) model_ = *model;
  const bool asks_which = state_.dialog == StartViewState::Dialog::kOpen;
  const StartViewResult result = draw_start_view(ui, model_, entries_of, state_);
  if (result.resume) {
    host_.attempt(tr("The session cannot be resumed"),
                  [&] { host_.resume_session(result.resume->folder, result.resume->session); });
  } else if (result.open) {
    open(*result.open, asks_which);
  } else if (result.create) {
    create(*result.create);
  } else if (result.device) {
    host_.go_to(StudyTab::kDevice);
  } else if (result.data) {
    host_.go_to(StudyTab::kData);
  } else if (result.start_tour) {
    host_.attempt(tr("The tour cannot be started"), [this] { start_tour(); });
  }
}

/// If it fails, the dialog that asked for the path opens again, with what was typed and what is
/// wrong.
void StartScreen::open(const fs::path& path, bool from_dialog) {
  try {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
      throw core::Error(tr("{}: expected a study folder or a study file, found nothing there",
                           path.string()));
    }
    host_.open(path);
  } catch (const std::exception& error) {
    if (!from_dialog) return host_.tell(tr("The study cannot be opened"), error.what());
    state_.dialog = StartViewState::Dialog::kOpen;
    go_on_with_file_dialog(state_.opening, error.what());
  }
}

/// A draft with problems is opened as well, so that the person sees them at their lines.
void StartScreen::create(const StartViewResult::New& wanted) {
  const auto ask_again = [&](const std::string& problem) {
    state_.dialog = StartViewState::Dialog::kNew;
    state_.dialog_is_new = true;
    state_.problem = problem;
  };
  try {
    const fs::path file = user_or_shipped(wanted.study, "protocols");
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
      return ask_again(tr("{}: expected a study file, found none there", file.string()));
    }
    try {
      create_study_folder(file, wanted.folder);
    } catch (const experiments::ProtocolError&) {
      return host_.open(file);
    }
    host_.open(wanted.folder);
  } catch (const std::exception& error) {
    ask_again(error.what());
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
