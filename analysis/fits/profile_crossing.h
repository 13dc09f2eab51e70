#pragma once

#include <functional>
#include <optional>

namespace jnd::analysis {

/// The first place where `excess` reaches 0 on a walk with growing steps from `from` toward
/// `limit`. `excess` is < 0 at `from`. The result is absent if `excess` does not reach 0 before
/// `limit`. `precision` is relative.
[[nodiscard]] std::optional<double> crossing(const std::function<double(double)>& excess,
                                             double from, double first_step, double limit,
                                             double precision = 1e-13);

}  // namespace jnd::analysis
