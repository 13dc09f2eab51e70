#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace jnd::core {

/// A bounded queue from one writer thread to one reader thread, in order. It never waits: if it
/// is full, it drops the new value and counts it. A simulation loses nothing, because it drains
/// the queue whenever `num_free` is 0. Real time except the constructor.
template <typename T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Makes room for at least `capacity` >= 1 values, rounded up to a power of two. Not real
  /// time.
  explicit SpscQueue(std::size_t capacity)
      : ring_(std::bit_ceil(capacity > 0 ? capacity : 1)), mask_(ring_.size() - 1) {}
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  /// Returns false and increases `num_dropped` if the queue is full. Writer.
  bool try_push(const T& value) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - seen_head_ == ring_.size()) {
      seen_head_ = head_.load(std::memory_order_acquire);
      if (tail - seen_head_ == ring_.size()) {
        num_dropped_.store(num_dropped_.load(std::memory_order_relaxed) + 1,
                           std::memory_order_relaxed);
        return false;
      }
    }
    ring_[tail & mask_] = value;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Returns false if the queue is empty. Reader.
  bool try_pop(T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = ring_[head & mask_];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Calls `visit(const T&)` in place for every value that is in the queue now, the oldest
  /// first, and returns how many there were. If `visit` throws, no value counts as read.
  /// Reader.
  template <typename Visit>
  std::size_t drain(Visit&& visit) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t tail = tail_.load(std::memory_order_acquire);
    for (std::size_t next = head; next != tail; ++next) visit(ring_[next & mask_]);
    head_.store(tail, std::memory_order_release);
    return tail - head;
  }

  /// Either side may call it. The other side may have changed the number since.
  [[nodiscard]] std::size_t size() const noexcept {
    const std::size_t head = head_.load(std::memory_order_acquire);
    return tail_.load(std::memory_order_acquire) - head;
  }
  [[nodiscard]] std::size_t num_free() const noexcept { return ring_.size() - size(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return ring_.size(); }
  [[nodiscard]] std::uint64_t num_dropped() const noexcept {
    return num_dropped_.load(std::memory_order_relaxed);
  }

 private:
  std::vector<T> ring_;
  std::size_t mask_;
  // Both counters only increase, and each has a cache line of its own. The writer remembers the
  // head that it saw last.
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t seen_head_ = 0;
  std::atomic<std::uint64_t> num_dropped_{0};
};

}  // namespace jnd::core
