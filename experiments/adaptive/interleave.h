#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/random_stream.h"

namespace jnd::experiments {

/// One of several procedures that take turns in one block.
struct InterleavedTrack {
  int num_trials = 0;  ///< Trials answered so far.
  bool is_finished = false;
};

/// Draws which track asks next. All unfinished tracks are equally likely, but none gets more
/// than `max_lead_trials` (>= 1) trials ahead of another unfinished one. With a lead of 1 every
/// round holds each track once, so a participant who counts knows the last track of a round; a
/// lead of 2 hides it. Returns none if all are finished.
///
/// Draws from the stream once, or not at all if only one track may ask. Not real time.
[[nodiscard]] std::optional<std::size_t> next_track(const std::vector<InterleavedTrack>& tracks,
                                                    int max_lead_trials,
                                                    core::RandomStream& stream);

}  // namespace jnd::experiments
