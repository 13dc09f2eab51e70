#pragma once

#include <optional>
#include <vector>

namespace jnd::analysis {

/// p values adjusted by Holm (1979): the chance of one false alarm or more among all of them is
/// at most what each adjusted one is compared with. In the order given; what is absent stays
/// absent and is not counted, since a test that could not be made cannot give a false alarm.
/// Throws `core::Error` unless each is within [0, 1].
[[nodiscard]] std::vector<std::optional<double>> holm_adjusted(
    const std::vector<std::optional<double>>& p_values);

}  // namespace jnd::analysis
