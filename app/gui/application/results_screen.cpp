#include <memory>
#include <string>
#include <utility>

#include "app/gui/application/open_study.h"
#include "app/gui/application/screen.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/results_view.h"
#include "app/language/words.h"
#include "app/operator/background_task.h"
#include "app/operator/export_actions.h"
#include "app/operator/open_outside.h"
#include "app/operator/results_model.h"

namespace jnd::app::gui {

namespace fs = std::filesystem;

namespace {

/// The results of a study, computed beside the window whenever it is shown.
class ResultsScreen final : public Screen {
 public:
  explicit ResultsScreen(const ScreenParts& parts) : host_(parts.host), study_(parts.study) {}
  [[nodiscard]] const char* name() const noexcept override { return "results"; }
  [[nodiscard]] const char* manual_page() const noexcept override {
    return "docs/how-to/read_the_results.md";
  }
  void show() override;
  void draw(Ui& ui) override;
  [[nodiscard]] bool works() const noexcept override { return task_ && task_->running(); }
  void forget_study() override;

 private:
  ScreenHost& host_;
  OpenStudy& study_;
  std::unique_ptr<BackgroundTask<ResultsModel>> task_;
  ResultsViewState state_;
};

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
  if (result.export_as) {
    study_.begin_work(tr("Exporting"), [folder,
                                        choice = *result.export_as](WorkControl& control) {
      return export_study(folder, free_folder_beside(folder, choice.format), choice, control);
    });
  } else if (result.write_report) {
    study_.begin_work(tr("Writing the report"), [folder](WorkControl& control) {
      return write_report(folder, free_folder_beside(folder, "report"), control);
    });
  } else if (result.save_picture) {
    StudyFiguresRequest request{.folder = folder,
                                .out = free_folder_beside(folder, "figures"),
                                .what = *result.save_picture,
                                .charts = model.results->charts,
                                .who = shown_participant(*model.results, state_),
                                .simulated = model.results->simulated};
    study_.begin_work(tr("Drawing the figures"),
                      [request = std::move(request)](WorkControl& control) {
                        return save_figures(request, control);
                      });
  } else if (result.open) {
    const std::string problem = open_outside(study_.work().outcome.opens);
    if (!problem.empty()) host_.tell(tr("It cannot be opened"), problem);
  } else if (result.unblind) {
    const bool is_unblinded = host_.attempt(tr("The study cannot be unblinded"), [&] {
      study_.set_outcome(unblind_study(folder, state_.reason));
    });
    if (is_unblinded) host_.go_to(StudyTab::kResults);
  } else {
    host_.go_to(result.tab);
  }
}

}  // namespace

std::unique_ptr<Screen> make_results_screen(const ScreenParts& parts) {
  return std::make_unique<ResultsScreen>(parts);
}

}  // namespace jnd::app::gui
