#include "core/markers/pulse_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/error.h"
#include "support/comes_about.h"

namespace jnd::core {
namespace pulse_writer_test {

using test_support::comes_about;
using ::testing::ElementsAre;
using ::testing::Pair;

double clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// What a parallel port, or any other, was told: codes with their times, and 0 for the end of a
/// pulse.
struct Told {
  std::mutex mutex;
  std::vector<std::pair<int, double>> codes;
  std::atomic<int> fails_after{1000};  ///< The port writes this many pulses before it fails.

  [[nodiscard]] std::vector<std::pair<int, double>> all() {
    const std::lock_guard guard(mutex);
    return codes;
  }
};

class FakePort final : public MarkerPort {
 public:
  explicit FakePort(Told& told) : told_(told) {}
  void set(std::uint8_t code) override {
    if (told_.fails_after-- <= 0) throw Error("fake: expected a cable, found none");
    note(code);
  }
  void clear() override { note(0); }

 private:
  void note(int code) {
    const std::lock_guard guard(told_.mutex);
    told_.codes.emplace_back(code, clock_s());
  }
  Told& told_;
};

PulseWriter::News all_news(PulseWriter& writer) {
  writer.wait_until_sent(10.0);
  return writer.take_news();
}

TEST(PulseWriter, WritesPulsesOneAfterTheOtherWithTheirTimes) {
  constexpr double kWidth_s = 0.004;
  Told told;
  PulseWriter writer([&] { return std::make_unique<FakePort>(told); }, kWidth_s);
  const double before_s = clock_s();
  writer.send(17, 4);
  writer.send(18, 4);
  writer.send(19, 255);
  const PulseWriter::News news = all_news(writer);
  EXPECT_TRUE(news.is_opened);
  EXPECT_EQ(news.problem, "");
  ASSERT_EQ(news.pulses.size(), 3U);
  const auto codes = told.all();
  ASSERT_EQ(codes.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    const MarkerPulse& pulse = news.pulses[i];
    EXPECT_EQ(pulse.event, 17 + static_cast<std::int64_t>(i));
    EXPECT_EQ(codes[2 * i].first, pulse.code);
    EXPECT_EQ(codes[2 * i + 1].first, 0);
    // The pulse began within its own uncertainty.
    EXPECT_GE(pulse.uncertainty_s, 0.0);
    EXPECT_GE(codes[2 * i].second, pulse.monotonic_s);
    EXPECT_LE(codes[2 * i].second, pulse.monotonic_s + pulse.uncertainty_s);
    EXPECT_GE(codes[2 * i + 1].second - codes[2 * i].second, 0.99 * kWidth_s) << "its width";
    if (i > 0) {
      EXPECT_GE(codes[2 * i].second - codes[2 * i - 1].second, 0.99 * kWidth_s) << "its rest";
    }
  }
  EXPECT_GE(news.pulses[0].monotonic_s, before_s);
  EXPECT_EQ(writer.num_sent(), 3);
  EXPECT_EQ(writer.num_dropped(), 0);
}

TEST(PulseWriter, ABoxThatEndsItsPulsesIsSentNoEnd) {
  Told told;
  PulseWriter writer([&] { return std::make_unique<FakePort>(told); }, 0.0);
  writer.send(1, 1);
  writer.send(2, 2);
  (void)all_news(writer);
  const auto codes = told.all();
  ASSERT_EQ(codes.size(), 2U);
  EXPECT_EQ(codes[1].first, 2);
}

TEST(PulseWriter, APortThatCannotBeOpenedIsToldOnceAndTheRestIsCounted) {
  PulseWriter writer([]() -> std::unique_ptr<MarkerPort> { throw Error("no port"); }, 0.001);
  ASSERT_TRUE(comes_about([&] {
    writer.send(1, 1);
    return writer.num_dropped() > 3;
  }));
  EXPECT_EQ(writer.take_news().problem, "no port");
  const PulseWriter::News later = all_news(writer);
  EXPECT_EQ(later.problem, "");
  EXPECT_FALSE(later.is_opened);
  EXPECT_EQ(writer.num_sent(), 0);
}

TEST(PulseWriter, APortThatFailsLaterKeepsWhatWasWrittenBefore) {
  Told told;
  told.fails_after = 1;
  PulseWriter writer([&] { return std::make_unique<FakePort>(told); }, 0.001);
  for (int i = 1; i <= 5; ++i) writer.send(i, i);
  const PulseWriter::News news = all_news(writer);
  EXPECT_EQ(news.problem, "fake: expected a cable, found none");
  ASSERT_EQ(news.pulses.size(), 1U);
  EXPECT_EQ(news.pulses[0].event, 1);
  EXPECT_EQ(writer.num_sent(), 1);
  EXPECT_EQ(writer.num_dropped(), 4);
}

// The session's thread sends the pulses and must not wait for a port that hangs.
TEST(PulseWriter, WhoSendsWaitsForNobody) {
  std::atomic<bool> may_open{false};
  Told told;
  PulseWriter writer(
      [&]() -> std::unique_ptr<MarkerPort> {
        while (!may_open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return std::make_unique<FakePort>(told);
      },
      0.0);
  const double before_s = clock_s();
  for (int i = 0; i < 1000; ++i) writer.send(i, 1);
  EXPECT_LT(clock_s() - before_s, 1.0);
  EXPECT_GT(writer.num_dropped(), 0) << "more than any session has waiting";
  writer.wait_until_sent(0.05);
  EXPECT_LT(clock_s() - before_s, 5.0) << "patience ends";
  may_open = true;
  EXPECT_FALSE(all_news(writer).pulses.empty());
}

TEST(PulseWriter, APulseUnderWayIsEndedWithTheWriter) {
  Told told;
  {
    PulseWriter writer([&] { return std::make_unique<FakePort>(told); }, 30.0);
    writer.send(1, 8);
    ASSERT_TRUE(comes_about([&] { return !told.all().empty(); }));
  }
  const auto codes = told.all();
  ASSERT_EQ(codes.size(), 2U);
  EXPECT_EQ(codes[1].first, 0) << "no line stays high";
}

}  // namespace pulse_writer_test
}  // namespace jnd::core
