#include "app/gui/application/open_study.h"

#include <utility>

#include "app/language/words.h"
#include "core/random_stream.h"
#include "core/storage/study_store.h"

namespace jnd::app::gui {

void OpenStudy::open(const std::filesystem::path& folder) {
  StudyFolder opened = open_study_folder(folder);
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  study_ = study_in(store);
  folder_ = std::move(opened);
  outcome_ = {};
}

void OpenStudy::close() {
  folder_.reset();
  study_.reset();
}

void OpenStudy::reload() {
  if (folder_) folder_ = open_study_folder(folder_->folder);
}

void OpenStudy::begin_work(const char* name, std::function<ActionOutcome(WorkControl&)> work) {
  if (works()) return;
  work_name_ = name;
  outcome_ = {};
  work_ = std::make_unique<BackgroundTask<ActionOutcome>>(std::move(work), wake_);
}

void OpenStudy::cancel_work() {
  if (work_) work_->cancel();
}

bool OpenStudy::collect_work() {
  if (!work_ || work_->running()) return false;
  if (work_->result() != nullptr) {
    outcome_ = *work_->result();
  } else {
    outcome_ = {.ok = false,
                .sentence = work_->status() == WorkStatus::kCancelled
                                ? tr("{}: cancelled", work_name_)
                                : work_->error()};
  }
  work_.reset();
  return true;
}

StudyWork OpenStudy::work() const {
  return {.running = work_ ? work_name_ : "",
          .progress = work_ ? work_->progress() : 0.0,
          .outcome = outcome_};
}

std::uint64_t seed_of(const core::StudyStore& store) {
  return core::derived_seed(0, "study/" + store.study_id());
}

}  // namespace jnd::app::gui
