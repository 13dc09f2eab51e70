#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace jnd::device {

/// A place in memory that two processes share, in which the newest value wins. There is one
/// writer and any number of readers, none of which can hold up the writer. If the writer ends
/// in the middle of a value, or something else writes here, a reader gets nothing or nonsense,
/// but never waits and never follows a pointer. So readers have to check the value. Real time.
template <typename T>
class SharedSlot {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void store(const T& value) noexcept {
    std::array<std::uint64_t, kNumWords> copy{};
    std::memcpy(copy.data(), &value, sizeof value);
    const std::uint32_t before = version_.load(std::memory_order_relaxed) & ~1U;
    version_.store(before + 1, std::memory_order_relaxed);
    // A reader that sees one of these words also sees that the version is odd.
    for (std::size_t i = 0; i < kNumWords; ++i) {
      words_[i].store(copy[i], std::memory_order_release);
    }
    version_.store(before + 2, std::memory_order_release);
  }

  /// Returns false if nothing was stored yet, or if each attempt met the writer.
  [[nodiscard]] bool load(T& value) const noexcept {
    constexpr int kMostTries = 4;
    std::array<std::uint64_t, kNumWords> copy;
    for (int i = 0; i < kMostTries; ++i) {
      const std::uint32_t before = version_.load(std::memory_order_acquire);
      if (before == 0 || (before & 1) != 0) continue;
      for (std::size_t word = 0; word < kNumWords; ++word) {
        copy[word] = words_[word].load(std::memory_order_acquire);
      }
      if (version_.load(std::memory_order_relaxed) != before) continue;
      std::memcpy(static_cast<void*>(&value), copy.data(), sizeof value);
      return true;
    }
    return false;
  }

  /// Changes with each store; a futex.
  [[nodiscard]] const std::atomic<std::uint32_t>& version() const noexcept { return version_; }

 private:
  static constexpr std::size_t kNumWords = (sizeof(T) + 7) / 8;

  alignas(64) std::atomic<std::uint32_t> version_{0};
  std::array<std::atomic<std::uint64_t>, kNumWords> words_{};
};

}  // namespace jnd::device
