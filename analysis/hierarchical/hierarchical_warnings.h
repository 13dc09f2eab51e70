#pragma once

#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Warns about answers that a hierarchical fit misinterprets, in one sentence each. They may be
/// right answers of a forced choice although `guess_rate` is 0, answers of people who answer
/// the wrong way round (`significant_fall`; the sentence names them), or rows of one person and
/// level that scatter, as rows of several sessions may (`row_scatter`).
[[nodiscard]] std::vector<std::string> hierarchical_warnings(
    const std::vector<ParticipantAnswers>& answers, double guess_rate);

}  // namespace jnd::analysis
