#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// Passes the newest value from one writer thread to one reader thread, by a triple buffer.
/// Both sides are wait-free: neither waits for the other or sees half a value. A value that the
/// reader did not fetch in time is overwritten. Real time.
template <typename T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  LatestValue() = default;
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Makes `value` the newest one. Writer.
  void publish(const T& value) noexcept {
    slots_[written_].value = value;
    written_ = exchanged_.exchange(written_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Moves on to the newest value. Returns false if the reader has it already. Reader.
  bool fetch() noexcept {
    if ((exchanged_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    read_ = exchanged_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Returns the value that was fetched last, or `T{}` before the first fetch. It does not
  /// change until the next `fetch`. Reader.
  [[nodiscard]] const T& value() const noexcept { return slots_[read_].value; }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;

  // Each side has cache lines of its own.
  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::atomic<std::uint32_t> exchanged_{0};
  alignas(64) std::uint32_t written_ = 1;
  alignas(64) std::uint32_t read_ = 2;
};

}  // namespace jnd::core
