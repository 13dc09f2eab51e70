#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace jnd::device {

using HmacKey = std::array<std::byte, 32>;
using HmacCode = std::array<std::byte, 32>;

/// Returns the HMAC-SHA-256 (RFC 2104 over FIPS 180-4) of `first` followed by `second`. Any
/// thread; real time.
[[nodiscard]] HmacCode hmac_sha256(const HmacKey& key, std::span<const std::byte> first,
                                   std::span<const std::byte> second = {}) noexcept;

/// Whether all bytes are equal. Its duration does not tell where they differ. Real time.
[[nodiscard]] bool is_same_code(std::span<const std::byte> a,
                                std::span<const std::byte> b) noexcept;

}  // namespace jnd::device
