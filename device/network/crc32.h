#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace jnd::device {

namespace crc32_detail {

constexpr std::array<std::uint32_t, 256> make_table() noexcept {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xedb88320u : 0u);
    }
    table[byte] = remainder;
  }
  return table;
}

inline constexpr std::array<std::uint32_t, 256> kTable = make_table();

}  // namespace crc32_detail

/// Returns the checksum of Ethernet, gzip and PNG (ISO 3309): polynomial 0x04c11db7 reflected,
/// with all bits inverted at the beginning and the end. It detects every burst of errors up to
/// 32 bits. Real time.
[[nodiscard]] constexpr std::uint32_t crc32(std::span<const std::byte> bytes) noexcept {
  std::uint32_t remainder = 0xffffffffu;
  for (const std::byte byte : bytes) {
    remainder = (remainder >> 8) ^
                crc32_detail::kTable[(remainder ^ std::to_integer<std::uint32_t>(byte)) & 0xff];
  }
  return ~remainder;
}

}  // namespace jnd::device
