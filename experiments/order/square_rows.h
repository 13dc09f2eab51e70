#pragma once

#include <cstddef>
#include <vector>

namespace jnd::experiments {

/// Orders of the items 0 .. n-1, one in each row.
using OrderRows = std::vector<std::vector<std::size_t>>;

/// Returns a cyclic Latin square, n >= 1: row i is i, i+1 and so on, and continues with 0 after
/// n-1. Every item comes once in every place, but the same items always follow each other. Not
/// real time.
[[nodiscard]] OrderRows latin_rows(std::size_t n);

/// Returns the rows of a Williams square (1949), n >= 1: n rows for an even n, 2n for an odd
/// one except 1. Every item comes equally often in every place and follows every other item
/// equally often. Not real time.
[[nodiscard]] OrderRows williams_rows(std::size_t n);

}  // namespace jnd::experiments
