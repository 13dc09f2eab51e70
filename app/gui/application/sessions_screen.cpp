#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/sessions_view.h"
#include "app/language/words.h"
#include "app/operator/export_actions.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

namespace {

/// The sessions of a study: what was run, what can be resumed, whether all of it is safe.
class SessionsScreen final : public Screen {
 public:
  explicit SessionsScreen(const ScreenParts& parts) : host_(parts.host), study_(parts.study) {}
  [[nodiscard]] const char* name() const noexcept override { return "sessions"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/how-to/run_a_session.md";
  }
  void show() override;
  void draw(Ui& ui) override;
  void forget_study() override { state_ = {}; }

 private:
  ScreenHost& host_;
  OpenStudy& study_;
  SessionsViewState state_;
};

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

}  // namespace

std::unique_ptr<Screen> make_sessions_screen(const ScreenParts& parts) {
  return std::make_unique<SessionsScreen>(parts);
}

}  // namespace jnd::app::gui
