#pragma once

#include <cstdint>

namespace jnd::device {

/// Whether the machine has slept: the monotonic clock, by which everything here is timed,
/// stands still meanwhile, and another one goes on. Real time.
class SleepWatch {
 public:
  /// The clock that goes on; nullptr: CLOCK_BOOTTIME.
  explicit SleepWatch(std::int64_t (*boottime_ns)() noexcept = nullptr) noexcept;

  /// Since the last call, or since it was made.
  [[nodiscard]] bool has_slept() noexcept;

 private:
  [[nodiscard]] std::int64_t slept_ns() const noexcept;

  std::int64_t (*boottime_ns_)() noexcept;
  std::int64_t known_ns_;
};

}  // namespace jnd::device
