#include "device/network/link_quality.h"

#include <gtest/gtest.h>

#include <limits>

namespace jnd::device {
namespace link_quality_test {

using Verdict = LinkQuality::Verdict;

LinkQuality fed(std::uint32_t first, int num, int every_lost = 0) {
  LinkQuality quality;
  quality.echoed(1, 2'000'001);
  for (int i = 0; i < num; ++i) {
    if (every_lost > 0 && i % every_lost == every_lost - 1) continue;
    (void)quality.received(first + static_cast<std::uint32_t>(i));
  }
  return quality;
}

TEST(LinkQuality, CountsWhatIsLostDoubledAndReordered) {
  LinkQuality quality;
  for (const std::uint32_t sequence : {10u, 11u, 14u}) {
    EXPECT_EQ(quality.received(sequence), Verdict::kNewest);
  }
  EXPECT_EQ(quality.counts().lost, 2);
  EXPECT_EQ(quality.received(12), Verdict::kReordered);
  EXPECT_EQ(quality.received(12), Verdict::kRepeated);
  EXPECT_EQ(quality.received(14), Verdict::kRepeated);
  EXPECT_EQ(quality.counts().lost, 1);
  EXPECT_EQ(quality.counts().reordered, 1);
  EXPECT_EQ(quality.counts().doubled, 2);
  EXPECT_EQ(quality.counts().received, 4);
}

TEST(LinkQuality, OneFromLongAgoCountsAsRepeated) {
  LinkQuality quality = fed(1000, 600);
  EXPECT_EQ(quality.received(1000), Verdict::kRepeated);
  EXPECT_EQ(quality.received(1599 - 512), Verdict::kRepeated);
  EXPECT_EQ(quality.counts().received, 600);
}

TEST(LinkQuality, OnesFromBeforeTheFirstHideNoLoss) {
  LinkQuality quality;
  (void)quality.received(1000);
  for (std::uint32_t i = 1; i <= 40; ++i) {
    EXPECT_EQ(quality.received(1000 - i), Verdict::kRepeated) << i;
  }
  for (std::uint32_t i = 0; i < 99; ++i) {
    if (i % 5 < 3) (void)quality.received(1001 + i);
  }
  EXPECT_EQ(quality.level(), LinkLevel::kPoor) << "forty of ninety-nine are missing";
  EXPECT_EQ(quality.counts().received, 61);
}

TEST(LinkQuality, SequenceNumbersMayWrap) {
  LinkQuality quality = fed(0xffffff80u, 300);
  EXPECT_EQ(quality.counts().received, 300);
  EXPECT_EQ(quality.counts().lost, 0);
  EXPECT_EQ(quality.level(), LinkLevel::kExcellent);
  EXPECT_EQ(quality.received(0xfffffff0u), Verdict::kRepeated);
  EXPECT_FALSE(quality.is_broken());
}

TEST(LinkQuality, TwentyLostInARowBreakItAndNineteenDoNot) {
  LinkQuality quality = fed(1, 200);
  EXPECT_EQ(quality.received(220), Verdict::kNewest);
  EXPECT_FALSE(quality.is_broken());
  EXPECT_EQ(quality.received(241), Verdict::kNewest);
  EXPECT_TRUE(quality.is_broken());
  for (std::uint32_t i = 0; i < 1000; ++i) (void)quality.received(242 + i);
  EXPECT_TRUE(quality.is_broken()) << "until it is begun anew";
  quality.restart();
  EXPECT_FALSE(quality.is_broken());
}

TEST(LinkQuality, TheLevelFollowsFromWhatIsMissing) {
  EXPECT_EQ(fed(1, 49).level(), LinkLevel::kUnacceptable) << "too few to judge by";
  EXPECT_EQ(fed(1, 50).level(), LinkLevel::kExcellent);
  EXPECT_EQ(fed(1, 1000, 400).level(), LinkLevel::kExcellent);
  EXPECT_EQ(fed(1, 1000, 100).level(), LinkLevel::kGood);
  EXPECT_EQ(fed(1, 1000, 15).level(), LinkLevel::kPoor);
  EXPECT_EQ(fed(1, 1000, 5).level(), LinkLevel::kUnacceptable);
}

TEST(LinkQuality, WhatIsMissingIsForgottenAfterAWindow) {
  LinkQuality quality = fed(1, 1000, 5);
  for (std::uint32_t i = 0; i < 512; ++i) (void)quality.received(1001 + i);
  EXPECT_EQ(quality.level(), LinkLevel::kExcellent);
}

TEST(LinkQuality, TheLevelFollowsFromTheRoundTripToo) {
  const auto level_at = [](std::int64_t round_trip_ns) {
    LinkQuality quality = fed(1, 200);
    for (std::int64_t sent_ns = 2; sent_ns <= 201; ++sent_ns) {
      quality.echoed(sent_ns, sent_ns + round_trip_ns);
    }
    return quality.level();
  };
  EXPECT_EQ(level_at(2'000'000), LinkLevel::kExcellent);
  EXPECT_EQ(level_at(6'000'000), LinkLevel::kGood);
  EXPECT_EQ(level_at(12'000'000), LinkLevel::kPoor);
  EXPECT_EQ(level_at(20'000'000), LinkLevel::kUnacceptable);
}

TEST(LinkQuality, IsNotSettledBeforeARoundTripHasBeenMeasured) {
  LinkQuality quality = fed(1, 200);
  quality.restart();
  for (std::uint32_t i = 201; i <= 500; ++i) (void)quality.received(i);
  EXPECT_EQ(quality.level(), LinkLevel::kExcellent);
  EXPECT_FALSE(quality.has_round_trip());
  EXPECT_FALSE(quality.is_settled());
  quality.echoed(1, 600);
  EXPECT_FALSE(quality.is_settled()) << "this one has been heard before";
  quality.echoed(2, 600);
  EXPECT_TRUE(quality.is_settled());
}

TEST(LinkQuality, AnEchoThatCannotBeMeasuresNothing) {
  constexpr std::int64_t kNow_ns = 5'000'000'000;
  constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();
  LinkQuality quality;
  for (const std::int64_t echo_ns :
       {std::int64_t{0}, std::int64_t{-1}, kNow_ns + 1, kHighest, kLowest}) {
    quality.echoed(echo_ns, kNow_ns);
    EXPECT_FALSE(quality.has_round_trip()) << echo_ns;
  }
  quality.echoed(kNow_ns, kNow_ns);
  EXPECT_TRUE(quality.has_round_trip()) << "in no time at all";
  for (const std::int64_t echo_ns : {kNow_ns, kNow_ns - 1, std::int64_t{0}, kLowest}) {
    quality.echoed(echo_ns, kNow_ns + 1'000'000'000);
    EXPECT_EQ(quality.round_trip_s(), 0.0) << echo_ns << " is no newer";
    EXPECT_EQ(quality.last_echo_ns(), kNow_ns);
  }
}

TEST(LinkQuality, HasToBeGoodForAWhile) {
  EXPECT_FALSE(fed(1, 140).is_settled());
  EXPECT_TRUE(fed(1, 160).is_settled());
  LinkQuality quality = fed(1, 300);
  (void)quality.received(312);
  EXPECT_FALSE(quality.is_settled()) << "eleven missing are poor";
}

TEST(LinkQuality, ATickThatFindsNothingNewIsLate) {
  LinkQuality quality;
  (void)quality.received(1);
  quality.end_tick();
  quality.end_tick();
  (void)quality.received(2);
  (void)quality.received(2);
  quality.end_tick();
  EXPECT_EQ(quality.counts().late, 1);
}

TEST(LinkQuality, JudgedAnewItStillKnowsWhatItHasSeen) {
  LinkQuality quality;
  for (std::uint32_t i = 1; i <= 100; ++i) (void)quality.received(i);
  quality.judge_anew();
  EXPECT_EQ(quality.level(), LinkLevel::kUnacceptable) << "all is to be shown anew";
  EXPECT_EQ(quality.received(100), LinkQuality::Verdict::kRepeated);
  EXPECT_NE(quality.received(3), LinkQuality::Verdict::kNewest) << "an old one";
  EXPECT_EQ(quality.received(101), LinkQuality::Verdict::kNewest);
  quality.restart();
  EXPECT_EQ(quality.received(3), LinkQuality::Verdict::kNewest) << "of another stream";
}

/// Feeds states at this rate for some seconds. Every tenth is lost from `lost_after_s` on.
LinkQuality fed_at(double rate_hz, double seconds, double lost_after_s) {
  LinkQuality quality;
  quality.restart(rate_hz);
  quality.echoed(1, 2'000'001);
  for (int i = 0; i < static_cast<int>(seconds * rate_hz); ++i) {
    if (i > static_cast<int>(lost_after_s * rate_hz) && i % 9 == 8) continue;
    (void)quality.received(0xffff'0000U + static_cast<std::uint32_t>(i));
  }
  return quality;
}

TEST(LinkQuality, MeansTheSameTimesAtAnyRate) {
  for (const double rate_hz : {500.0, 1000.0, 4000.0, 10000.0}) {
    EXPECT_FALSE(fed_at(rate_hz, 0.13, 9.0).is_settled()) << rate_hz;
    EXPECT_TRUE(fed_at(rate_hz, 0.17, 9.0).is_settled()) << rate_hz;
    EXPECT_EQ(fed_at(rate_hz, 3.0, 2.94).level(), LinkLevel::kGood) << rate_hz;
    EXPECT_EQ(fed_at(rate_hz, 3.0, 2.8).level(), LinkLevel::kPoor) << rate_hz;
    EXPECT_EQ(fed_at(rate_hz, 3.0, 2.3).level(), LinkLevel::kUnacceptable) << rate_hz;
    LinkQuality quality = fed_at(rate_hz, 1.0, 9.0);
    const auto last = 0xffff'0000U + static_cast<std::uint32_t>(rate_hz) - 1U;
    const auto of_18_ms = static_cast<std::uint32_t>(0.018 * rate_hz);
    (void)quality.received(last + of_18_ms);
    EXPECT_FALSE(quality.is_broken()) << rate_hz;
    (void)quality.received(last + of_18_ms + static_cast<std::uint32_t>(0.022 * rate_hz));
    EXPECT_TRUE(quality.is_broken()) << rate_hz;
  }
}

}  // namespace link_quality_test
}  // namespace jnd::device
