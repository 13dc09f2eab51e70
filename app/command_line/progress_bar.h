#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace jnd::app {

/// Shows on stderr the progress and the time left of work that takes more than two seconds: on
/// a terminal as one line that is drawn again and disappears at the end, elsewhere as a line a
/// minute. Several threads may use it.
class ProgressBar {
 public:
  explicit ProgressBar(std::string title);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` is the part that is done, from 0 to 1.
  void show(double done);

 private:
  std::string title_;
  bool on_terminal_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_shown_;
};

}  // namespace jnd::app
