#include "experiments/adaptive/interleave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/error.h"

namespace jnd::experiments {
namespace interleave_test {

TEST(Interleave, LetsNoTrackGetFurtherAheadThanItMay) {
  for (const int max_lead : {1, 2, 4}) {
    int widest = 0;
    for (int seed = 0; seed < 50; ++seed) {
      core::RandomStream stream(seed, "interleave");
      std::vector<InterleavedTrack> tracks(3);
      for (int trial = 0; trial < 90; ++trial) {
        ++tracks[next_track(tracks, max_lead, stream).value()].num_trials;
        const auto [fewest, most] =
            std::minmax({tracks[0].num_trials, tracks[1].num_trials, tracks[2].num_trials});
        widest = std::max(widest, most - fewest);
      }
    }
    EXPECT_EQ(widest, max_lead);
  }
}

TEST(Interleave, DrawsEachCandidateEquallyOften) {
  core::RandomStream stream(1, "interleave");
  const std::vector<InterleavedTrack> tracks = {{5}, {4}, {4}, {6}, {9, true}};
  std::vector<int> drawn(5);
  for (int i = 0; i < 30000; ++i) ++drawn[next_track(tracks, 2, stream).value()];
  // The standard deviation of each count is 82.
  for (const int track : {0, 1, 2}) EXPECT_NEAR(drawn[track], 10000, 400);
  EXPECT_EQ(drawn[3] + drawn[4], 0);
}

TEST(Interleave, DoesNotWaitForTracksThatAreFinished) {
  core::RandomStream stream(1, "interleave");
  EXPECT_EQ(next_track({{3, true}, {20}, {7, true}}, 1, stream), 1u);
  EXPECT_EQ(next_track({{3, true}, {20, true}}, 1, stream), std::nullopt);
  EXPECT_EQ(next_track({}, 1, stream), std::nullopt);
}

TEST(Interleave, IsTheSameForTheSameStream) {
  const std::vector<InterleavedTrack> tracks(6);
  std::set<std::size_t> different;
  for (int seed = 0; seed < 40; ++seed) {
    core::RandomStream first(seed, "interleave"), second(seed, "interleave");
    const auto track = next_track(tracks, 2, first);
    EXPECT_EQ(track, next_track(tracks, 2, second));
    different.insert(track.value());
  }
  EXPECT_EQ(different.size(), 6u);
}

TEST(Interleave, RefusesALeadOfNone) {
  core::RandomStream stream(1, "interleave");
  EXPECT_THROW((void)next_track({{0}}, 0, stream), core::Error);
}

}  // namespace interleave_test
}  // namespace jnd::experiments
