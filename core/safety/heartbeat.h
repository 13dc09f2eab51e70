#pragma once

#include <atomic>
#include <cstdint>

namespace jnd::core {

/// The sign of life of the thread that a person interacts with. Real time, any thread.
class Heartbeat {
 public:
  void beat() noexcept { count_.fetch_add(1, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t count() const noexcept {
    return count_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t> count_{0};
};

/// The listening side, owned by the haptic loop. It reads no clock: the loop tells how many
/// ticks have passed, those that it missed among them, so that a number of ticks is a time.
/// Real time.
class HeartbeatMonitor {
 public:
  /// From when on silence counts.
  enum class Since {
    kFirstCall,
    /// Whoever beats may begin long after the loop, and asks for no force before that.
    kFirstBeat,
  };

  /// `heartbeat` may be nullptr, for a simulation, in which silence means nothing.
  HeartbeatMonitor(const Heartbeat* heartbeat, std::int64_t timeout_ticks,
                   Since since = Since::kFirstCall) noexcept
      : heartbeat_(heartbeat), timeout_ticks_(timeout_ticks), since_(since) {}

  /// Called once a tick, `num_passed` >= 1 ticks after the last call; true once `timeout_ticks`
  /// have passed without a beat.
  [[nodiscard]] bool is_silent(std::int64_t num_passed = 1) noexcept {
    if (heartbeat_ == nullptr) return false;
    const std::uint64_t count = heartbeat_->count();
    if (count != last_count_) {
      last_count_ = count;
      silent_ticks_ = 0;
      return false;
    }
    if (count == 0 && since_ == Since::kFirstBeat) return false;
    // Saturates, so that a night of silence does not overflow.
    if (silent_ticks_ < timeout_ticks_) silent_ticks_ += num_passed;
    return silent_ticks_ >= timeout_ticks_;
  }

 private:
  const Heartbeat* heartbeat_;
  std::int64_t timeout_ticks_;
  Since since_;
  std::int64_t silent_ticks_ = 0;
  std::uint64_t last_count_ = 0;
};

}  // namespace jnd::core
