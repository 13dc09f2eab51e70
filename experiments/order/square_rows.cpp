#include "experiments/order/square_rows.h"

namespace jnd::experiments {
namespace {

/// Returns the first row, and further rows in each of which every number is one more than in
/// the row before.
OrderRows turned(const std::vector<std::size_t>& first) {
  const std::size_t n = first.size();
  OrderRows rows;
  for (std::size_t shift = 0; shift < n; ++shift) {
    rows.emplace_back();
    for (const std::size_t item : first) rows.back().push_back((item + shift) % n);
  }
  return rows;
}

}  // namespace

OrderRows latin_rows(std::size_t n) {
  std::vector<std::size_t> first;
  for (std::size_t item = 0; item < n; ++item) first.push_back(item);
  return turned(first);
}

OrderRows williams_rows(std::size_t n) {
  // The first row is 0, 1, n-1, 2, n-2 and so on.
  std::vector<std::size_t> first = {0};
  for (std::size_t low = 1, high = n - 1; first.size() < n; ++low, --high) {
    first.push_back(low);
    if (first.size() < n) first.push_back(high);
  }
  OrderRows rows = turned(first);
  if (n % 2 == 0 || n == 1) return rows;
  for (std::size_t i = 0; i < n; ++i) rows.emplace_back(rows[i].rbegin(), rows[i].rend());
  return rows;
}

}  // namespace jnd::experiments
