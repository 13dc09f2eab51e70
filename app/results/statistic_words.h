#pragma once

#include <string>

#include "analysis/statistics/comparison.h"

namespace jnd::app {

/// A test's statistic with its name: "t(12) = 2.31"; for ranks "V = 45, T = 0", "U = 8.5" or "S
/// = 36"; for people's z "sum of z^2 = 31.90 on 13". "" if there is none.
[[nodiscard]] std::string statistic_words(const analysis::Comparison& comparison);

/// What a statistic's name means in full, such as "T, smaller sum of ranks".
[[nodiscard]] std::string statistic_title(const std::string& name);

}  // namespace jnd::app
