#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/random_stream.h"

namespace jnd::experiments {

/// One of several procedures that run in one block, turn by turn.
struct InterleavedTrack {
  int num_trials = 0;  ///< Answered so far.
  bool is_finished = false;
};

/// Which track asks next: drawn among those that are not finished, each equally likely, but
/// that none gets more than `max_lead_trials` (>= 1) trials ahead of another unfinished one.
/// With a lead of 1 every round holds each track once, and who counts can tell the last of a
/// round; 2 hides it. None when all are finished.
///
/// Draws from the stream once, or not at all when one track alone may ask. Not real time.
[[nodiscard]] std::optional<std::size_t> next_track(const std::vector<InterleavedTrack>& tracks,
                                                    int max_lead_trials,
                                                    core::RandomStream& stream);

}  // namespace jnd::experiments
