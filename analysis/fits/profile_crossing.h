#pragma once

#include <functional>
#include <optional>

namespace jnd::analysis {

/// Where `excess`, < 0 at `from`, first is 0 when going by growing steps toward `limit`; absent
/// if it is not by then. `precision` is relative.
[[nodiscard]] std::optional<double> crossing(const std::function<double(double)>& excess,
                                             double from, double first_step, double limit,
                                             double precision = 1e-13);

}  // namespace jnd::analysis
