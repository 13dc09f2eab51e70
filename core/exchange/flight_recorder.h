#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// Keeps the last ticks before a fault. The haptic thread records until it freezes the recorder
/// in the tick of the fault. From then on any thread may read it, until the loop is armed
/// again.
class FlightRecorder {
 public:
  /// Makes room for `num_samples` >= 1 samples. Not real time.
  explicit FlightRecorder(std::size_t num_samples) : ring_(num_samples > 0 ? num_samples : 1) {}

  /// Records a sample, or does nothing while frozen. Haptic thread. Real time.
  void record(const Sample& sample) noexcept {
    if (frozen_.load(std::memory_order_relaxed)) return;
    ring_[next_] = sample;
    if (++next_ == ring_.size()) {
      next_ = 0;
      full_ = true;
    }
  }

  /// Stops the recording. Haptic thread. Real time.
  void freeze() noexcept { frozen_.store(true, std::memory_order_release); }
  /// Empties the recorder and records again. Haptic thread. Real time.
  void thaw() noexcept {
    next_ = 0;
    full_ = false;
    frozen_.store(false, std::memory_order_release);
  }

  [[nodiscard]] bool is_frozen() const noexcept {
    return frozen_.load(std::memory_order_acquire);
  }

  /// Returns the samples, the oldest first. Call it only while the recorder is frozen or no
  /// haptic thread runs, and before the loop is armed again. Not real time.
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
