#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/statistics/fit_status.h"

// These functions read values from `test_support::reference_data` and compare results with
// them.

namespace jnd::analysis {

/// Reads rows [intensity, num_yes, num_trials].
inline std::vector<AnswerCount> reference_answers(const nlohmann::json& rows) {
  std::vector<AnswerCount> answers;
  for (const nlohmann::json& row : rows) answers.push_back({row[0], row[1], row[2]});
  return answers;
}

/// Expects a value where the other program has one, and none where it has null. `tolerance` is
/// relative to the value, or to 1e-3 for smaller values.
inline void expect_reference(const std::optional<double>& found, const nlohmann::json& expected,
                             double tolerance, const std::string& where) {
  ASSERT_EQ(found.has_value(), !expected.is_null()) << where;
  if (!found) return;
  const double value = expected;
  EXPECT_NEAR(*found, value, tolerance * std::max(std::fabs(value), 1e-3)) << where;
}

/// Compares both ends, which the reference holds as [low, high].
inline void expect_reference(const Interval& found, const nlohmann::json& expected,
                             double tolerance, const std::string& where) {
  expect_reference(found.low, expected.at(0), tolerance, where + " low");
  expect_reference(found.high, expected.at(1), tolerance, where + " high");
}

}  // namespace jnd::analysis
