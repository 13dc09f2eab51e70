#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "app/curves/answer_request.h"

namespace jnd::app {

/// What is asked about psychometric functions of anybody's answers, in the words of `jnd fit
/// psychometric` and with its defaults: of the command line and of the window.
struct CurveRequest : AnswerRequest {
  std::string family = "normal";  ///< As `analysis::curve_families` call them.
  std::string axis = "linear";    ///< Or "log".
  std::string task;               ///< "yes-no", "mafc:M", or "" where nobody said.
  std::string guess;              ///< A rate, "free", or "" for that of the task, else 0.
  std::string lapse = "0";        ///< A rate, or "free".
  bool symmetric = false, falling = false, rising = false;
  bool compare = false, posterior = false;
  std::string lapse_prior;  ///< "A,B" of the posterior's free rates; "" for the usual one.
  std::vector<double> at = {0.5};
  /// As answered, beside those of `at`; `at` may be empty where there is one.
  std::vector<double> at_proportion = {};
  double jnd_at = analysis::CurveOptions{}.jnd_at;
  int num_bootstrap = 0, num_goodness = 0;
  std::string bootstrap_kind = "parametric";  ///< Or "nonparametric".
  std::uint64_t seed = 1;

  friend bool operator==(const CurveRequest&, const CurveRequest&) = default;
};

/// Throws `UsageError` for what does not go together, and for levels out of range.
void require_request(const CurveRequest& request);

/// How the fits are to be made. Throws `UsageError` for a task that is none, and for rates that
/// do not go together.
[[nodiscard]] analysis::CurveOptions options_of(const CurveRequest& request);

/// The command that does the same, as a shell takes it: `jnd fit psychometric --csv ...`. What
/// is a default is left out.
[[nodiscard]] std::string command_of(const CurveRequest& request);

}  // namespace jnd::app
