#pragma once

#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// What answers may be that a hierarchical fit takes for something else: right answers of a
/// forced choice, where `guess_rate` is 0, people who answer the wrong way round
/// (`significant_fall`), each by name, and rows of one person and level that scatter, as those
/// of sessions may (`row_scatter`). One sentence each.
[[nodiscard]] std::vector<std::string> hierarchical_warnings(
    const std::vector<ParticipantAnswers>& answers, double guess_rate);

}  // namespace jnd::analysis
