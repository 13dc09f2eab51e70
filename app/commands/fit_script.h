#pragma once

#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "app/commands/answer_options.h"

namespace jnd::app {

enum class ScriptLanguage { kR, kPython };

/// A script that reads the same file and repeats the fit without this program: in R by glm
/// where the curve is one of its links, else by optim; in Python by a search of its own, with
/// nothing but what Python brings. What was found here stands in it as a comment.
[[nodiscard]] std::string script_of_fit(ScriptLanguage language, const AnswerRequest& options,
                                        const analysis::CurveOptions& how,
                                        const std::vector<analysis::CurveFit>& fits);

}  // namespace jnd::app
