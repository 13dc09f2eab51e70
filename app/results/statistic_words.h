#pragma once

#include <string>

#include "analysis/statistics/comparison.h"

namespace jnd::app {

/// What a test's statistic is called and is: "t(12) = 2.31"; of ranks "V = 45, T = 0",
/// "U = 8.5", "S = 36"; of people's z "sum of z^2 = 31.90 on 13". "" without one.
[[nodiscard]] std::string statistic_words(const analysis::Comparison& comparison);

/// What a name stands for in full: "T, smaller sum of ranks".
[[nodiscard]] std::string statistic_title(const std::string& name);

}  // namespace jnd::app
