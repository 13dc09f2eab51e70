#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/command_line/open_window.h"
#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/overview_view.h"
#include "app/language/words.h"
#include "app/operator/background_task.h"
#include "app/operator/export_actions.h"
#include "core/clock.h"
#include "core/storage/study_store.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

namespace {

/// Where a study stands: how many are done, who comes next, whether the sessions went well.
class OverviewScreen final : public Screen {
 public:
  explicit OverviewScreen(const ScreenParts& parts)
      : host_(parts.host), study_(parts.study), request_(parts.request) {}
  [[nodiscard]] const char* name() const noexcept override { return "overview"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/how-to/see_where_a_study_stands.md";
  }
  void show() override;
  void update(Ui& ui) override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return task_ && task_->running(); }
  void forget_study() override;

 private:
  /// Writes something down, and reads the study anew; why it does not work stands in the
  /// dialog, which stays open.
  void write(OverviewState::Dialog dialog, const std::function<void()>& work);

  ScreenHost& host_;
  OpenStudy& study_;
  const WindowRequest& request_;
  std::unique_ptr<BackgroundTask<StudyOverview>> task_;
  std::optional<StudyOverview> overview_;  ///< As it was read last.
  std::string problem_;
  bool was_working_ = false;
  OverviewState state_;
};

void OverviewScreen::show() {
  study_.reload();
  const StudyFolder& folder = study_.folder();
  state_.backup_folder = folder.backups.empty()
                             ? free_folder_beside(folder.folder, "backup").string()
                             : folder.backups.front().string();
  problem_.clear();
  const core::StudyStore store(folder.folder, core::StudyStore::Mode::kReadOnly);
  task_ = std::make_unique<BackgroundTask<StudyOverview>>(
      [path = folder.folder, seed = request_.seed ? *request_.seed : seed_of(store)](
          WorkControl& control) { return study_overview(path, seed, control); },
      host_.wake());
}

void OverviewScreen::forget_study() {
  task_.reset();
  overview_.reset();
  state_ = {};
}

void OverviewScreen::update(Ui&) {
  // Work has ended. It may have been a backup, whose age the overview shows.
  if (std::exchange(was_working_, study_.works()) && !study_.works()) {
    host_.attempt(tr("The study cannot be read"), [this] { show(); });
  }
  if (!task_ || task_->running()) return;
  if (task_->result() != nullptr) {
    overview_ = *task_->result();
  } else {
    overview_.reset();
    problem_ = task_->error();
  }
  task_.reset();
}

void OverviewScreen::draw(Ui& ui) {
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  const OverviewResult result =
      draw_overview(ui,
                    {.study = study_.folder(),
                     .overview = overview_ ? &*overview_ : nullptr,
                     .progress = task_ ? task_->progress() : 0.0,
                     .problem = problem_,
                     .work = study_.work(),
                     .proposed_date = date_text(core::SystemClock().now_ns() + kDay_ns)},
                    state_);
  const fs::path folder = study_.folder().folder;
  if (result.cancel) study_.cancel_work();
  if (result.prepare) {
    host_.attempt(tr("No session can be prepared"),
                  [&] { host_.prepare_session(*result.prepare); });
  } else if (result.session) {
    host_.attempt(tr("The session cannot be shown"),
                  [&] { host_.show_session(*result.session); });
  } else if (result.plan) {
    write(OverviewState::Dialog::kPlan, [&] { write_planned_number(folder, state_.number); });
  } else if (result.add_appointment) {
    write(OverviewState::Dialog::kAppointment,
          [&] { write_appointment(folder, state_.participant, state_.date, state_.hour); });
  } else if (result.cancel_appointment) {
    write(OverviewState::Dialog::kCancel,
          [&] { cancel_appointment_of(folder, *result.cancel_appointment); });
  } else if (result.back_up) {
    study_.begin_work(tr("Backing up"),
                      [folder, target = fs::path(state_.backup_folder)](WorkControl& control) {
                        return back_up_study(folder, target, control);
                      });
  } else {
    host_.go_to(result.tab);
  }
}

void OverviewScreen::write(OverviewState::Dialog dialog, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    state_.dialog = dialog;
    state_.dialog_is_new = true;
    state_.problem = error.what();
    return;
  }
  host_.attempt(tr("The study cannot be read"), [this] { show(); });
}

}  // namespace

std::unique_ptr<Screen> make_overview_screen(const ScreenParts& parts) {
  return std::make_unique<OverviewScreen>(parts);
}

}  // namespace jnd::app::gui
