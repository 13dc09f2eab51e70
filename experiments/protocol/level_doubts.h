#pragma once

#include <string_view>
#include <vector>

#include "experiments/protocol/located_json.h"

namespace jnd::experiments {

/// Returns lists of levels that may not mean what they say: lists that are neither ascending
/// nor descending, or that have commas of two kinds, as in [6,5, 7], where a German 6,5 was
/// meant and is two levels. The order of a list has no meaning, because stimuli are drawn. So a
/// shuffled list is no mistake: it only raises a question, and the study stays valid. `text` is
/// that of the file, which must be valid.
[[nodiscard]] std::vector<StudyProblem> level_doubts(const LocatedJson& file,
                                                     std::string_view text);

}  // namespace jnd::experiments
