#pragma once

#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "app/commands/answer_options.h"

namespace jnd::app {

enum class ScriptLanguage { kR, kPython };

/// A script that reads the same file and repeats the fit without this program. In R, it uses
/// glm if the curve is one of its links, otherwise optim. In Python, it has a search of its own
/// and needs nothing but Python. A comment in the script says what was found here.
[[nodiscard]] std::string script_of_fit(ScriptLanguage language, const AnswerRequest& options,
                                        const analysis::CurveOptions& how,
                                        const std::vector<analysis::CurveFit>& fits);

}  // namespace jnd::app
