#include "core/sound/sound_mixer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/sound/sound_level.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace sound_mixer_test {

using Kind = NoiseShape::Kind;
using test_support::AllocationCounter;

constexpr double kRate_hz = 8000.0;
constexpr std::size_t kPeriod = 64;

/// Returns what an output hears that takes samples as fast as they come.
std::vector<float> heard_of(SoundMixer& mixer, std::size_t num_periods,
                            std::int64_t first_ns = 0) {
  std::vector<float> all;
  std::vector<float> period(kPeriod);
  for (std::size_t i = 0; i < num_periods; ++i) {
    const auto frame = static_cast<double>(i * kPeriod);
    mixer.render(period, first_ns + std::llround(frame / kRate_hz * 1e9));
    all.insert(all.end(), period.begin(), period.end());
  }
  return all;
}

/// The mixer's first noise by itself, with a root mean square of 1.
Noise first_noise(const NoiseShape& shape, std::uint64_t seed) {
  return {shape, kRate_hz, derived_seed(seed, "noise", {0})};
}

TEST(SoundMixer, IsSilentUntilSomethingIsAskedFor) {
  SoundMixer mixer({.rate_hz = kRate_hz, .noises = {{.level_dbfs = -30.0}}});
  for (const float sample : heard_of(mixer, 10)) EXPECT_EQ(sample, 0.0f);
  EXPECT_EQ(mixer.num_frames(), 640);
}

TEST(SoundMixer, ANoiseComesByAQuarterOfASineAndGoesOnAtItsLevel) {
  SoundMixer mixer({.rate_hz = kRate_hz, .seed = 5, .noises = {{.level_dbfs = -30.0}}});
  ASSERT_TRUE(mixer.play_noise(0, 0.5));
  const std::vector<float> heard = heard_of(mixer, 1000);
  Noise noise = first_noise({}, 5);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const double place = std::min(1.0, static_cast<double>(i + 1) / (0.5 * kRate_hz));
    const double expected =
        rms_of_level(-30.0) * std::sin(0.5 * std::numbers::pi * place) * noise.next();
    ASSERT_NEAR(heard[i], expected, 1e-7) << "sample " << i;
  }
}

TEST(SoundMixer, ANoiseGoesInItsRampAndLeavesSilence) {
  SoundMixer mixer({.rate_hz = kRate_hz, .noises = {{.level_dbfs = -30.0}}});
  ASSERT_TRUE(mixer.play_noise(0, 0.1));
  (void)heard_of(mixer, 100);
  ASSERT_TRUE(mixer.play_noise(SoundMixer::kNoNoise, 0.1));
  const std::vector<float> heard = heard_of(mixer, 100);
  const auto loudest = [&](std::size_t from, std::size_t to) {
    float most = 0.0f;
    for (std::size_t i = from; i < to; ++i) most = std::max(most, std::abs(heard[i]));
    return most;
  };
  EXPECT_GT(loudest(0, 100), 0.02f) << "it does not break off";
  EXPECT_LT(loudest(720, 800), 0.01f);
  EXPECT_EQ(loudest(801, heard.size()), 0.0f);
}

// Whichever noise follows which, the power of both together never drops.
TEST(SoundMixer, WhereANoiseTakesAnothersPlaceThePowerStays) {
  SoundMixer mixer(
      {.rate_hz = kRate_hz, .noises = {{.level_dbfs = -30.0}, {.level_dbfs = -30.0}}});
  ASSERT_TRUE(mixer.play_noise(0, 0.1));
  (void)heard_of(mixer, 200);
  ASSERT_TRUE(mixer.play_noise(1, 4.0));
  const std::vector<float> heard = heard_of(mixer, 600);
  for (std::size_t begin = 0; begin + 4000 <= heard.size(); begin += 4000) {
    double sum = 0.0;
    for (std::size_t i = begin; i < begin + 4000; ++i) {
      sum += static_cast<double>(heard[i]) * static_cast<double>(heard[i]);
    }
    EXPECT_NEAR(level_of_rms(std::sqrt(sum / 4000.0)), -30.0, 0.5) << begin;
  }
}

TEST(SoundMixer, ACueIsHeardAfterItsDelayWhateverPeriodItCameIn) {
  const Tone tone{.frequency_hz = 1000.0, .duration_s = 0.05, .level_dbfs = -20.0};
  SoundMixer mixer({.rate_hz = kRate_hz, .cues = {tone}, .cue_delay_s = 0.020});
  // A cue that is asked for at 3 ms is heard at 23 ms, which is sample 184.
  ASSERT_TRUE(mixer.play_cue(0, 7, 3'000'000));
  const std::vector<float> heard = heard_of(mixer, 20);
  const std::vector<float> expected = samples_of(tone, kRate_hz);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const bool is_in = i >= 184 && i < 184 + expected.size();
    ASSERT_EQ(heard[i], is_in ? expected[i - 184] : 0.0f) << "sample " << i;
  }
  HeardCue told;
  ASSERT_TRUE(mixer.next_heard(told));
  EXPECT_EQ(told.id, 7U);
  EXPECT_EQ(told.asked_ns, 3'000'000);
  EXPECT_EQ(told.heard_ns, 23'000'000);
  EXPECT_FALSE(mixer.next_heard(told));
}

TEST(SoundMixer, ACueThatComesLateIsHeardAtOnceAndSaysSo) {
  SoundMixer mixer({.rate_hz = kRate_hz, .cues = {Tone{}}, .cue_delay_s = 0.010});
  ASSERT_TRUE(mixer.play_cue(0, 1, 0));
  (void)heard_of(mixer, 2, 500'000'000);
  HeardCue told;
  ASSERT_TRUE(mixer.next_heard(told));
  EXPECT_EQ(told.heard_ns, 500'000'000);
}

TEST(SoundMixer, MoreCuesThanSoundAtOnceWaitForAPlaceAndNoneIsLost) {
  SoundMixer mixer({.rate_hz = kRate_hz, .cues = {{.duration_s = 0.1, .level_dbfs = -40.0}}});
  for (std::uint64_t id = 1; id <= 20; ++id) ASSERT_TRUE(mixer.play_cue(0, id, 0));
  (void)heard_of(mixer, 60);
  HeardCue told;
  for (std::uint64_t id = 1; id <= 20; ++id) {
    ASSERT_TRUE(mixer.next_heard(told));
    EXPECT_EQ(told.id, id);
  }
}

TEST(SoundMixer, AFullQueueSaysThatItIsFull) {
  SoundMixer mixer({.rate_hz = kRate_hz, .cues = {Tone{}}});
  int num_taken = 0;
  while (num_taken < 1000 && mixer.play_cue(0, 1, 0)) ++num_taken;
  EXPECT_EQ(num_taken, 64);
}

TEST(SoundMixer, NothingClipsAtTheLoudestThatAStudyMayAskFor) {
  const Tone tone{.frequency_hz = 700.0, .duration_s = 2.0, .level_dbfs = kLoudestCue_dbfs};
  SoundMixer mixer(
      {.rate_hz = kRate_hz,
       .noises = {{.shape = {.kind = Kind::kPink}, .level_dbfs = kLoudestNoise_dbfs}},
       .cues = {tone}});
  ASSERT_TRUE(mixer.play_noise(0, 0.05));
  float highest = 0.0f;
  for (int round = 0; round < 8; ++round) {
    ASSERT_TRUE(mixer.play_cue(0, 1, 0));
    for (const float sample : heard_of(mixer, 250)) {
      highest = std::max(highest, std::abs(sample));
    }
  }
  EXPECT_GT(highest, 0.5f);
  EXPECT_LE(highest, static_cast<float>(SoundLimiter::kCeiling));
  EXPECT_EQ(mixer.num_limited(), 0);
}

// Eight cues at once are more than any study asks for. The limiter is there for unforeseen
// cases.
TEST(SoundMixer, EightOfTheLoudestCuesAtOnceAreTurnedDown) {
  const Tone tone{.frequency_hz = 700.0, .duration_s = 0.5, .level_dbfs = kLoudestCue_dbfs};
  SoundMixer mixer({.rate_hz = kRate_hz, .cues = {tone}});
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(mixer.play_cue(0, 1, 0));
  float highest = 0.0f;
  for (const float sample : heard_of(mixer, 70)) highest = std::max(highest, std::abs(sample));
  EXPECT_LE(highest, static_cast<float>(SoundLimiter::kCeiling));
  EXPECT_GT(highest, 0.88f);
  EXPECT_GT(mixer.num_limited(), 0);
}

TEST(SoundMixer, TakesNoHeapWhileItPlays) {
  if (!AllocationCounter::is_supported()) GTEST_SKIP() << "a sanitizer owns malloc";
  SoundMixer mixer({.rate_hz = 48000.0,
                    .noises = {{.shape = {.kind = Kind::kPink}, .level_dbfs = -40.0},
                               {.shape = {.kind = Kind::kBand, .low_hz = 100, .high_hz = 4000},
                                .level_dbfs = -40.0}},
                    .cues = {Tone{}}});
  std::vector<float> period(kPeriod);
  const AllocationCounter counter;
  (void)mixer.play_noise(0, 0.1);
  for (int i = 0; i < 500; ++i) {
    if (i == 100) (void)mixer.play_noise(1, 0.2);
    if (i % 20 == 0) (void)mixer.play_cue(0, 1, 0);
    mixer.render(period, 0);
    HeardCue heard;
    while (mixer.next_heard(heard)) {
    }
  }
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_EQ(counter.frees(), 0U);
}

// This plays an hour of a session as fast as it can. Each of the 28.8 million samples has its
// expected value, so that there is no gap, click or step.
TEST(SoundMixer, HasNoGapInAnHour) {
  const Tone tone{.frequency_hz = 440.0, .duration_s = 0.1, .level_dbfs = -25.0};
  SoundMixer mixer({.rate_hz = kRate_hz,
                    .seed = 3,
                    .noises = {{.level_dbfs = -30.0}},
                    .cues = {tone},
                    .cue_delay_s = 0.030});
  const std::vector<float> cue = samples_of(tone, kRate_hz);
  ASSERT_TRUE(mixer.play_noise(0, 0.5));
  Noise noise = first_noise({}, 3);
  const double rms = rms_of_level(-30.0);
  const auto hour = static_cast<std::int64_t>(3600.0 * kRate_hz);
  std::vector<float> period(kPeriod);
  std::int64_t num_wrong = 0, cue_begins = std::numeric_limits<std::int64_t>::max();
  int num_cues = 0;
  for (std::int64_t frame = 0; frame < hour; frame += static_cast<std::int64_t>(kPeriod)) {
    const std::int64_t now_ns = frame * 125'000;
    // Somebody asks for a cue every 7.3 seconds.
    if (frame / 58'400 >= num_cues) {
      ASSERT_TRUE(mixer.play_cue(0, static_cast<std::uint64_t>(++num_cues), now_ns));
    }
    mixer.render(period, now_ns);
    if (HeardCue heard; mixer.next_heard(heard)) cue_begins = heard.heard_ns / 125'000;
    for (std::size_t i = 0; i < kPeriod; ++i) {
      const std::int64_t at = frame + static_cast<std::int64_t>(i);
      const double place = std::min(1.0, static_cast<double>(at + 1) / (0.5 * kRate_hz));
      double expected =
          rms * noise.next() * (place < 1.0 ? std::sin(0.5 * std::numbers::pi * place) : 1.0);
      const std::int64_t since = at - cue_begins;
      if (since >= 0 && since < static_cast<std::int64_t>(cue.size())) {
        expected += static_cast<double>(cue[static_cast<std::size_t>(since)]);
      }
      num_wrong += std::abs(static_cast<double>(period[i]) - expected) > 1e-6 ? 1 : 0;
    }
  }
  EXPECT_EQ(num_wrong, 0);
  EXPECT_EQ(mixer.num_frames(), hour);
  EXPECT_EQ(mixer.num_limited(), 0);
  EXPECT_EQ(num_cues, 494);
}

TEST(SoundMixer, RefusesWhatIsTooLoudOrNoNumber) {
  const auto made = [](double level_dbfs) {
    return SoundMixer({.rate_hz = kRate_hz, .noises = {{.level_dbfs = level_dbfs}}})
        .num_frames();
  };
  EXPECT_EQ(made(kLoudestNoise_dbfs), 0);
  EXPECT_THROW(made(kLoudestNoise_dbfs + 0.1), Error);
  EXPECT_THROW(made(std::nan("")), Error);
  EXPECT_THROW((void)samples_of({.level_dbfs = kLoudestCue_dbfs + 0.1}, kRate_hz), Error);
  EXPECT_THROW((void)samples_of({.frequency_hz = 4000.0}, kRate_hz), Error);
  EXPECT_THROW((void)samples_of({.duration_s = std::nan("")}, kRate_hz), Error);
}

TEST(Tone, HasItsLevelAndBeginsAndEndsInSilence) {
  const std::vector<float> samples =
      samples_of({.frequency_hz = 1000.0, .duration_s = 0.2, .level_dbfs = -20.0}, kRate_hz);
  ASSERT_EQ(samples.size(), 1600U);
  EXPECT_EQ(samples.front(), 0.0f);
  EXPECT_LT(std::abs(samples.back()), 1e-4f);
  double sum = 0.0;
  for (std::size_t i = 80; i < 1520; ++i) {
    sum += static_cast<double>(samples[i]) * static_cast<double>(samples[i]);
  }
  EXPECT_NEAR(level_of_rms(std::sqrt(sum / 1440.0)), -20.0, 1e-6);
  // The ramp lasts 10 ms. Half of the tone is there at sample 40, where the sine is 0; sample
  // 42 is checked.
  EXPECT_NEAR(samples[42], 0.1 * (0.5 - 0.5 * std::cos(std::numbers::pi * 0.525)), 1e-6);
  float steepest = 0.0f;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    steepest = std::max(steepest, std::abs(samples[i] - samples[i - 1]));
  }
  EXPECT_LT(steepest, 0.1f * 2.0f * std::numbers::pi_v<float> * 1000.0f / 8000.0f + 1e-3f)
      << "nowhere steeper than the sine itself";
}

TEST(SoundLimiter, LetsNothingBeyondItsCeilingWhateverComes) {
  SoundLimiter limiter(kRate_hz);
  RandomStream random(1, "limiter");
  for (int i = 0; i < 100000; ++i) {
    const double x = std::exp(random.uniform(-5.0, 12.0)) * (random.uniform() < 0.5 ? -1 : 1);
    ASSERT_LE(std::abs(limiter.next(x)), SoundLimiter::kCeiling);
  }
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(limiter.next(x), 0.0) << "what is no number is silence";
  }
}

TEST(SoundLimiter, LeavesAloneWhatIsBelowAndTurnsTheWholeSoundDownForAPeak) {
  SoundLimiter limiter(kRate_hz);
  for (int i = 0; i < 100; ++i) {
    const double x = 0.8 * std::sin(0.3 * i);
    EXPECT_EQ(limiter.next(x), x);
  }
  EXPECT_EQ(limiter.num_limited(), 0);
  EXPECT_NEAR(limiter.next(1.782), SoundLimiter::kCeiling, 1e-12);
  EXPECT_NEAR(limiter.next(0.2), 0.1, 0.001) << "half as loud, and not cut off";
  for (int i = 0; i < 400; ++i) (void)limiter.next(0.0);
  EXPECT_NEAR(limiter.next(0.2), 0.2 * (1.0 - 0.5 * std::exp(-1.0)), 0.002)
      << "back by a time constant of 50 ms";
  EXPECT_EQ(limiter.num_limited(), 1);
}

}  // namespace sound_mixer_test
}  // namespace jnd::core
