#pragma once

#include <cstddef>
#include <string>

namespace jnd::core {

/// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits. Not real time.
[[nodiscard]] std::string sha256(const void* bytes, std::size_t num_bytes);
[[nodiscard]] inline std::string sha256(const std::string& text) {
  return sha256(text.data(), text.size());
}

}  // namespace jnd::core
