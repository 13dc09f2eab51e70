#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace jnd::core {

/// A stream of random numbers with a key that says what it is for. The same (seed, purpose,
/// indices) gives the same numbers on every machine, whatever else is drawn. So a resumed
/// session equals an uninterrupted one. The generator is SplitMix64 (Steele, Lea and Flood
/// 2014), started from a hash of the key. It is not for cryptography. Real time, no heap.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose,
               std::initializer_list<std::int64_t> indices = {}) noexcept;

  [[nodiscard]] std::uint64_t next_bits() noexcept;
  /// Returns a uniform number in [0, 1) with 53 random bits.
  [[nodiscard]] double uniform() noexcept;
  [[nodiscard]] double uniform(double low, double high) noexcept;
  /// Returns a standard normal number (Box and Muller 1958).
  [[nodiscard]] double normal() noexcept;
  [[nodiscard]] double normal(double mean, double standard_deviation) noexcept;
  /// Returns an unbiased uniform integer in 0 .. num_values - 1. `num_values` >= 1.
  [[nodiscard]] std::uint64_t below(std::uint64_t num_values) noexcept;
  [[nodiscard]] bool with_probability(double probability) noexcept;

  /// Shuffles by Fisher and Yates, so that every order is equally likely.
  template <typename T>
  void shuffle(std::vector<T>& items) noexcept {
    for (std::uint64_t remaining = items.size(); remaining > 1; --remaining) {
      using std::swap;
      swap(items[remaining - 1], items[below(remaining)]);
    }
  }

 private:
  std::uint64_t state_;
};

/// Derives a separate seed for a part of the work, for example for one session of a study.
[[nodiscard]] std::uint64_t derived_seed(
    std::uint64_t seed, std::string_view purpose,
    std::initializer_list<std::int64_t> indices = {}) noexcept;

}  // namespace jnd::core
