#pragma once

#include <sys/types.h>

namespace jnd::app {

/// Keeps this machine awake while the object lives, also when the lid is closed. It runs
/// `systemd-inhibit` as a child, which holds the lock until its input ends, so also if this
/// program dies. If the system has no `systemd-inhibit`, nothing is held; the loop still
/// detects a suspension by comparing two clocks (`Fault::kSuspended`). Not real time.
class SleepInhibitor {
 public:
  /// Waits for the lock for at most a second.
  SleepInhibitor() noexcept;
  ~SleepInhibitor();
  SleepInhibitor(const SleepInhibitor&) = delete;
  SleepInhibitor& operator=(const SleepInhibitor&) = delete;

  [[nodiscard]] bool is_held() const noexcept { return is_held_; }

 private:
  pid_t child_ = -1;
  int input_ = -1;  ///< The child's input.
  bool is_held_ = false;
};

}  // namespace jnd::app
