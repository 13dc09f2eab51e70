#pragma once

#include <functional>
#include <utility>

namespace jnd::core {

/// Told how much of some work is done, 0 to 1; what it throws ends the work. May be empty.
using Progress = std::function<void(double)>;

inline void tell(const Progress& progress, double done) {
  if (progress) progress(done);
}

/// Of the first `num_done` of so many parts alike.
template <typename Number>
void tell(const Progress& progress, Number num_done, Number num_parts) {
  if (num_parts > Number{}) {
    tell(progress, static_cast<double>(num_done) / static_cast<double>(num_parts));
  }
}

/// A part of the work as a whole of its own: from `from` to `to` of all of it.
[[nodiscard]] inline Progress part_of(Progress whole, double from, double to) {
  if (!whole) return {};
  return
      [whole = std::move(whole), from, to](double done) { whole(from + (to - from) * done); };
}

}  // namespace jnd::core
