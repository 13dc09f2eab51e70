#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "app/operator/realtime_session_fixture.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace slow_disk_test {

/// A session on a disk that is slow or fails on request.
class SlowDiskTest : public RealtimeSessionTest {
 protected:
  SlowDiskTest() {
    on_sample_ = [this](const core::Sample& sample) {
      samples_.push_back(sample);
      if (const std::int64_t held_ms = held_ms_.exchange(0); held_ms > 0) {
        is_holding_ = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(held_ms));
      }
      if (fails_.exchange(false)) {
        has_failed_ = true;
        throw core::Error("recording: expected room, found the disk full");
      }
    };
  }
  ~SlowDiskTest() override { session_.reset(); }

  /// Goes to the block's second trial as fast as possible, and continues in real time.
  SessionView go_on_in_real_time(const std::vector<device::ScheduledFault>& faults = {}) {
    open();
    answer_trial(run_to_block("comparison"), 1.0);
    session_.reset();
    samples_.clear();
    open_window();
    reopen(faults);
    session_->request(operate::Begin{"repeat"});
    return until([](const SessionView& now) { return now.step == Step::kReady; });
  }

  void hold_disk(std::int64_t duration_ms) {
    is_holding_ = false;
    held_ms_ = duration_ms;
    while (!is_holding_) std::this_thread::yield();
  }
  /// The disk loses a sample and then works again.
  void lose_a_sample() {
    fails_ = true;
    while (!has_failed_) std::this_thread::yield();
  }

  using RealtimeSessionTest::force_n;
  static double force_n(const core::Sample& sample) {
    double sum_n = 0.0;
    for (const core::PlainVector& force : sample.tip_force_n) sum_n += force_n(force);
    return sum_n;
  }
  /// Returns the tick of the last sample with a force, after the session is closed.
  [[nodiscard]] std::int64_t last_tick_with_force() const {
    std::int64_t last = 0;
    for (const core::Sample& sample : samples_) {
      if (force_n(sample) > 0.0) last = sample.tick;
    }
    return last;
  }
  /// Makes this request while the disk is held, and measures when the force is gone. A loop
  /// that is late has fewer ticks in the same time, both with and without force.
  void expect_free_space_at_once(const std::optional<OperatorRequest>& request) {
    constexpr std::int64_t kHeldMs = 1500;
    hold_disk(kHeldMs);
    const std::int64_t asked = view().telemetry.sample.tick;
    if (request) session_->request(*request);
    until([](const SessionView& now) { return now.step != Step::kPresenting; });
    const std::int64_t done = view().telemetry.sample.tick;
    session_.reset();
    EXPECT_GT(done - asked, kHeldMs * 2 / 3) << "the disk was held all the while";
    EXPECT_LT(last_tick_with_force() - asked, kHeldMs / 3);
  }

  /// Only the storage thread uses them while there is a session.
  std::vector<core::Sample> samples_;
  std::atomic<std::int64_t> held_ms_{0};
  std::atomic<bool> is_holding_{false};
  std::atomic<bool> fails_{false};
  std::atomic<bool> has_failed_{false};
};

TEST_F(SlowDiskTest, APauseTakesTheMediumAwayBeforeTheDiskIsFree) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  expect_free_space_at_once(operate::Pause{"a cough"});
}

TEST_F(SlowDiskTest, SoDoesAnUndo) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  expect_free_space_at_once(operate::Undo{"wrong key"});
}

TEST_F(SlowDiskTest, SoDoesAnAnswerWhichIsStoredAsItWasGiven) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  const double felt_s = present(trial, "test").trial->felt_s;
  expect_free_space_at_once(operate::Answer{trial, 0.0});
  const core::TrialRow row = store_->trials(session_number_).back();
  EXPECT_EQ(row.trial, trial);
  EXPECT_EQ(row.response, 0.0);
  EXPECT_NEAR(row.measures.response_time_s.value(), felt_s, 0.5);
  EXPECT_EQ(store_->presentations(session_number_).back().last_tick, row.last_tick);
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

TEST_F(SlowDiskTest, SoDoesTheEndOfTheSession) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  expect_free_space_at_once(operate::EndEarly{"no time left"});
}

TEST_F(SlowDiskTest, SoDoesWhoLeaves) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  expect_free_space_at_once(operate::Leave{});
}

TEST_F(SlowDiskTest, SoDoesAMagnetThatLoosens) {
  const SessionView ready =
      go_on_in_real_time({{.first_tick = 3000,
                           .num_ticks = 1'000'000,
                           .injection = device::Injection::kDetachedPoint}});
  const std::int64_t opened = ready.telemetry.sample.tick - ready.telemetry.num_ticks;
  present(ready.trial->trial, "reference");
  until([&](const SessionView& now) { return now.telemetry.sample.tick > opened + 2950; });
  expect_free_space_at_once({});
}

/// Whoever leads the session may be held up between a look at the loop and what is shown.
TEST_F(SlowDiskTest, AFaultThatIsNotShownYetIsNotCountedAsSeen) {
  const SessionView ready =
      go_on_in_real_time({{.first_tick = 3000, .injection = device::Injection::kReadFailure}});
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (view().telemetry.fault == core::Fault::kNone &&
         std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_NE(view().telemetry.fault, core::Fault::kNone);
  EXPECT_EQ(view().step, Step::kReady);
  EXPECT_EQ(view().telemetry.num_faults, ready.telemetry.num_faults);
  const SessionView told =
      until([](const SessionView& now) { return now.step == Step::kFault; });
  EXPECT_GT(told.telemetry.num_faults, ready.telemetry.num_faults);
}

TEST_F(SlowDiskTest, NoAnswerIsStoredOverAHoleThoughTheDiskHasRecovered) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  present(trial, "test");
  lose_a_sample();
  const std::size_t num_events = kinds().size();
  for (int press = 0; press < 2; ++press) {
    session_->request(operate::Answer{trial, 1.0});
    session_->advance(0.0);
    EXPECT_EQ(view().step, Step::kFailed);
  }
  EXPECT_NE(view().fault.find("disk full"), std::string::npos) << view().fault;
  EXPECT_EQ(view().num_refusals, 0U) << "it is no refusal that could be tried again";
  until([](const SessionView& now) { return now.telemetry.arming == core::Arming::kDisarmed; });
  EXPECT_EQ(force_n(view().telemetry.total_force_n), 0.0);
  EXPECT_EQ(kinds().size(), num_events);
  session_->request(operate::Leave{});
  session_->advance(0.0);
  EXPECT_TRUE(session_->over());
}

TEST_F(SlowDiskTest, WhoClosesTheWindowWhenTheDiskFailsIsNotHeldBack) {
  const std::int64_t trial = go_on_in_real_time().trial->trial;
  present(trial, "reference");
  lose_a_sample();
  session_->request(operate::Leave{"the window was closed"});
  for (int glance = 0; glance < 3 && !session_->over(); ++glance) session_->advance(0.0);
  EXPECT_TRUE(session_->over());
  EXPECT_EQ(view().step, Step::kFailed);
}

}  // namespace slow_disk_test
}  // namespace jnd::app
