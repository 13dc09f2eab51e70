#include "core/streams/clock_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/clock_offsets.h"
#include "core/streams/stream_messages.h"

namespace jnd::core {
namespace clock_probe_test {

/// A clock on another machine that drifts, with delays on both ways.
struct FarClock {
  double offset_s = -1234.5;  ///< This is added to the clock's times.
  double drift_ppm = 0.0;     ///< By this much the clock is faster.
  /// The mean of each way's exponential delay, which comes on top of 50 us.
  double mean_delay_s = 0.0;
  double loss_ratio = 0.0;

  [[nodiscard]] double theirs_s(double ours_s) const {
    return (ours_s - offset_s) * (1.0 + 1e-6 * drift_ppm);
  }
  /// Returns the offset that turns this time of the clock into one of ours.
  [[nodiscard]] double true_offset_s(double theirs) const {
    return theirs / (1.0 + 1e-6 * drift_ppm) + offset_s - theirs;
  }
};

/// Returns all offsets within this duration, in virtual time.
std::vector<ClockOffset> compared(const FarClock& far, double duration_s, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> jitter(far.mean_delay_s > 0.0 ? 1.0 / far.mean_delay_s
                                                                      : 1.0);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  const auto way_s = [&] { return 50e-6 + (far.mean_delay_s > 0.0 ? jitter(random) : 0.0); };
  ClockProbe probe(7);
  std::vector<ClockOffset> offsets;
  // The answers, by the time at which they arrive.
  std::multimap<double, std::string> under_way;
  for (double now_s = 1000.0; now_s < 1000.0 + duration_s;) {
    for (auto next = under_way.begin(); next != under_way.end() && next->first <= now_s;
         next = under_way.erase(next)) {
      probe.take_answer(next->second, next->first);
    }
    if (const auto offset = probe.finished(now_s)) offsets.push_back(*offset);
    const std::string question = probe.due_question(now_s);
    if (!question.empty() && chance(random) >= far.loss_ratio) {
      const auto asked = time_question_of(question);
      const double there_s = now_s + way_s();
      const double back_s = there_s + 20e-6;
      under_way.emplace(back_s + way_s(), time_answer_message({.wave = asked->wave,
                                                               .t0_s = asked->t0_s,
                                                               .t1_s = far.theirs_s(there_s),
                                                               .t2_s = far.theirs_s(back_s)}));
    }
    double next_s = probe.next_due_s();
    if (!under_way.empty()) next_s = std::min(next_s, under_way.begin()->first);
    now_s = std::max(next_s, now_s + 1e-7);
  }
  return offsets;
}

TEST(ClockProbe, OnAnEvenWayTheOffsetIsExact) {
  const FarClock far;
  const auto offsets = compared(far, 20.0, 1);
  ASSERT_EQ(offsets.size(), 10U);
  for (const ClockOffset& one : offsets) {
    EXPECT_NEAR(one.offset_s, far.offset_s, 1e-9);
    EXPECT_NEAR(one.round_trip_s, 100e-6, 1e-8);
    EXPECT_NEAR(one.time_s, far.theirs_s(1000.0), 25.0);
  }
}

TEST(ClockProbe, OfAWaveTheShortestWayCounts) {
  ClockProbe probe(1, {.num_questions = 2, .min_answers = 1});
  const auto first = time_question_of(probe.due_question(10.0));
  const auto second = time_question_of(probe.due_question(10.1));
  ASSERT_TRUE(first && second);
  // The answer goes there at once and comes back late, so half of the way back is taken for an
  // offset.
  probe.take_answer(time_answer_message({first->wave, first->t0_s, 10.0, 10.0}), 10.05);
  probe.take_answer(time_answer_message({second->wave, second->t0_s, 10.1, 10.1}), 10.102);
  const auto offset = probe.finished(10.102);
  ASSERT_TRUE(offset);
  EXPECT_NEAR(offset->round_trip_s, 0.002, 1e-9);
  EXPECT_NEAR(offset->offset_s, 0.001, 1e-9);
}

TEST(ClockProbe, HearsOnlyWhatAnswersItsOwnQuestions) {
  ClockProbe probe(1, {.num_questions = 1, .min_answers = 1});
  const auto asked = time_question_of(probe.due_question(10.0));
  ASSERT_TRUE(asked);
  const int wave = asked->wave;
  // This is another wave.
  probe.take_answer(time_answer_message({wave + 1, 10.0, 5.0, 5.0}), 10.01);
  // This was never asked.
  probe.take_answer(time_answer_message({wave, 9.0, 5.0, 5.0}), 10.01);
  // This clock runs back.
  probe.take_answer(time_answer_message({wave, 10.0, 5.0, 4.0}), 10.01);
  probe.take_answer(time_answer_message({wave, 10.0, 5.0, 9.0}), 10.01);  // This took too long.
  probe.take_answer("nonsense", 10.01);
  EXPECT_FALSE(probe.finished(10.02)) << "the answer may still come";
  EXPECT_FALSE(probe.finished(11.0)) << "it did not";
  const auto next = time_question_of(probe.due_question(12.0));
  ASSERT_TRUE(next);
  probe.take_answer(time_answer_message({next->wave, 12.0, 5.0, 5.0}), 12.01);
  // This answer comes again.
  probe.take_answer(time_answer_message({next->wave, 12.0, 9.0, 9.0}), 12.001);
  ASSERT_TRUE(probe.finished(12.02));
}

TEST(ClockProbe, AWaveThatLostMostOfItsAnswersIsNone) {
  const auto offsets = compared({.loss_ratio = 0.9}, 200.0, 3);
  EXPECT_LT(offsets.size(), 20U);
  EXPECT_GT(compared({.loss_ratio = 0.3}, 200.0, 3).size(), 90U);
}

/// The page on streams promises an error within 0.2 ms in 99 of 100 moments.
TEST(ClockProbe, DriftAndJitterAreCorrectedToAFifthOfAMillisecond) {
  const FarClock far{.drift_ppm = 40.0, .mean_delay_s = 0.4e-3, .loss_ratio = 0.05};
  const auto offsets = compared(far, 600.0, 5);
  ASSERT_GT(offsets.size(), 290U);
  const ClockCorrection correction(offsets);
  std::vector<double> errors_s;
  for (double ours_s = 1000.0; ours_s < 1600.0; ours_s += 0.25) {
    const double theirs_s = far.theirs_s(ours_s);
    errors_s.push_back(std::abs(correction.corrected_s(theirs_s) - ours_s));
  }
  std::ranges::sort(errors_s);
  EXPECT_LT(errors_s[errors_s.size() * 99 / 100], 0.2e-3);
}

}  // namespace clock_probe_test
}  // namespace jnd::core
