#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// A place for one writer and one reader thread, in which the newest value wins: a triple
/// buffer. Both sides are wait-free: neither ever waits for the other or sees half a value.
/// What the reader did not fetch in time is overwritten. Real time.
template <typename T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  LatestValue() = default;
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer: makes `value` the newest.
  void publish(const T& value) noexcept {
    slots_[written_].value = value;
    written_ = exchanged_.exchange(written_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: moves on to the newest value; false if it has it already.
  bool fetch() noexcept {
    if ((exchanged_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    read_ = exchanged_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value last fetched, `T{}` before the first; stays as it is until `fetch`.
  [[nodiscard]] const T& value() const noexcept { return slots_[read_].value; }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;

  // A cache line of its own for each side.
  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::atomic<std::uint32_t> exchanged_{0};
  alignas(64) std::uint32_t written_ = 1;
  alignas(64) std::uint32_t read_ = 2;
};

}  // namespace jnd::core
