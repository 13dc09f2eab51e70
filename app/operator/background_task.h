#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace jnd::app {

/// Thrown out of the middle of work that was asked to stop.
struct WorkCancelled {};

/// What a piece of work and whoever waits for it say to each other. Any thread.
class WorkControl {
 public:
  explicit WorkControl(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

  /// Of the work: how much is done, 0 to 1. Never goes back; wakes at every whole percent.
  void progress(double ratio);
  [[nodiscard]] bool cancelled() const noexcept { return cancelled_.load(); }
  /// Throws `WorkCancelled` if it was asked to stop.
  void stop_if_cancelled() const;
  /// Has the window draw itself anew.
  void wake() const;

  /// Called by whoever waits for the work.
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
  kCancelled,  ///< It was asked to stop, and did.
};

/// Work on a thread of its own, begun at once; whatever it throws becomes a sentence. `wake` is
/// called from that thread after progress and once it is over. Not real time.
class BackgroundWork {
 public:
  explicit BackgroundWork(std::function<void(WorkControl&)> work,
                          std::function<void()> wake = {});
  /// Asks to stop and waits until it has.
  ~BackgroundWork();
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  [[nodiscard]] WorkStatus status() const noexcept { return status_.load(); }
  [[nodiscard]] bool running() const noexcept { return status() == WorkStatus::kRunning; }
  [[nodiscard]] double progress() const noexcept { return control_.ratio(); }
  /// One sentence once it has failed; "" otherwise.
  [[nodiscard]] std::string error() const;
  void cancel() noexcept { control_.cancel(); }
  /// Returns when it is over.
  void wait();

 private:
  void run(const std::function<void(WorkControl&)>& work) noexcept;

  WorkControl control_;
  std::string error_;  ///< Written before `status_` says so.
  std::atomic<WorkStatus> status_{WorkStatus::kRunning};
  std::thread thread_;
};

/// Work beside the window that comes to something: results, a backup, an export.
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
  /// What it came to; nullptr unless it is done.
  [[nodiscard]] const Result* result() const noexcept {
    return status() == WorkStatus::kDone && result_ ? &*result_ : nullptr;
  }

 private:
  std::optional<Result> result_;  ///< Outlives the thread that writes it.
  BackgroundWork work_;
};

}  // namespace jnd::app
