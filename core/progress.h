#pragma once

#include <functional>
#include <utility>

namespace jnd::core {

/// A function that is told how much of some work is done, 0 to 1. If it throws, the work ends.
/// It may be empty.
using Progress = std::function<void(double)>;

inline void tell(const Progress& progress, double done) {
  if (progress) progress(done);
}

/// Tells that the first `num_done` of `num_parts` equal parts are done.
template <typename Number>
void tell(const Progress& progress, Number num_done, Number num_parts) {
  if (num_parts > Number{}) {
    tell(progress, static_cast<double>(num_done) / static_cast<double>(num_parts));
  }
}

/// Returns a progress for a part of the work, which maps its 0 to 1 to `from` to `to` of the
/// whole.
[[nodiscard]] inline Progress part_of(Progress whole, double from, double to) {
  if (!whole) return {};
  return
      [whole = std::move(whole), from, to](double done) { whole(from + (to - from) * done); };
}

}  // namespace jnd::core
