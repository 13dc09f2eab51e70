#pragma once

#include <limits>
#include <string_view>

#include "core/error.h"

namespace jnd::core {

/// Stands for "no bound".
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Throws `Error` "FIELD: expected RULE, found VALUE" unless `holds`. Write the condition so
/// that NaN fails it: `require(x > 0, ...)`. Not real time.
void require(bool holds, std::string_view field, std::string_view rule, double value);

/// Requires a finite number > 0. Throws `Error`.
void require_positive(double value, std::string_view field);
/// Requires a finite number >= 0. Throws `Error`.
void require_not_negative(double value, std::string_view field);

/// Returns the period in seconds. `rate_hz` is a finite number > 0; throws `Error` otherwise.
[[nodiscard]] double period_s_at(double rate_hz);

}  // namespace jnd::core
