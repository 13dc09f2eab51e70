#pragma once

#include <optional>
#include <string_view>

namespace jnd::analysis {

/// What came of a fit or a test. Not finding a value is an outcome, not an error.
enum class FitStatus {
  kNotRun,
  kOk,
  kDegenerate,    ///< The value asked for does not exist for these data; the reason says why.
  kNotConverged,  ///< It exists, but the search did not reach it.
};

/// "not_run", "ok", "degenerate", "not_converged": the words of the JSON output.
[[nodiscard]] constexpr std::string_view to_string(FitStatus status) noexcept {
  switch (status) {
    case FitStatus::kNotRun:
      return "not_run";
    case FitStatus::kOk:
      return "ok";
    case FitStatus::kDegenerate:
      return "degenerate";
    case FitStatus::kNotConverged:
      return "not_converged";
  }
  return "not_run";
}

/// The method that searches for the optimum. Both methods come to the same one.
enum class Solver {
  kCeres,   ///< For a fit that is reported; Newton's method mends its last digits and agrees.
  kNewton,  ///< For the many fits of data drawn anew: a tenth of the time.
};

/// A confidence interval. An absent end is open: the data do not bound the value on that side.
struct Interval {
  std::optional<double> low, high;
};

}  // namespace jnd::analysis
