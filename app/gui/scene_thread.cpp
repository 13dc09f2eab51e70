#include "app/gui/scene_thread.h"

#include <exception>
#include <utility>

#include "core/error.h"

namespace jnd::app::gui {

SceneThread::SceneThread(std::function<Paint()> load, std::function<void()> wake)
    : load_(std::move(load)), wake_(std::move(wake)), thread_([this] { run(); }) {}

SceneThread::~SceneThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  asked_.notify_one();
  thread_.join();
}

std::uintptr_t SceneThread::paint(const SceneRequest& request, double now_s) {
  const std::lock_guard lock(mutex_);
  if (!problem_.empty()) throw core::Error(problem_);
  wanted_ = Wanted{request, now_s};
  asked_.notify_one();
  return newest_;
}

void SceneThread::run() noexcept {
  std::string problem;
  try {
    draw_what_is_wanted(load_());
    return;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(problem);
  }
  if (wake_) wake_();
}

void SceneThread::draw_what_is_wanted(const Paint& paint) {
  while (true) {
    Wanted next;
    {
      std::unique_lock lock(mutex_);
      asked_.wait(lock, [this] { return ends_ || wanted_.has_value(); });
      if (ends_) return;
      next = *std::exchange(wanted_, std::nullopt);
    }
    const std::uintptr_t picture = paint(next.request, next.now_s);
    bool is_new = false;
    {
      const std::lock_guard lock(mutex_);
      is_new = std::exchange(newest_, picture) != picture;
    }
    if (is_new && wake_) wake_();
  }
}

}  // namespace jnd::app::gui
