#include "app/operator/open_data.h"

#include <utility>

#include "app/language/words.h"
#include "app/operator/column_guess.h"

namespace jnd::app {
namespace {

/// More contrasts than these are computed only if somebody asks, because each takes some
/// hundredths of a second.
constexpr std::size_t kMostUnasked = 30;

std::size_t num_contrasts(const CurveAnalysis& curves) {
  const std::size_t groups = curves.groups.size();
  return groups * (groups - 1) / 2 * curves.request.at.size();
}

}  // namespace

OpenData::OpenData(std::function<void()> wake) : wake_(std::move(wake)) {}

bool names_its_columns(const CurveRequest& request) noexcept {
  return !request.intensity.empty() && !request.yes.empty();
}

void OpenData::open(const std::filesystem::path& file) {
  forget_results();
  if (computing_) computing_->cancel();
  fits_are_due_ = false;
  view_ = {.file = file, .is_reading = true};
  reading_ = std::make_unique<BackgroundTask<DataPreview>>(
      [file](WorkControl& control) { return read_preview(file, control); }, wake_);
}

void OpenData::ask(const CurveRequest& request) {
  view_.request = request;
  forget_results();
  if (computing_) computing_->cancel();
  fits_are_due_ = names_its_columns(request);
  view_.command = fits_are_due_ ? command_of(request) : "";
  collect();
}

void OpenData::forget_results() {
  view_.results.reset();
  view_.comparison.reset();
  view_.can_compare = view_.is_comparing = false;
  view_.fit_problem.clear();
  view_.compare_problem.clear();
  view_.outcome = {};
  curves_.reset();
  if (comparing_) abandoned_.push_back(std::move(comparing_));
}

void OpenData::begin_fits() {
  fits_are_due_ = false;
  computing_request_ = view_.request;
  computing_ = std::make_unique<BackgroundTask<Computed>>(
      [request = view_.request](WorkControl& control) {
        CurveAnalysis curves = read_curves(request);
        if (!curves.suspected_chance) {
          fit_curves(curves, [&control](double done) {
            control.stop_if_cancelled();
            control.progress(done);
          });
        }
        const auto kept = std::make_shared<const CurveAnalysis>(std::move(curves));
        return Computed{kept, std::make_shared<const DataResults>(data_results(*kept))};
      },
      wake_);
}

void OpenData::compare() {
  if (!view_.can_compare || comparing_) return;
  view_.comparison.reset();
  view_.compare_problem.clear();
  comparing_ = std::make_unique<Comparing>(
      [curves = *curves_](WorkControl&) mutable {
        // The page shows intervals of the likelihood ratio; a bootstrap of every pair would
        // take minutes.
        curves.how.num_bootstrap = 0;
        add_comparison(curves);
        return data_comparison(*curves.comparison);
      },
      wake_);
  view_.is_comparing = true;
}

void OpenData::save(std::function<ActionOutcome(WorkControl&)> work) {
  if (!curves_ || curves_->fits.empty() || saving_) return;
  view_.outcome = {};
  saving_ = std::make_unique<BackgroundTask<ActionOutcome>>(std::move(work), wake_);
  view_.is_saving = true;
}

void OpenData::save_picture(const std::filesystem::path& file) {
  save([curves = curves_, file](WorkControl&) -> ActionOutcome {
    app::save_picture(*curves, file);
    return {.sentence = tr("The picture is in {}", file.string())};
  });
}

void OpenData::save_table(const std::filesystem::path& file) {
  save([curves = curves_, file](WorkControl&) -> ActionOutcome {
    app::save_table(*curves, file);
    return {.sentence = tr("The table is in {}", file.string())};
  });
}

void OpenData::collect_preview() {
  if (!reading_ || reading_->running()) return;
  const std::unique_ptr<BackgroundTask<DataPreview>> done = std::move(reading_);
  view_.is_reading = false;
  if (done->result() == nullptr) {
    view_.problem = done->error();
    return;
  }
  view_.preview = *done->result();
  ask(guessed_request(*view_.preview));
}

void OpenData::collect_fits() {
  if (computing_ && !computing_->running()) {
    const std::unique_ptr<BackgroundTask<Computed>> done = std::move(computing_);
    const bool is_wanted = !fits_are_due_ && computing_request_ == view_.request;
    if (is_wanted && done->status() == WorkStatus::kFailed) {
      view_.fit_problem = done->error();
    } else if (is_wanted && done->result() != nullptr) {
      curves_ = done->result()->curves;
      view_.results = done->result()->results;
      view_.can_compare = curves_->fits.size() > 1;
      if (view_.can_compare) {
        CurveRequest compared = view_.request;
        compared.compare = true;
        view_.command = command_of(compared);
        if (num_contrasts(*curves_) <= kMostUnasked) compare();
      }
    }
  }
  if (fits_are_due_ && !computing_) begin_fits();
  view_.is_computing = computing_ != nullptr;
  view_.progress = computing_ ? computing_->progress() : 0.0;
}

void OpenData::collect_comparison() {
  std::erase_if(abandoned_, [](const auto& task) { return !task->running(); });
  if (comparing_ && !comparing_->running()) {
    const std::unique_ptr<Comparing> done = std::move(comparing_);
    view_.is_comparing = false;
    if (done->result() != nullptr) {
      view_.comparison = std::make_shared<const DataComparison>(*done->result());
    } else {
      view_.compare_problem = done->error();
    }
  }
}

void OpenData::collect() {
  collect_preview();
  collect_fits();
  collect_comparison();
  if (saving_ && !saving_->running()) {
    const std::unique_ptr<BackgroundTask<ActionOutcome>> done = std::move(saving_);
    view_.is_saving = false;
    view_.outcome = done->result() != nullptr
                        ? *done->result()
                        : ActionOutcome{.ok = false, .sentence = done->error()};
  }
}

bool OpenData::works() const noexcept {
  return reading_ || computing_ || comparing_ || saving_ || fits_are_due_;
}

void OpenData::wait() {
  while (works()) {
    if (reading_) reading_->wait();
    if (computing_) computing_->wait();
    if (comparing_) comparing_->wait();
    if (saving_) saving_->wait();
    collect();
  }
}

std::filesystem::path free_file_beside(const std::filesystem::path& table,
                                       const std::string& ending) {
  const std::filesystem::path whole = std::filesystem::absolute(table).lexically_normal();
  const std::string name = whole.stem().string() + "-curves";
  std::filesystem::path file = whole.parent_path() / (name + ending);
  std::error_code ignored;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
       ++number) {
    file = whole.parent_path() / (name + "-" + std::to_string(number) + ending);
  }
  return file;
}

}  // namespace jnd::app
