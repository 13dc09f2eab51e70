#include "app/gui/application/study_screen.h"

#include <chrono>

#include "app/language/words.h"
#include "app/operator/study_outline.h"
#include "core/error.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

static double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void StudyScreen::watch(const fs::path& file) { watch_ = std::make_unique<StudyWatch>(file); }

void StudyScreen::show() {
  if (watch_ == nullptr && study_.is_open()) {
    const fs::path file = study_.folder().study_file;
    if (file.empty() || !fs::exists(file)) {
      throw core::Error(
          tr("{}: expected its study file, found that it is not where it was; open "
             "the file itself",
             study_.folder().folder.string()));
    }
    watch_ = std::make_unique<StudyWatch>(file, !study_.folder().hides_levels);
  }
  reloaded_s_ = age_shown_s_ = now_s();
  orders_.clear();
  orders_problem_ = "";
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
  // How long ago that was: in seconds, then in minutes.
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
                       .since_reload_s = now_s() - reloaded_s_},
                      state_);
  if (result.orders_changed) show();
  host_.go_to(result.tab);
}

}  // namespace jnd::app::gui
