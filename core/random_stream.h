#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace jnd::core {

/// A stream of random numbers keyed by what it is for: the same (seed, purpose, indices) gives
/// the same numbers on every machine and whatever was drawn elsewhere, so that a resumed
/// session equals an uninterrupted one. SplitMix64 (Steele, Lea and Flood 2014), started from a
/// hash of the key. Not for cryptography. Does not allocate; real time except `shuffle`'s
/// caller's vector.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose,
               std::initializer_list<std::int64_t> indices = {}) noexcept;

  [[nodiscard]] std::uint64_t next_bits() noexcept;
  /// Uniform in [0, 1), 53 bits.
  [[nodiscard]] double uniform() noexcept;
  [[nodiscard]] double uniform(double low, double high) noexcept;
  /// Standard normal (Box and Muller 1958).
  [[nodiscard]] double normal() noexcept;
  [[nodiscard]] double normal(double mean, double standard_deviation) noexcept;
  /// Uniform in 0 .. num_values - 1, without bias. `num_values` >= 1.
  [[nodiscard]] std::uint64_t below(std::uint64_t num_values) noexcept;
  [[nodiscard]] bool with_probability(double probability) noexcept;

  /// Fisher and Yates: every order equally likely.
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

/// A seed of its own for a part of the work, for example one session of a study.
[[nodiscard]] std::uint64_t derived_seed(
    std::uint64_t seed, std::string_view purpose,
    std::initializer_list<std::int64_t> indices = {}) noexcept;

}  // namespace jnd::core
