#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// The last ticks before a fault. The haptic thread records until it freezes the recorder, in
/// the tick of the fault; from then on any thread may read it, until the loop is armed again.
class FlightRecorder {
 public:
  /// Room for `num_samples` >= 1. Not real time.
  explicit FlightRecorder(std::size_t num_samples) : ring_(num_samples > 0 ? num_samples : 1) {}

  /// Haptic thread; does nothing while frozen. Real time.
  void record(const Sample& sample) noexcept {
    if (frozen_.load(std::memory_order_relaxed)) return;
    ring_[next_] = sample;
    if (++next_ == ring_.size()) {
      next_ = 0;
      full_ = true;
    }
  }

  /// Haptic thread. Real time.
  void freeze() noexcept { frozen_.store(true, std::memory_order_release); }
  /// Haptic thread. Starts afresh. Real time.
  void thaw() noexcept {
    next_ = 0;
    full_ = false;
    frozen_.store(false, std::memory_order_release);
  }

  [[nodiscard]] bool is_frozen() const noexcept {
    return frozen_.load(std::memory_order_acquire);
  }

  /// Oldest first. Only while frozen, or without a haptic thread; fetch it before arming the
  /// loop again. Not real time.
  [[nodiscard]] std::vector<Sample> contents() const {
    std::vector<Sample> samples;
    if (full_) samples.assign(ring_.begin() + static_cast<std::ptrdiff_t>(next_), ring_.end());
    samples.insert(samples.end(), ring_.begin(),
                   ring_.begin() + static_cast<std::ptrdiff_t>(next_));
    return samples;
  }

 private:
  std::vector<Sample> ring_;
  std::size_t next_ = 0;
  bool full_ = false;
  std::atomic<bool> frozen_{false};
};

}  // namespace jnd::core
