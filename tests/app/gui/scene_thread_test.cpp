#include "app/gui/scene_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "core/error.h"

namespace jnd::app::gui {
namespace scene_thread_test {

using std::chrono::steady_clock;

/// Waits until `condition` holds, and at most a minute. Returns whether it holds.
template <typename Condition>
bool comes_true(const Condition& condition) {
  const auto patience = steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (steady_clock::now() > patience) return false;
    std::this_thread::yield();
  }
  return true;
}

SceneRequest request_of(std::int64_t tick) {
  SceneRequest request;
  request.sample.tick = tick;
  return request;
}

/// Returns a painter whose texture is the tick of the request.
SceneThread::Paint paints_ticks() {
  return [](const SceneRequest& request, double) {
    return static_cast<std::uintptr_t>(request.sample.tick);
  };
}

TEST(SceneThread, NobodyWaitsWhileItLoads) {
  std::promise<void> loaded;
  std::atomic<int> num_woken{0};
  SceneThread scene(
      [&] {
        loaded.get_future().wait();  // Loading takes until the test allows it to end.
        return paints_ticks();
      },
      [&] { ++num_woken; });
  for (int frame = 1; frame <= 100; ++frame) EXPECT_EQ(scene.paint(request_of(frame), 0.0), 0U);
  EXPECT_EQ(num_woken, 0);
  loaded.set_value();
  EXPECT_TRUE(comes_true([&] { return num_woken > 0; })) << "the window is woken for it";
  EXPECT_EQ(scene.paint(request_of(100), 0.0), 100U) << "the last one that was asked for";
}

TEST(SceneThread, NobodyWaitsForAPictureAndTheLastOneStandsMeanwhile) {
  std::promise<void> second;
  std::shared_future<void> may_end = second.get_future().share();
  SceneThread scene(
      [&] {
        return [may_end](const SceneRequest& request, double) {
          if (request.sample.tick == 2) may_end.wait();
          return static_cast<std::uintptr_t>(request.sample.tick);
        };
      },
      [] {});
  EXPECT_TRUE(comes_true([&] { return scene.paint(request_of(1), 0.0) == 1U; }));
  for (int frame = 0; frame < 100; ++frame) {
    EXPECT_EQ(scene.paint(request_of(2), 0.0), 1U);
  }
  second.set_value();
  EXPECT_TRUE(comes_true([&] { return scene.paint(request_of(3), 0.0) == 3U; }));
}

TEST(SceneThread, WhatCannotBeLoadedIsToldToWhoAsks) {
  std::atomic<bool> is_woken{false};
  SceneThread scene([]() -> SceneThread::Paint { throw core::Error("3D view: no OpenGL"); },
                    [&] { is_woken = true; });
  EXPECT_TRUE(comes_true([&] { return is_woken.load(); }));
  try {
    (void)scene.paint(request_of(1), 0.0);
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(), "3D view: no OpenGL");
  }
}

TEST(SceneThread, SoIsWhatCannotBeDrawn) {
  SceneThread scene(
      [] {
        return [](const SceneRequest&, double) -> std::uintptr_t {
          throw core::Error("3D view: out of memory");
        };
      },
      [] {});
  EXPECT_TRUE(comes_true([&] {
    try {
      return scene.paint(request_of(1), 0.0) != 0;
    } catch (const core::Error&) {
      return true;
    }
  }));
}

TEST(SceneThread, WhatWasLoadedIsDrawnAndDestroyedOnOneThread) {
  struct Loaded {
    std::thread::id made = std::this_thread::get_id();
    std::atomic<bool>* is_gone = nullptr;
    ~Loaded() { *is_gone = made == std::this_thread::get_id(); }
  };
  std::atomic<bool> is_gone_there{false};
  {
    SceneThread scene(
        [&]() -> SceneThread::Paint {
          auto loaded = std::make_shared<Loaded>();
          loaded->is_gone = &is_gone_there;
          return [loaded](const SceneRequest&, double) -> std::uintptr_t {
            return loaded->made == std::this_thread::get_id() ? 7 : 0;
          };
        },
        [] {});
    EXPECT_TRUE(comes_true([&] { return scene.paint(request_of(1), 0.0) == 7U; }));
    EXPECT_FALSE(is_gone_there);
  }
  EXPECT_TRUE(is_gone_there);
}

}  // namespace scene_thread_test
}  // namespace jnd::app::gui
