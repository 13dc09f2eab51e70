#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace jnd::app {

// Checks for what CLI11's own checks accept: NaN lies in every range, numbers beyond 64 bits
// become the largest one, and 010 is eight.

/// Accepts decimal digits only, within these bounds.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest);

/// Accepts the seed of a random stream, which has 64 bits.
[[nodiscard]] inline CLI::Validator seed_number() {
  return whole_number(0, std::numeric_limits<std::uint64_t>::max());
}

/// Accepts a finite number within these bounds.
[[nodiscard]] CLI::Validator number_between(double lowest, double highest);

/// Accepts a number from 0 to below 1, or one of the words. A fraction of whole numbers, such
/// as 1/3, is accepted as well and replaced by its value.
[[nodiscard]] CLI::Validator rate(const std::vector<std::string>& words = {});

}  // namespace jnd::app
