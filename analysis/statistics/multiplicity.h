#pragma once

#include <optional>
#include <vector>

namespace jnd::analysis {

/// p values adjusted by Holm (1979). If each is compared with alpha, the chance of one or more
/// false alarms among all of them is at most alpha. They keep the given order. Absent values
/// stay absent and do not count, because a test that could not be made cannot give a false
/// alarm. Throws `core::Error` unless each is within [0, 1].
[[nodiscard]] std::vector<std::optional<double>> holm_adjusted(
    const std::vector<std::optional<double>>& p_values);

}  // namespace jnd::analysis
