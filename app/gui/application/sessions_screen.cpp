#include "app/gui/application/sessions_screen.h"

#include "app/language/words.h"
#include "app/operator/export_actions.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

void SessionsScreen::show() {
  study_.reload();
  const StudyFolder& folder = study_.folder();
  state_.backup_folder = folder.backups.empty()
                             ? free_folder_beside(folder.folder, "backup").string()
                             : folder.backups.front().string();
}

void SessionsScreen::draw(Ui& ui) {
  const SessionsViewResult result =
      draw_sessions_view(ui, study_.folder(), study_.work(), state_);
  const fs::path folder = study_.folder().folder;
  if (result.cancel) study_.cancel_work();
  if (result.new_session) {
    host_.attempt(tr("No session can be prepared"), [this] { host_.prepare_session(""); });
  } else if (result.show) {
    host_.attempt(tr("The session cannot be shown"), [&] { host_.show_session(*result.show); });
  } else if (result.resume) {
    host_.attempt(tr("The session cannot be resumed"),
                  [&] { host_.resume_session(folder, *result.resume); });
  } else if (result.verify) {
    study_.begin_work(tr("Verifying"),
                      [folder](WorkControl& control) { return verify_study(folder, control); });
  } else if (result.back_up) {
    study_.begin_work(tr("Backing up"),
                      [folder, target = fs::path(state_.backup_folder)](WorkControl& control) {
                        return back_up_study(folder, target, control);
                      });
  } else {
    host_.go_to(result.tab);
  }
}

}  // namespace jnd::app::gui
