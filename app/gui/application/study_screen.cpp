#include "app/gui/application/study_screen.h"

#include <chrono>
#include <exception>

#include "app/gui/views/file_dialog.h"
#include "app/language/words.h"
#include "app/operator/open_outside.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_outline.h"
#include "core/error.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

static double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void StudyScreen::watch(const fs::path& file) {
  watch_ = std::make_unique<StudyWatch>(fs::absolute(file).lexically_normal());
}

void StudyScreen::show() {
  if (watch_ == nullptr && study_.is_open()) {
    const fs::path file = study_.folder().study_file;
    if (file.empty() || !fs::exists(file)) {
      throw core::Error(
          tr("{}: expected its study file, found that it is not where it was; open "
             "the file itself",
             study_.folder().folder.string()));
    }
    // The file's text tells what a blind study hides.
    const bool may_see = !study_.folder().hides_levels;
    watch_ = std::make_unique<StudyWatch>(file, may_see, may_see);
  }
  reloaded_s_ = age_shown_s_ = now_s();
  orders_.clear();
  orders_problem_ = "";
  if (!study_.is_open()) {
    proposed_folder_ = default_study_folder(watch_->outline().file.stem().string()).string();
  }
  if (!watch_->study()) return;
  try {
    OrdersRequest request{.num_participants = state_.num_participants};
    if (study_.is_open()) {
      request.folder = study_.folder().folder;
      const core::StudyStore store(request.folder, core::StudyStore::Mode::kReadOnly);
      request.seed = seed_of(store);
    }
    orders_ = planned_orders(*watch_->study(), request);
    if (orders_.empty())
      orders_problem_ = tr("The study is double-blind: its orders are hidden.");
  } catch (const core::Error& error) {
    orders_problem_ = error.what();
  }
}

bool StudyScreen::look_beside() {
  const double now = now_s();
  if (watch_->look(now)) {
    show();
    return true;
  }
  // The screen says how long ago the file was read: for a minute in seconds, then in minutes.
  if (watch_->num_reloads() == 0 || now < age_shown_s_ + (now < reloaded_s_ + 60 ? 1 : 60)) {
    return false;
  }
  age_shown_s_ = now;
  return true;
}

void StudyScreen::draw(Ui& ui) {
  const StudyViewResult result =
      draw_study_view(ui,
                      {.study = study_.is_open() ? &study_.folder() : nullptr,
                       .outline = watch_->outline(),
                       .orders = orders_,
                       .orders_problem = orders_problem_,
                       .num_reloads = watch_->num_reloads(),
                       .since_reload_s = now_s() - reloaded_s_,
                       .proposed_folder = proposed_folder_},
                      state_);
  if (result.orders_changed) show();
  if (result.edit) {
    const std::string problem = open_outside(watch_->outline().file);
    if (!problem.empty()) host_.tell(tr("It cannot be opened"), problem);
  } else if (result.begin) {
    begin_study();
  } else {
    host_.go_to(result.tab);
  }
}

/// If the folder cannot be made, the dialog shows the reason beside the path that was typed.
void StudyScreen::begin_study() {
  try {
    const fs::path folder = typed_path(state_.new_folder);
    create_study_folder(watch_->outline().file, folder);
    host_.open(folder);
  } catch (const std::exception& error) {
    state_.asks_for_folder = state_.dialog_is_new = true;
    state_.folder_problem = error.what();
  }
}

}  // namespace jnd::app::gui
