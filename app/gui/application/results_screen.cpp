#include "app/gui/application/results_screen.h"

#include <string>

#include "app/language/words.h"
#include "app/operator/export_actions.h"
#include "app/operator/results_model.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

/// "NAME-results-1.png" beside the study, or whichever does not exist yet.
static fs::path free_picture_beside(const fs::path& study_folder) {
  for (int number = 1;; ++number) {
    fs::path file = study_folder.parent_path() / (study_folder.stem().string() + "-results-" +
                                                  std::to_string(number) + ".png");
    if (!fs::exists(file)) return file;
  }
}

void ResultsScreen::show() {
  study_.reload();
  task_ = std::make_unique<BackgroundTask<ResultsModel>>(
      [folder = study_.folder().folder](WorkControl& control) {
        return results_model(folder, control);
      },
      host_.wake());
}

void ResultsScreen::forget_study() {
  task_.reset();
  state_ = {};
}

void ResultsScreen::draw(Ui& ui) {
  const ResultsViewModel model{.study = study_.folder(),
                               .results = task_->result(),
                               .progress = task_->progress(),
                               .problem = task_->error(),
                               .is_blinded = study_.folder().hides_levels,
                               .work = study_.work()};
  const ResultsViewResult result = draw_results_view(ui, model, state_);
  const fs::path folder = study_.folder().folder;
  if (result.cancel) study_.cancel_work();
  if (result.export_tables) {
    study_.begin_work(tr("Exporting"), [folder](WorkControl& control) {
      return export_tables(folder, free_folder_beside(folder, "csv"), control);
    });
  } else if (result.write_report) {
    study_.begin_work(tr("Writing the report"), [folder](WorkControl& control) {
      return write_report(folder, free_folder_beside(folder, "report"), control);
    });
  } else if (result.save_picture) {
    host_.save_picture(free_picture_beside(folder));
  } else if (result.unblind) {
    const bool is_unblinded = host_.attempt(tr("The study cannot be unblinded"), [&] {
      study_.set_outcome(unblind_study(folder, state_.reason));
    });
    if (is_unblinded) host_.go_to(StudyTab::kResults);
  } else {
    host_.go_to(result.tab);
  }
}

}  // namespace jnd::app::gui
