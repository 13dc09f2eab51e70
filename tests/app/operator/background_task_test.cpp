#include "app/operator/background_task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <limits>
#include <new>
#include <stdexcept>

#include "core/error.h"

namespace jnd::app {
namespace background_task_test {

TEST(BackgroundTask, ItsResultIsThereOnceItIsDone) {
  std::promise<void> go;
  BackgroundTask<int> task([&go](WorkControl&) {
    go.get_future().wait();
    return 42;
  });
  EXPECT_TRUE(task.running());
  EXPECT_EQ(task.result(), nullptr);
  go.set_value();
  task.wait();
  EXPECT_EQ(task.status(), WorkStatus::kDone);
  ASSERT_NE(task.result(), nullptr);
  EXPECT_EQ(*task.result(), 42);
  EXPECT_EQ(task.error(), "");
}

template <typename Thrown>
std::string sentence_for(Thrown thrown) {
  BackgroundTask<int> task([&thrown](WorkControl&) -> int { throw thrown; });
  task.wait();
  EXPECT_EQ(task.status(), WorkStatus::kFailed);
  EXPECT_EQ(task.result(), nullptr);
  return task.error();
}

TEST(BackgroundTask, WhateverItThrowsBecomesASentence) {
  EXPECT_EQ(sentence_for(core::Error("disk: expected room, found none")),
            "disk: expected room, found none");
  EXPECT_EQ(sentence_for(std::runtime_error("odd")), "odd");
  EXPECT_NE(sentence_for(std::bad_alloc()).find("memory: expected"), std::string::npos);
  EXPECT_NE(sentence_for(7).find("expected"), std::string::npos);
}

TEST(BackgroundTask, CancelledWorkHasNeitherResultNorError) {
  BackgroundTask<int> task([](WorkControl& control) {
    while (true) control.stop_if_cancelled();
    return 1;
  });
  task.cancel();
  task.wait();
  EXPECT_EQ(task.status(), WorkStatus::kCancelled);
  EXPECT_EQ(task.result(), nullptr);
  EXPECT_EQ(task.error(), "");
}

TEST(BackgroundTask, WorkThatWasThroughBeforeItLookedIsDoneAllTheSame) {
  std::promise<void> go;
  BackgroundTask<int> task([&go](WorkControl&) {
    go.get_future().wait();
    return 3;
  });
  task.cancel();
  go.set_value();
  task.wait();
  EXPECT_EQ(task.status(), WorkStatus::kDone);
}

TEST(BackgroundTask, GoingAwayStopsTheWorkAndWaitsForIt) {
  std::atomic<bool> ended{false};
  {
    const BackgroundTask<int> task([&ended](WorkControl& control) {
      while (!control.cancelled()) {
      }
      ended = true;
      return 1;
    });
  }
  EXPECT_TRUE(ended);
}

TEST(BackgroundTask, ProgressNeverGoesBackAndStaysWithinZeroAndOne) {
  WorkControl control;
  EXPECT_EQ(control.ratio(), 0.0);
  control.progress(-1.0);
  EXPECT_EQ(control.ratio(), 0.0);
  control.progress(0.5);
  control.progress(0.25);
  EXPECT_EQ(control.ratio(), 0.5);
  control.progress(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(control.ratio(), 0.5);
  control.progress(7.0);
  EXPECT_EQ(control.ratio(), 1.0);
}

TEST(BackgroundTask, WakesTheWindowOnceAPercentAndWhenItIsOver) {
  std::atomic<int> num_wakes{0};
  BackgroundTask<int> task(
      [](WorkControl& control) {
        for (int i = 0; i <= 10'000; ++i) control.progress(i / 10'000.0);
        return 1;
      },
      [&num_wakes] { ++num_wakes; });
  task.wait();
  EXPECT_EQ(task.progress(), 1.0);
  EXPECT_EQ(num_wakes, 100 + 1);
}

TEST(BackgroundTask, WhoeverIsWokenLastFindsItOver) {
  std::atomic<bool> was_over{false};
  BackgroundTask<int>* seen = nullptr;
  std::promise<void> go;
  BackgroundTask<int> task(
      [&go](WorkControl&) {
        go.get_future().wait();
        return 1;
      },
      [&] { was_over = !seen->running(); });
  seen = &task;
  go.set_value();
  task.wait();
  EXPECT_TRUE(was_over);
}

}  // namespace background_task_test
}  // namespace jnd::app
