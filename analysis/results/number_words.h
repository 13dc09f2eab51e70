#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

// Numbers in the format of a paper. None depends on the locale. Absent or infinite values are
// an en dash.

/// Four significant digits, with as many decimals as they need: 0.6974, 16.06, 0.00012. Whole
/// numbers have no decimals.
[[nodiscard]] std::string number_words(const std::optional<double>& value);
[[nodiscard]] std::string number_words(const std::optional<double>& value, int num_decimals);
/// The number of decimals for four significant digits. It is at most 4 unless the value is
/// tiny.
[[nodiscard]] int decimals_of(double value);
/// The shortest digits that reproduce the value, as it was published: 0.697.
[[nodiscard]] std::string shortest_words(double value);

/// For example "0.593 to 0.805", with no more decimals than `value`. Open ends, including those
/// of `bounded_by_data`, are expressed in words.
[[nodiscard]] std::string interval_words(const Interval& whole,
                                         const std::optional<double>& value);
/// The same for the result called `name`, whose open ends follow `told_interval`.
[[nodiscard]] std::string interval_words(const std::string& name, const Interval& whole,
                                         const std::optional<double>& value);

/// For example "0.71 (0.38 to 1.04)", or only the value if there is no interval.
[[nodiscard]] std::string with_interval(const std::optional<double>& value,
                                        const Interval& ci95);
[[nodiscard]] std::string with_interval(const std::string& name,
                                        const std::optional<double>& value,
                                        const Interval& ci95);

/// For example "0.021" or "< 0.001".
[[nodiscard]] std::string p_words(const std::optional<double>& p_value);

/// For example "1 participant" or "13 participants".
[[nodiscard]] std::string counted_words(std::int64_t count, const std::string& one);

/// A duration in seconds in words: "41 s", "12 min", "1 h 05 min".
[[nodiscard]] std::string duration_words(double duration_s);

/// A session's cells for readers, such as "priming: primed; method order: estimation,
/// production".
[[nodiscard]] std::string cell_words(const std::string& cells);

/// A time since 1970 as a date in UTC, such as "2026-11-20".
[[nodiscard]] std::string date_words(std::int64_t time_ns);

}  // namespace jnd::analysis
