#include "experiments/adaptive/interleave.h"

#include <algorithm>
#include <limits>

#include "core/require.h"

namespace jnd::experiments {

std::optional<std::size_t> next_track(const std::vector<InterleavedTrack>& tracks,
                                      int max_lead_trials, core::RandomStream& stream) {
  core::require(max_lead_trials >= 1, "max_lead_trials", "1 or more", max_lead_trials);
  int fewest = std::numeric_limits<int>::max();
  for (const InterleavedTrack& track : tracks) {
    if (!track.is_finished) fewest = std::min(fewest, track.num_trials);
  }
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!tracks[i].is_finished && tracks[i].num_trials - fewest < max_lead_trials) {
      candidates.push_back(i);
    }
  }
  if (candidates.empty()) return std::nullopt;
  if (candidates.size() == 1) return candidates.front();
  return candidates[stream.below(candidates.size())];
}

}  // namespace jnd::experiments
