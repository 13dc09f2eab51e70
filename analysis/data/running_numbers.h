#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Numbers of one participant's trials in a block by when they were run. A trial that was put
/// off has a number from before its time; here the numbers of a session are dealt out anew in
/// the order of the trials' first ticks, over all trials that were answered: those set aside
/// and catch trials as well, so that leaving some out moves no other. Key: session and trial.
[[nodiscard]] std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> running_numbers(
    const ParticipantData& participant, const std::string& block);

}  // namespace jnd::analysis
