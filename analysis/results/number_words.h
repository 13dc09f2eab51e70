#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

// Numbers as a paper prints them; none depends on the locale. What is absent or not finite is
// an en dash.

/// Four significant digits, as many decimals as that takes: 0.6974, 16.06, 0.00012; a whole
/// number without any.
[[nodiscard]] std::string number_words(const std::optional<double>& value);
[[nodiscard]] std::string number_words(const std::optional<double>& value, int num_decimals);
/// How many decimals four significant digits take; at most 4 for what is not tiny.
[[nodiscard]] int decimals_of(double value);
/// The shortest digits that give the value back, as it was published: 0.697.
[[nodiscard]] std::string shortest_words(double value);

/// "0.593 to 0.805" with no more decimals than `value`; an open end, also by
/// `bounded_by_data`, is said in words.
[[nodiscard]] std::string interval_words(const Interval& whole,
                                         const std::optional<double>& value);
/// The same of the number of this name, an open end being by `told_interval`.
[[nodiscard]] std::string interval_words(const std::string& name, const Interval& whole,
                                         const std::optional<double>& value);

/// "0.71 (0.38 to 1.04)"; the value alone without an interval.
[[nodiscard]] std::string with_interval(const std::optional<double>& value,
                                        const Interval& ci95);
[[nodiscard]] std::string with_interval(const std::string& name,
                                        const std::optional<double>& value,
                                        const Interval& ci95);

/// "0.021", "< 0.001".
[[nodiscard]] std::string p_words(const std::optional<double>& p_value);

/// "1 participant", "13 participants".
[[nodiscard]] std::string counted_words(std::int64_t count, const std::string& one);

/// Of seconds: "41 s", "12 min", "1 h 05 min".
[[nodiscard]] std::string duration_words(double duration_s);

/// A session's cells for readers: "priming: primed; method order: estimation, production".
[[nodiscard]] std::string cell_words(const std::string& cells);

/// A moment since 1970 as a date in UTC: "2026-11-20".
[[nodiscard]] std::string date_words(std::int64_t time_ns);

}  // namespace jnd::analysis
