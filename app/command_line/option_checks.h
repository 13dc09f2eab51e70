#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace jnd::app {

// What CLI11's own checks let through: NaN as within every range, numbers beyond 64 bits as the
// largest, 010 as eight.

/// Decimal digits alone, within these bounds.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest);

/// Of a random stream: 64 bits.
[[nodiscard]] inline CLI::Validator seed_number() {
  return whole_number(0, std::numeric_limits<std::uint64_t>::max());
}

/// A finite number within these bounds.
[[nodiscard]] CLI::Validator number_between(double lowest, double highest);

/// A number from 0 to below 1, also as a fraction of whole numbers such as 1/3, which it is
/// replaced by; or one of the words.
[[nodiscard]] CLI::Validator rate(const std::vector<std::string>& words = {});

}  // namespace jnd::app
