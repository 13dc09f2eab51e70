#pragma once

#include <cstddef>
#include <vector>

namespace jnd::experiments {

/// Orders of the items 0 .. n-1, one a row.
using OrderRows = std::vector<std::vector<std::size_t>>;

/// A cyclic Latin square, n >= 1: row i runs i, i+1 ... and begins again after n-1. Every item
/// stands once in every place; but the same items always follow each other. Not real time.
[[nodiscard]] OrderRows latin_rows(std::size_t n);

/// Rows of a Williams square (1949), n >= 1: n of them for an even n, 2n for an odd one but 1.
/// Every item stands equally often in every place and follows every other item equally often.
/// Not real time.
[[nodiscard]] OrderRows williams_rows(std::size_t n);

}  // namespace jnd::experiments
