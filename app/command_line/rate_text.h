#pragma once

#include <optional>
#include <string_view>

namespace jnd::app {

/// A number from 0 to below 1, also from a fraction of whole numbers such as 1/3; none for any
/// other text.
[[nodiscard]] std::optional<double> rate_of(std::string_view text) noexcept;

}  // namespace jnd::app
