#include "app/operator/background_task.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

#include "app/language/words.h"

namespace jnd::app {

void WorkControl::progress(double ratio) {
  const double before = ratio_.load();
  // NaN changes nothing.
  const double after = std::min(1.0, std::max(before, ratio));
  ratio_.store(after);
  if (std::floor(100.0 * after) > std::floor(100.0 * before)) wake();
}

void WorkControl::stop_if_cancelled() const {
  if (cancelled()) throw WorkCancelled{};
}

void WorkControl::wake() const {
  if (wake_) wake_();
}

BackgroundWork::BackgroundWork(std::function<void(WorkControl&)> work,
                               std::function<void()> wake)
    : control_(std::move(wake)), thread_([this, work = std::move(work)] { run(work); }) {}

BackgroundWork::~BackgroundWork() {
  cancel();
  wait();
}

std::string BackgroundWork::error() const {
  return status() == WorkStatus::kFailed ? error_ : std::string();
}

void BackgroundWork::wait() {
  if (thread_.joinable()) thread_.join();
}

void BackgroundWork::run(const std::function<void(WorkControl&)>& work) noexcept {
  WorkStatus status = WorkStatus::kDone;
  try {
    work(control_);
  } catch (const WorkCancelled&) {
    status = WorkStatus::kCancelled;
  } catch (const std::bad_alloc&) {
    status = WorkStatus::kFailed;
    error_ = tr("memory: expected enough for this, found none left; close other programs");
  } catch (const std::exception& error) {
    status = WorkStatus::kFailed;
    error_ = error.what();
  } catch (...) {
    status = WorkStatus::kFailed;
    error_ = tr("expected this work to end, found an error without words; please report it");
  }
  status_.store(status);
  control_.wake();
}

}  // namespace jnd::app
