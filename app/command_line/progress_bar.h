#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace jnd::app {

/// Progress with time left on stderr, of work that takes more than two seconds: on a terminal
/// one line that is drawn anew and goes at the end, elsewhere a line a minute. Safe from
/// several threads.
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
