#pragma once

#include <string>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// Words for an end that stays open.
inline constexpr char kNotBounded[] = "not bounded by these data";

/// The interval as it is shown to readers; JSON keeps the numbers. If all values of a quantity
/// are above 0, an end above a thousand times the estimate or below a thousandth of it is shown
/// as open, because such a number is where a search happened to stop, and says nothing about
/// the quantity. An end of exactly 0 is a bound and stays. An interval that reaches below 0 is
/// unchanged.
[[nodiscard]] Interval bounded_by_data(const Interval& ci95,
                                       const std::optional<double>& estimate) noexcept;

/// The interval of the result called `name`, as it is shown to readers. It is unchanged for
/// ".k", ".modulus" and geometric means, whose unit is each participant's own scale of numbers:
/// such results may be as uncertain as the ends say. All others follow `bounded_by_data`.
[[nodiscard]] Interval told_interval(const std::string& name, const Interval& ci95,
                                     const std::optional<double>& estimate) noexcept;

}  // namespace jnd::analysis
