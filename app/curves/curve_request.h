#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "app/curves/answer_request.h"

namespace jnd::app {

/// What the command line or the window asks about psychometric functions of anybody's answers,
/// in the words of `jnd fit psychometric` and with its defaults.
struct CurveRequest : AnswerRequest {
  std::string family = "normal";  ///< As named in `analysis::curve_families`.
  std::string axis = "linear";    ///< "linear" or "log".
  std::string task;               ///< "yes-no", "mafc:M", or "" if nobody said it.
  /// A rate, "free", or "" for the rate of the task, or 0 without a task.
  std::string guess;
  std::string lapse = "0";  ///< A rate, or "free".
  bool symmetric = false, falling = false, rising = false;
  bool compare = false, posterior = false;
  /// "A,B" for the free rates of the posterior; "" for the usual prior.
  std::string lapse_prior;
  std::vector<double> at = {0.5};
  /// Proportions as answered, besides the levels in `at`. `at` may be empty if there is one.
  std::vector<double> at_proportion = {};
  double jnd_at = analysis::CurveOptions{}.jnd_at;
  int num_bootstrap = 0, num_goodness = 0;
  std::string bootstrap_kind = "parametric";  ///< "parametric" or "nonparametric".
  std::uint64_t seed = 1;

  friend bool operator==(const CurveRequest&, const CurveRequest&) = default;
};

/// Throws `UsageError` for options that do not go together, and for levels out of range.
void require_request(const CurveRequest& request);

/// How the fits are to be made. Throws `UsageError` for an unknown task, and for rates that do
/// not go together.
[[nodiscard]] analysis::CurveOptions options_of(const CurveRequest& request);

/// The command that does the same, as a shell takes it: `jnd fit psychometric --csv ...`.
/// Defaults are left out.
[[nodiscard]] std::string command_of(const CurveRequest& request);

}  // namespace jnd::app
