#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace jnd::core {

/// A bounded queue from one writer thread to one reader thread, in order. A full queue drops
/// the new value and counts it; it never waits. A simulation loses nothing because it drains
/// whenever `num_free` is 0. Real time except the constructor.
template <typename T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Room for at least `capacity` >= 1 values; rounded up to a power of two. Not real time.
  explicit SpscQueue(std::size_t capacity)
      : ring_(std::bit_ceil(capacity > 0 ? capacity : 1)), mask_(ring_.size() - 1) {}
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  /// Writer: false, and one more `num_dropped`, if the queue is full.
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

  /// Reader: false if the queue is empty.
  bool try_pop(T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = ring_[head & mask_];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Reader: calls `visit(const T&)` for all that is there now, oldest first, in place; returns
  /// how many. If `visit` throws, nothing counts as read.
  template <typename Visit>
  std::size_t drain(Visit&& visit) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t tail = tail_.load(std::memory_order_acquire);
    for (std::size_t next = head; next != tail; ++next) visit(ring_[next & mask_]);
    head_.store(tail, std::memory_order_release);
    return tail - head;
  }

  /// Either side; the other may have changed it since.
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
  // Counted up for ever, each on a cache line of its own; the writer keeps the head it saw
  // last.
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t seen_head_ = 0;
  std::atomic<std::uint64_t> num_dropped_{0};
};

}  // namespace jnd::core
