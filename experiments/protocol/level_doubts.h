#pragma once

#include <string_view>
#include <vector>

#include "experiments/protocol/located_json.h"

namespace jnd::experiments {

/// Lists of levels that may not mean what they say: neither ascending nor descending, or with
/// commas of two kinds, as [6,5, 7] has them, where a German 6,5 was meant and is two levels.
/// Their order says nothing, for stimuli are drawn, so that a shuffled list is no mistake: it
/// is asked about, and the study stays sound. `text` is that of the file, which is sound.
[[nodiscard]] std::vector<StudyProblem> level_doubts(const LocatedJson& file,
                                                     std::string_view text);

}  // namespace jnd::experiments
