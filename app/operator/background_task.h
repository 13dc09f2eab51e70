#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace jnd::app {

/// Thrown from within work that was asked to stop.
struct WorkCancelled {};

/// Connects a piece of work with whoever waits for it. Any thread may use it.
class WorkControl {
 public:
  explicit WorkControl(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

  /// The work tells how much is done, 0 to 1. The ratio never goes back; each whole percent
  /// wakes the window.
  void progress(double ratio);
  [[nodiscard]] bool cancelled() const noexcept { return cancelled_.load(); }
  /// Throws `WorkCancelled` if the work was asked to stop.
  void stop_if_cancelled() const;
  /// Makes the window draw a frame.
  void wake() const;

  /// Asks the work to stop; called by whoever waits for it.
  void cancel() noexcept { cancelled_.store(true); }
  [[nodiscard]] double ratio() const noexcept { return ratio_.load(); }

 private:
  std::function<void()> wake_;
  std::atomic<double> ratio_{0.0};
  std::atomic<bool> cancelled_{false};
};

enum class WorkStatus {
  kRunning,
  kDone,
  kFailed,     ///< `error` says why.
  kCancelled,  ///< The work was asked to stop, and did.
};

/// Work on a thread of its own, which begins at once. What it throws becomes a sentence. That
/// thread calls `wake` after progress and when the work is over. Not real time.
class BackgroundWork {
 public:
  explicit BackgroundWork(std::function<void(WorkControl&)> work,
                          std::function<void()> wake = {});
  /// Asks the work to stop, and waits until it has.
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  [[nodiscard]] WorkStatus status() const noexcept { return status_.load(); }
  [[nodiscard]] bool running() const noexcept { return status() == WorkStatus::kRunning; }
  [[nodiscard]] double progress() const noexcept { return control_.ratio(); }
  /// One sentence if the work has failed; "" otherwise.
  [[nodiscard]] std::string error() const;
  void cancel() noexcept { control_.cancel(); }
  /// Waits until the work is over.
  void wait();

 private:
  void run(const std::function<void(WorkControl&)>& work) noexcept;

  WorkControl control_;
  std::string error_;  ///< Written before `status_` tells of it.
  std::atomic<WorkStatus> status_{WorkStatus::kRunning};
  std::thread thread_;
};

/// Work in the background that has a result, such as a backup or an export.
template <typename Result>
class BackgroundTask {
 public:
  explicit BackgroundTask(std::function<Result(WorkControl&)> work,
                          std::function<void()> wake = {})
      : work_([this, work = std::move(work)](
                  WorkControl& control) { result_.emplace(work(control)); },
              std::move(wake)) {}

  [[nodiscard]] WorkStatus status() const noexcept { return work_.status(); }
  [[nodiscard]] bool running() const noexcept { return work_.running(); }
  [[nodiscard]] double progress() const noexcept { return work_.progress(); }
  [[nodiscard]] std::string error() const { return work_.error(); }
  void cancel() noexcept { work_.cancel(); }
  void wait() { work_.wait(); }
  /// The result; nullptr unless the work is done.
  [[nodiscard]] const Result* result() const noexcept {
    return status() == WorkStatus::kDone && result_ ? &*result_ : nullptr;
  }

 private:
  /// Declared first, so that it outlives the thread that writes it.
  std::optional<Result> result_;
  BackgroundWork work_;
};

}  // namespace jnd::app
