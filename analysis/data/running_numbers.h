#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Numbers one participant's trials in a block in the order in which they were run. A postponed
/// trial has a stored number from before its time. So the numbers of a session are assigned
/// again in the order of the trials' first ticks. All answered trials are numbered, including
/// catch trials and those set aside, so leaving some out does not move the others. The key is
/// session and trial.
[[nodiscard]] std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> running_numbers(
    const ParticipantData& participant, const std::string& block);

}  // namespace jnd::analysis
