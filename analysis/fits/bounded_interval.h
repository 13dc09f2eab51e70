#pragma once

#include <string>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// What is said of an end that stays open.
inline constexpr char kNotBounded[] = "not bounded by these data";

/// The interval as readers are shown it; JSON keeps the numbers. Of a quantity above 0, an end
/// beyond a thousand times the estimate or below a thousandth of it is open: such a number is
/// where a search happened to end, and no statement about the quantity. An end of exactly 0 is
/// a bound and stays, and so does every interval that reaches below 0.
[[nodiscard]] Interval bounded_by_data(const Interval& ci95,
                                       const std::optional<double>& estimate) noexcept;

/// The same of the number of this name among results. What everybody's own numbers have as
/// unit, such as the factor k of a power law, may be as uncertain as they are large: of ".k",
/// ".modulus" and geometric means every end is told as it is.
[[nodiscard]] Interval told_interval(const std::string& name, const Interval& ci95,
                                     const std::optional<double>& estimate) noexcept;

}  // namespace jnd::analysis
