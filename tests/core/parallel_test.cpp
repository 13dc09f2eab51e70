#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace jnd::core {
namespace parallel_test {

TEST(Parallel, DoesEachOnceForAnyNumberOfJobs) {
  for (const int jobs : {1, 2, 7, 100}) {
    std::vector<int> times(41, 0);
    for_each_index(times.size(), jobs, [&](std::size_t i) { ++times[i]; });
    EXPECT_EQ(times, std::vector<int>(41, 1)) << jobs;
  }
  for_each_index(0, 3, [](std::size_t) { FAIL(); });
}

TEST(Parallel, SeveralAreUnderWayAtOnce) {
  std::atomic<int> num_here{0};
  for_each_index(2, 2, [&](std::size_t) {
    ++num_here;
    while (num_here < 2) std::this_thread::yield();
  });
  EXPECT_EQ(num_here, 2);
}

TEST(Parallel, TheFirstFailureIsToldAndNothingElseIsBegun) {
  std::set<std::size_t> begun;
  const auto work = [&](std::size_t i) {
    begun.insert(i);
    if (i == 3) throw std::runtime_error("three");
  };
  EXPECT_THROW(for_each_index(100, 1, work), std::runtime_error);
  EXPECT_EQ(begun, (std::set<std::size_t>{0, 1, 2, 3}));
}

TEST(Parallel, OfTwoThatFailTheLowerIsTold) {
  for (int time = 0; time < 20; ++time) {
    std::atomic<int> num_here{0};
    try {
      for_each_index(2, 2, [&](std::size_t i) {
        ++num_here;
        while (num_here < 2) std::this_thread::yield();
        if (i == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        throw i;
      });
      FAIL();
    } catch (const std::size_t& i) {
      EXPECT_EQ(i, 0U);
    }
  }
}

}  // namespace parallel_test
}  // namespace jnd::core
