#pragma once

#include <cstdint>

namespace jnd::core {

inline constexpr std::int64_t kNsPerS = 1'000'000'000;

/// A session takes the times of its events from a clock that is passed in. So a simulated
/// session runs in simulated time, and a test moves its own clock.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Returns nanoseconds since 1970-01-01 UTC. A simulated session counts from 0.
  [[nodiscard]] virtual std::int64_t now_ns() const = 0;
};

/// The machine's wall clock.
class SystemClock final : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() const override;
};

/// A clock that stands still until it is moved.
class SimulatedClock final : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() const override { return now_ns_; }
  void advance_ns(std::int64_t by_ns) noexcept { now_ns_ += by_ns; }

 private:
  std::int64_t now_ns_ = 0;
};

}  // namespace jnd::core
