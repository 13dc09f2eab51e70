#include "core/storage/storage_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace jnd::core {
namespace storage_thread_test {

Sample at(std::int64_t tick) {
  Sample sample;
  sample.tick = tick;
  return sample;
}

TEST(StorageThread, TakesEverySampleUpToTheTickBeforeTheWork) {
  SpscQueue<Sample> samples(1024);
  std::int64_t last_seen = -1;
  StorageThread storage(samples, {.visit = [&](const Sample& s) { last_seen = s.tick; }});
  for (std::int64_t tick = 0; tick < 500; ++tick) ASSERT_TRUE(samples.try_push(at(tick)));
  std::int64_t seen_at_work = -1;
  storage.after(499, [&] { seen_at_work = last_seen; });
  EXPECT_EQ(seen_at_work, 499);
}

TEST(StorageThread, DoesNotWaitForEverForATickThatNeverComes) {
  SpscQueue<Sample> samples(16);
  StorageThread storage(samples, {});
  bool done = false;
  storage.after(1000000, [&] { done = true; });
  EXPECT_TRUE(done);
}

TEST(StorageThread, CallsBackWhileItIsWaitedFor) {
  SpscQueue<Sample> samples(16);
  StorageThread storage(samples, {});
  std::atomic<int> num_calls{0};
  // The work ends after two calls. Without the calls, the test would run into its time limit.
  storage.after(
      -1,
      [&] {
        while (num_calls < 2) std::this_thread::yield();
      },
      [&] { ++num_calls; });
  EXPECT_GE(num_calls, 2);
}

TEST(StorageThread, ThrowsFromTheNextCallWhatAWriteThrew) {
  SpscQueue<Sample> samples(16);
  StorageThread storage(
      samples, {.visit = [](const Sample&) { throw std::runtime_error("disk full"); }});
  ASSERT_TRUE(samples.try_push(at(0)));
  EXPECT_THROW(storage.after(0, [] {}), std::runtime_error);
}

TEST(StorageThread, NothingIsDoneAfterASampleWasLostThoughTheDiskHasRecovered) {
  SpscQueue<Sample> samples(16);
  bool is_full = true;
  StorageThread storage(samples, {.visit = [&](const Sample&) {
                          if (std::exchange(is_full, false)) throw Error("disk full");
                        }});
  ASSERT_TRUE(samples.try_push(at(0)));
  bool done = false;
  for (int attempt = 0; attempt < 3; ++attempt) {
    try {
      storage.after(0, [&] { done = true; });
      ADD_FAILURE() << "the hole was forgotten";
    } catch (const StorageError& error) {
      EXPECT_NE(std::string(error.what()).find("disk full"), std::string::npos);
    }
    ASSERT_TRUE(samples.try_push(at(attempt + 1)));
  }
  EXPECT_FALSE(done);
}

TEST(StorageThread, ThrowsWhatTheWorkThrewAndGoesOn) {
  SpscQueue<Sample> samples(16);
  StorageThread storage(samples, {});
  EXPECT_THROW(storage.after(-1, [] { throw std::runtime_error("no"); }), std::runtime_error);
  bool done = false;
  storage.after(-1, [&] { done = true; });
  EXPECT_TRUE(done);
}

}  // namespace storage_thread_test
}  // namespace jnd::core
