#pragma once

#include <sys/types.h>

namespace jnd::app {

/// Keeps this machine from falling asleep, or from going to sleep when its lid is closed, while
/// it lives: by `systemd-inhibit` as a child, which holds the lock until its input ends, as it
/// also does when this program dies. Where the system has none nothing is held, and the loop's
/// own look at two clocks remains (`Fault::kSuspended`). Not real time.
class SleepInhibitor {
 public:
  /// Waits for the lock for a second at most.
  SleepInhibitor() noexcept;
  ~SleepInhibitor();
  SleepInhibitor(const SleepInhibitor&) = delete;
  SleepInhibitor& operator=(const SleepInhibitor&) = delete;

  [[nodiscard]] bool is_held() const noexcept { return is_held_; }

 private:
  pid_t child_ = -1;
  int input_ = -1;  ///< Of the child.
  bool is_held_ = false;
};

}  // namespace jnd::app
