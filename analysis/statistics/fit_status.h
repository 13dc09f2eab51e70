#pragma once

#include <optional>
#include <string_view>

namespace jnd::analysis {

/// The outcome of a fit or a test. A missing value is an outcome, not an error.
enum class FitStatus {
  kNotRun,
  kOk,
  kDegenerate,    ///< The requested value does not exist for these data. The reason says why.
  kNotConverged,  ///< The value exists, but the search did not reach it.
};

/// The words of the JSON output: "not_run", "ok", "degenerate", "not_converged".
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

/// The method that searches for the optimum. Both methods find the same optimum.
enum class Solver {
  /// For fits that are reported. Newton's method improves the last digits and confirms the
  /// result.
  kCeres,
  kNewton,  ///< For the many fits of redrawn data. It takes a tenth of the time.
};

/// A confidence interval. An absent end is open: the data do not bound the value on that side.
struct Interval {
  std::optional<double> low, high;
};

}  // namespace jnd::analysis
