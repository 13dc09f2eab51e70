#pragma once

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "device/network/datagram.h"

namespace jnd::device::wire {

/// Writes numbers one after another, in little-endian order, as long as there is room. Real
/// time.
class ByteWriter {
 public:
  static constexpr bool kReads = false;

  explicit ByteWriter(std::span<std::byte> bytes) noexcept : bytes_(bytes) {}

  template <std::unsigned_integral T>
  void number(const T& value) noexcept {
    for (std::size_t i = 0; i < sizeof(T) && at_ < bytes_.size(); ++i) {
      bytes_[at_++] = static_cast<std::byte>(value >> (8 * i) & 0xff);
    }
  }
  void number(const std::int64_t& value) noexcept { number(static_cast<std::uint64_t>(value)); }
  void number(const double& value) noexcept { number(std::bit_cast<std::uint64_t>(value)); }
  void refuse(Problem) noexcept {}

  [[nodiscard]] std::size_t size() const noexcept { return at_; }

 private:
  std::span<std::byte> bytes_;
  std::size_t at_ = 0;
};

/// Reads the numbers and remembers the first problem. Behind the end it returns zeros. Real
/// time.
class ByteReader {
 public:
  static constexpr bool kReads = true;

  explicit ByteReader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  template <std::unsigned_integral T>
  void number(T& value) noexcept {
    value = 0;
    begin_ = at_;
    if (bytes_.size() - at_ < sizeof(T)) return refuse(Problem::kWrongSize);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value =
          static_cast<T>(value | static_cast<T>(std::to_integer<T>(bytes_[at_++]) << (8 * i)));
    }
  }
  void number(std::int64_t& value) noexcept {
    std::uint64_t bits = 0;
    number(bits);
    value = std::bit_cast<std::int64_t>(bits);
  }
  void number(double& value) noexcept {
    std::uint64_t bits = 0;
    number(bits);
    value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) refuse(Problem::kNotFinite);
  }
  void refuse(Problem problem) noexcept {
    if (problem_ != Problem::kNone) return;
    problem_ = problem;
    problem_at_ = begin_;
  }
  /// Where the value begins that was the first problem.
  [[nodiscard]] std::size_t problem_at() const noexcept { return problem_at_; }

  /// Returns `kWrongSize` as well if bytes are left.
  [[nodiscard]] Problem problem() const noexcept {
    if (problem_ != Problem::kNone) return problem_;
    return at_ == bytes_.size() ? Problem::kNone : Problem::kWrongSize;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;  ///< Of the value that was read last.
  Problem problem_ = Problem::kNone;
  std::size_t problem_at_ = 0;
};

}  // namespace jnd::device::wire
