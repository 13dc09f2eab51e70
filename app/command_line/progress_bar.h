#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace jnd::app {

/// Progress with time left on a terminal's stderr; silent when piped. Safe from several
/// threads.
class ProgressBar {
 public:
  explicit ProgressBar(std::string title);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` of 1.
  void show(double done);

 private:
  std::string title_;
  bool on_terminal_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_shown_;
};

}  // namespace jnd::app
